#pragma once

#include <chrono>
#include <optional>

#include "core/parallel/comm.hpp"

namespace wingbeat {

// Whether a run should end early: SIGTERM or SIGUSR1 has reached a rank, or its wall time is used up. A
// second signal ends the process at once, as if it had not been caught.
class StopRequest {
 public:
  // Catches both signals from now on. `walltime` in seconds from now; none: unlimited.
  StopRequest(const Comm& comm, std::optional<double> walltime);

  // The same request, polled by other ranks: those of `comm`.
  StopRequest(const Comm& comm, const StopRequest& other) : comm_(&comm), deadline_(other.deadline_) {}

  // Collective: all ranks get the same answer.
  bool is_set() const;
  // What this rank knows.
  bool is_set_here() const;

 private:
  const Comm* comm_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

}  // namespace wingbeat
