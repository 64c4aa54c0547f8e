#include "core/parallel/node.hpp"

#include "core/parallel/mpi_call.hpp"

namespace wingbeat {

int ranks_on_node(const Comm& comm) {
  MPI_Comm node = MPI_COMM_NULL;
  check_mpi(MPI_Comm_split_type(comm.handle(), MPI_COMM_TYPE_SHARED, comm.rank(), MPI_INFO_NULL, &node));
  int ranks = 0;
  const int status = MPI_Comm_size(node, &ranks);
  check_mpi(MPI_Comm_free(&node));
  check_mpi(status);
  return ranks;
}

}  // namespace wingbeat
