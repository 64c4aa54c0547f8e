#pragma once

#include "core/parallel/comm.hpp"

namespace wingbeat {

// Lets ranks that have failed end the program together, or, when others are still at work and
// would wait for them for ever, end it for all.
class FailureAgreement {
 public:
  // Collective: takes a communicator of its own, so that pending calls of `comm` do not matter.
  explicit FailureAgreement(const Comm& comm);
  ~FailureAgreement();
  FailureAgreement(const FailureAgreement&) = delete;
  FailureAgreement& operator=(const FailureAgreement&) = delete;

  // Called by a rank that has failed: whether every other rank has called this before, or does
  // within the time. May be called again after it was false.
  bool all_failed(double patience_seconds);

  // Ends every rank; the launcher returns `exit_code`.
  [[noreturn]] void abort(int exit_code) const;

 private:
  MPI_Comm handle_ = MPI_COMM_NULL;
  MPI_Request arrival_ = MPI_REQUEST_NULL;
  bool is_waiting_ = false;
};

}  // namespace wingbeat
