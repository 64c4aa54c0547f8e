#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

// Two jobs in one folder of results: the second refuses, and leaves what the first has there.
class TwoJobs : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    program_ = WINGBEAT_WITH_FAKE_VERBS;
    write("case.toml", "");
  }

  // Starts the program, which works until it is told to stop.
  pid_t start() const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    const bool ready = ::chdir(folder_.c_str()) == 0 && std::freopen("/dev/null", "w", stdout) != nullptr &&
                       std::freopen("/dev/null", "w", stderr) != nullptr;
    if (ready) ::execl(program_.c_str(), program_.c_str(), "wait", "case.toml", "--output", "out", nullptr);
    ::_exit(98);
  }
  static int exit_code(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }
  static int end(pid_t child, int signal) {
    int status = 0;
    ::kill(child, signal);
    ::waitpid(child, &status, 0);
    return exit_code(status);
  }
  // Until the first is at work, and so can be told to stop.
  void await_work() const {
    for (int i = 0; i < 2000 && read("out/log.txt").find("waiting") == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
};

TEST_F(TwoJobs, TheSecondRefusesAndSaysWhoIsThere) {
  const pid_t first = start();
  await_work();
  const std::string log = read("out/log.txt");
  const auto second = run({"succeed", "case.toml", "--output", "out"}, 2);
  EXPECT_EQ(second.exit_code, 2);
  expect_in("out: in use by \"wingbeat wait\" since ", second.errors);
  expect_in("process " + std::to_string(first), second.errors);
  EXPECT_EQ(second.errors.find("in use"), second.errors.rfind("in use")) << "one rank says so";
  EXPECT_FALSE(files("out").contains("result.json")) << "the first has not ended";
  EXPECT_EQ(read("out/log.txt"), log);
  EXPECT_EQ(run({"succeed", "case.toml", "--output", "out", "--dry-run"}).exit_code, 0)
      << "a plan writes nothing";
  EXPECT_EQ(end(first, SIGTERM), 4);
  EXPECT_FALSE(files("out").contains("lock"));
  EXPECT_EQ(run({"succeed", "case.toml", "--output", "out"}, 2).exit_code, 0);
}

TEST_F(TwoJobs, ALockOfAKilledRunIsTakenOver) {
  const pid_t first = start();
  await_work();
  EXPECT_EQ(end(first, SIGKILL), -1);
  ASSERT_TRUE(files("out").contains("lock"));
  EXPECT_EQ(run({"succeed", "case.toml", "--output", "out"}).exit_code, 0);
  EXPECT_FALSE(files("out").contains("lock"));
}

TEST_F(TwoJobs, OfFourStartedAtOnceOneRuns) {
  std::set<pid_t> jobs;
  for (int i = 0; i < 4; ++i) jobs.insert(start());
  for (int i = 0; i < 3; ++i) {
    int status = 0;
    const pid_t refused = ::wait(&status);
    EXPECT_EQ(exit_code(status), 2);
    jobs.erase(refused);
  }
  ASSERT_EQ(jobs.size(), 1U);
  await_work();
  EXPECT_EQ(end(*jobs.begin(), SIGTERM), 4);
}

TEST_F(TwoJobs, NoLockIsLeftHoweverARunEnds) {
  for (const std::string verb : {"succeed", "stall", "break-all", "break-one"}) {
    run({verb, "case.toml", "--output", "out"}, 2);
    EXPECT_TRUE(files("out").contains("result.json")) << verb;
    EXPECT_FALSE(files("out").contains("lock")) << verb;
  }
}

}  // namespace
}  // namespace wingbeat
