#include "core/parallel/failure_agreement.hpp"

#include <chrono>
#include <cstdlib>
#include <thread>

#include "core/parallel/mpi_call.hpp"

namespace wingbeat {

FailureAgreement::FailureAgreement(const Comm& comm) { check_mpi(MPI_Comm_dup(comm.handle(), &handle_)); }

FailureAgreement::~FailureAgreement() {
  int is_finalized = 0;
  MPI_Finalized(&is_finalized);
  if (!is_finalized) MPI_Comm_free(&handle_);
}

bool FailureAgreement::all_failed(double patience_seconds) const {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(patience_seconds);
  MPI_Request arrival = MPI_REQUEST_NULL;
  check_mpi(MPI_Ibarrier(handle_, &arrival));
  int has_arrived = 0;
  while (Clock::now() < deadline) {
    check_mpi(MPI_Test(&arrival, &has_arrived, MPI_STATUS_IGNORE));
    if (has_arrived) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

void FailureAgreement::abort(int exit_code) const {
  MPI_Abort(handle_, exit_code);
  std::abort();
}

}  // namespace wingbeat
