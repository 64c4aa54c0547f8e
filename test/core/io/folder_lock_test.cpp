#include "core/io/folder_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/io/error.hpp"
#include "core/io/file.hpp"

namespace wingbeat {
namespace {

namespace fs = std::filesystem;

class FolderOfResults : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  // What the lock tells of a holder, line by line.
  std::vector<std::string> lines() const {
    std::istringstream in(read_file(file_));
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  // A lock as a run leaves it that this host's kernel does not hold for it.
  void leave(const std::vector<std::string>& lines) const {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    write_file(file_, text);
  }
  // Why the folder is refused; empty where it is not.
  std::string refusal() const {
    try {
      const FolderLock lock(folder_, "wingbeat steady");
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  fs::path folder_ = fs::temp_directory_path() / ("wingbeat-lock-" + std::to_string(::getpid())) / "deep";
  fs::path file_ = FolderLock::file_in(folder_);
};

TEST_F(FolderOfResults, IsHeldByOneRunAtATimeAndFreeAfterwards) {
  {
    const FolderLock first(folder_, "wingbeat flutter");
    EXPECT_NE(refusal().find("in use by \"wingbeat flutter\" since 20"), std::string::npos) << refusal();
    EXPECT_NE(refusal().find("process " + std::to_string(::getpid())), std::string::npos);
    EXPECT_NE(refusal().find("give another --output"), std::string::npos);
    EXPECT_EQ(lines().size(), 5U) << "who is refused leaves the lock as it is";
  }
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_EQ(refusal(), "");
}

TEST_F(FolderOfResults, IsTakenOverFromAProcessThatWasKilled) {
  const pid_t child = ::fork();
  if (child == 0) {
    new FolderLock(folder_, "wingbeat flutter");  // never released
    ::_exit(0);
  }
  // Even while nobody has asked after it.
  ::waitid(P_PID, static_cast<id_t>(child), nullptr, WEXITED | WNOWAIT);
  ASSERT_TRUE(fs::exists(file_));
  EXPECT_EQ(refusal(), "");
  ::waitpid(child, nullptr, 0);
}

TEST_F(FolderOfResults, IsTakenOverWhereTheProcessNumberIsUsedAgain) {
  std::vector<std::string> own;
  {
    const FolderLock first(folder_, "wingbeat flutter");
    own = lines();
  }
  leave(own);
  EXPECT_NE(refusal(), "") << "by its number and start this very process holds it";
  own[2] = std::string("1");
  leave(own);
  EXPECT_EQ(refusal(), "");
}

TEST_F(FolderOfResults, IsNotTakenFromAnotherHost) {
  leave({"another-host", "1", "1", "2026-01-02 03:04:05 UTC", "wingbeat march"});
  const std::string reason = refusal();
  for (const std::string part :
       {"in use by \"wingbeat march\" since 2026-01-02 03:04:05 UTC (host another-host, "
        "process 1)",
        "if it runs no more, remove"})
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  EXPECT_EQ(lines().front(), "another-host");
}

// Its processes are not to be seen, but that its run is alive is: it renews the time of the lock.
TEST_F(FolderOfResults, IsTakenOverFromAnotherHostThatHasBeenSilent) {
  const std::vector<std::string> other{"another-host", "1", "1", "2026-01-02 03:04:05 UTC", "wingbeat march"};
  const auto refusal_after = [&](std::chrono::minutes silence) {
    leave(other);
    fs::last_write_time(file_, fs::last_write_time(file_) - silence);
    return refusal();
  };
  EXPECT_NE(refusal_after(FolderLock::patience - std::chrono::minutes(1)), "");
  EXPECT_EQ(refusal_after(FolderLock::patience + std::chrono::minutes(1)), "");
}

TEST_F(FolderOfResults, IsSeenToBeHeldAsLongAsItIs) {
  const FolderLock lock(folder_, "wingbeat flutter", std::chrono::milliseconds(5));
  const auto long_ago = fs::last_write_time(file_) - std::chrono::hours(1);
  for (int pulse = 0; pulse < 2; ++pulse) {
    fs::last_write_time(file_, long_ago);
    for (int i = 0; i < 2000 && fs::last_write_time(file_) == long_ago; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_GT(fs::last_write_time(file_), long_ago);
  }
}

TEST_F(FolderOfResults, IsTakenOverFromARunKilledAsItBegan) {
  write_file(file_, "");
  EXPECT_EQ(refusal(), "");
}

TEST_F(FolderOfResults, KeepsTheLockOfTheNextRunWhereItsOwnWasRemovedByHand) {
  auto first = std::make_unique<FolderLock>(folder_, "wingbeat flutter");
  fs::remove(file_);
  const FolderLock second(folder_, "wingbeat march");
  first.reset();
  EXPECT_EQ(lines().back(), "wingbeat march");
}

// A lock that two could hold is one that some round of these would show.
TEST_F(FolderOfResults, IsNeverHeldByTwoOfManyThatTryAtOnce) {
  std::atomic<int> holders = 0, most = 0, times = 0;
  const auto contend = [&] {
    for (int i = 0; i < 300; ++i) try {
        const FolderLock lock(folder_, "wingbeat steady");
        const int now = ++holders;
        if (now > most) most = now;
        ++times;
        std::this_thread::yield();
        --holders;
      } catch (const InputError&) {
        std::this_thread::yield();
      }
  };
  {
    std::array<std::jthread, 4> threads;
    for (auto& thread : threads) thread = std::jthread(contend);
  }
  EXPECT_EQ(most, 1);
  EXPECT_GT(times, 0);
}

}  // namespace
}  // namespace wingbeat
