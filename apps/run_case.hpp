#pragma once

#include "apps/command_line.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

enum ExitCode {
  exit_converged = 0,
  exit_not_converged = 1,
  exit_bad_input = 2,
  exit_internal = 3,
  exit_stopped = 4
};

// Reads the case, runs the verb's recipe and leaves result.json in the output folder, whatever
// happens. Returns the exit code, the same on all ranks; a failure of some ranks only ends all.
int run_case(const Comm& comm, const CommandLine& command);

}  // namespace wingbeat
