#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace wingbeat {

// What a run of the program left behind.
struct ProgramRun {
  int exit_code = -1;
  std::string output;
  std::string errors;
};

// Runs the built program in a folder of its own, under mpirun where ranks > 0.
class Program : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  ProgramRun run(const std::vector<std::string>& arguments, int ranks = 0) const;
  // Sends the signal once the program, on one rank, has printed `awaited`; its exit code.
  int run_and_signal(const std::vector<std::string>& arguments, const std::string& awaited, int signal) const;
  // The paper's section on a mesh of a second's work, with a motion for pitch.
  static std::string small_case();
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  nlohmann::json result(const std::string& output) const;  // of DIR/result.json
  std::set<std::string> files(const std::string& output) const;

  // Exit code 2 with this part of a message, also in DIR/result.json; nothing half-written in DIR.
  void expect_refused(const ProgramRun& run, const std::string& output, const std::string& message) const;

  std::filesystem::path folder_;
  std::string program_ = WINGBEAT_PROGRAM;
};

void expect_in(const std::string& part, const std::string& whole);

}  // namespace wingbeat
