#include "core/parallel/mpi_call.hpp"

#include <limits>
#include <string>

#include "core/io/error.hpp"

namespace wingbeat {

void check_mpi(int code, std::source_location where) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING];
  int length = 0;
  MPI_Error_string(code, text, &length);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  ensure(false, "MPI failed on rank " + std::to_string(rank) + ": " + std::string(text, length), where);
}

int mpi_count(std::size_t length, std::source_location where) {
  ensure(length <= static_cast<std::size_t>(std::numeric_limits<int>::max()),
         "a message of " + std::to_string(length) + " items is longer than MPI can count", where);
  return static_cast<int>(length);
}

}  // namespace wingbeat
