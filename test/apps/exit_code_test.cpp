#include <csignal>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

// The program with recipes that end in every way (test/apps/fake_verbs).
class ExitCode : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    program_ = WINGBEAT_WITH_FAKE_VERBS;
    write("case.toml", "");
  }
};

TEST_F(ExitCode, ZeroWhenConverged) {
  const auto done = run({"succeed", "case.toml", "--output", "out"}, 2);
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  const auto json = result("out");
  EXPECT_EQ(json["status"], "converged");
  EXPECT_EQ(json["answer"], 42);
  EXPECT_TRUE(json["wall_seconds"].contains("outer/inner"));
}

TEST_F(ExitCode, OneWhenNotConverged) {
  EXPECT_EQ(run({"stall", "case.toml", "--output", "out"}).exit_code, 1);
  EXPECT_EQ(result("out")["status"], "stalled");
  EXPECT_EQ(result("out")["message"], "no further");
}

TEST_F(ExitCode, ThreeForOurOwnFaults) {
  const auto broken = run({"break-all", "case.toml", "--output", "out"}, 2);
  EXPECT_EQ(broken.exit_code, 3);
  expect_in("broken on purpose", broken.errors);
  EXPECT_EQ(broken.errors.find("on purpose"), broken.errors.rfind("on purpose"));
  EXPECT_EQ(result("out")["status"], "error");
}

TEST_F(ExitCode, FailureOfOneRankEndsAll) {
  const auto broken = run({"break-one", "case.toml", "--output", "out"}, 2);
  EXPECT_EQ(broken.exit_code, 3);
  expect_in("rank 1: internal error", broken.errors);
  expect_in("broken on one rank", result("out")["message"].get<std::string>());
}

TEST_F(ExitCode, FourWhenStoppedBySignal) {
  for (const int signal : {SIGTERM, SIGUSR1}) {
    EXPECT_EQ(run_and_signal({"wait", "case.toml", "--output", "out"}, "waiting", signal), 4);
    EXPECT_EQ(result("out")["status"], "interrupted");
    expect_in("stopped by a signal", result("out")["message"].get<std::string>());
    expect_in("checkpoint", read("out/log.txt"));
  }
}

TEST_F(ExitCode, FourWhenTheWallTimeIsUsedUp) {
  EXPECT_EQ(run({"wait", "case.toml", "--output", "out", "--walltime", "0.2"}, 2).exit_code, 4);
  EXPECT_EQ(result("out")["status"], "interrupted");
}

TEST_F(ExitCode, TwoForARestartFileThatIsMissing) {
  const auto refused = run({"succeed", "case.toml", "--output", "out", "--restart", "none.cgns"}, 2);
  expect_refused(refused, "out", "--restart none.cgns: no such file");
}

}  // namespace
}  // namespace wingbeat
