#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "test/apps/program.hpp"
#include "test/apps/running_program.hpp"

namespace wingbeat {

using Words = std::vector<std::string>;

inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

inline const Words at_every_step{"checkpoint.interval=1e-9", "checkpoint.largest_share=1"};

// Runs that are stopped, killed and gone on with, under a real mpirun. Pressures on the wall are written with
// all their digits, so that equal text means equal bits.
class Checkpoint : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("case.toml", small_case());
  }

  Words words(const std::string& verb, const std::string& output, const Words& options = {}) const {
    return Words{verb, "case.toml", "--output", output} + options;
  }
  nlohmann::json solve(const std::string& verb, const std::string& output, const Words& options,
                       int ranks = 2, int exit_code = 0) const {
    const auto done = run(words(verb, output, options), ranks);
    EXPECT_EQ(done.exit_code, exit_code) << done.errors << done.output;
    return result(output);
  }
  // Starts a run with checkpoints at every step and kills it once it has printed `row` below `title`.
  void kill_at(const std::string& title, const std::string& row, const Words& arguments) const {
    RunningProgram running(folder_, program_, arguments + at_every_step, 2);
    ASSERT_TRUE(running.has_printed(title, row)) << running.output();
    running.kill();
  }
  std::string log(const std::string& output) const { return read(output + "/log.txt"); }
  void expect_same_file(const std::string& file, const std::string& a, const std::string& b) const {
    const std::string expected = read(a + "/" + file);
    EXPECT_FALSE(expected.empty());
    EXPECT_TRUE(read(b + "/" + file) == expected) << file << " of " << a << " and " << b << " differ";
  }
  void expect_refused_restart(const Words& options, const Words& parts) const {
    const auto refused = run(words("steady", "refused", options));
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    for (const std::string& part : parts) expect_in(part, refused.errors);
  }

  const Words cycles_{"solver.flow_method=runge_kutta"};
  const Words turns_{"solver.method=staggered"};
  const std::string row_20_ = "\n          20 ";
};

}  // namespace wingbeat
