#include "apps/stop_request.hpp"

#include <csignal>

namespace wingbeat {

namespace {

// A signal handler can reach nothing but an object of static life.
volatile std::sig_atomic_t signal_caught = 0;

void note_signal(int signal) {
  if (signal_caught != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // is delivered when this handler returns
  }
  signal_caught = 1;
}

}  // namespace

StopRequest::StopRequest(const Comm& comm, std::optional<double> walltime) : comm_(&comm) {
  using Clock = std::chrono::steady_clock;
  if (walltime)
    deadline_ =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*walltime));
  std::signal(SIGTERM, note_signal);
  std::signal(SIGUSR1, note_signal);
}

bool StopRequest::is_set() const { return comm_->any(is_set_here()); }

bool StopRequest::is_set_here() const {
  return signal_caught != 0 || (deadline_ && std::chrono::steady_clock::now() >= *deadline_);
}

}  // namespace wingbeat
