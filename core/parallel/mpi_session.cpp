#include <dlfcn.h>

#include "core/parallel/comm.hpp"
#include "core/parallel/mpi_call.hpp"

namespace wingbeat {
namespace {

// The ranks already fill the cores. Looked up at run time, since this folder links no BLAS;
// OPENBLAS_NUM_THREADS would be too late, the library read it when it was loaded.
void keep_blas_to_one_thread() {
  using SetThreads = void (*)(int);
  if (void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<SetThreads>(symbol)(1);
}

}  // namespace

MpiSession::MpiSession(int& argc, char**& argv) {
  check_mpi(MPI_Init(&argc, &argv));
  check_mpi(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN));
  keep_blas_to_one_thread();
}

MpiSession::~MpiSession() { MPI_Finalize(); }

}  // namespace wingbeat
