#pragma once

#include <functional>
#include <string>
#include <vector>

#include "test/apps/program.hpp"

namespace wingbeat {

// The program fed with damaged inputs.
class Fuzz : public Program {
 protected:
  // How one run of the program ended.
  struct End {
    int exit_code = -1;
    int signal = 0;  // that killed it
    std::string errors;
    bool hangs() const;
  };

  // Runs the program bare in a subfolder, within limits of memory and of time: 10 s of a processor's, which
  // do not depend on what else the machine does, and a minute in all.
  End end_of(const std::string& subfolder, const std::vector<std::string>& arguments) const;

  // Calls `attempt` for `count` seeds from `first` on, two at a time, each with a subfolder of its own that
  // it may fill. It returns what is wrong, or nothing. The first few of these become failures of the test,
  // with their seeds.
  using Attempt = std::function<std::string(unsigned seed, const std::string& subfolder)>;
  void attempt_all(unsigned first, int count, const Attempt& attempt) const;

  // The first seed: WINGBEAT_FUZZ_SEED, to look at a failure again, or `otherwise`.
  static unsigned first_seed(unsigned otherwise);
  // How many to attempt: one where a seed is given.
  static int attempts(int in_all, int nightly);
};

}  // namespace wingbeat
