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
  // While a rank still waits on it, Open MPI must not lose the communicator.
  if (!is_finalized && !is_waiting_) MPI_Comm_free(&handle_);
}

bool FailureAgreement::all_failed(double patience_seconds) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(patience_seconds);
  if (!is_waiting_) check_mpi(MPI_Ibarrier(handle_, &arrival_));
  is_waiting_ = true;
  while (Clock::now() < deadline) {
    int have_arrived = 0;
    check_mpi(MPI_Test(&arrival_, &have_arrived, MPI_STATUS_IGNORE));
    is_waiting_ = have_arrived == 0;
    if (!is_waiting_) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

void FailureAgreement::abort(int exit_code) const {
  MPI_Abort(handle_, exit_code);
  std::abort();
}

}  // namespace wingbeat
