#include "core/io/memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/file.hpp"

namespace wingbeat {
namespace {

namespace fs = std::filesystem;

// The system's files as some node might have them.
class Node : public ::testing::Test {
 protected:
  void SetUp() override { write("proc/meminfo", "MemTotal: 8000 kB\nMemAvailable:    4000 kB\n"); }
  void TearDown() override { fs::remove_all(root_); }
  void write(const std::string& name, const std::string& text) const { write_file(root_ / name, text); }

  fs::path root_ = fs::temp_directory_path() / ("wingbeat-node-" + std::to_string(::getpid()));
};

TEST_F(Node, HasWhatTheKernelDeemsAvailable) {
  EXPECT_EQ(available_bytes(root_), 4000 * 1024.0);
  EXPECT_EQ(available_bytes(root_ / "nowhere"), HUGE_VAL);
  EXPECT_GT(available_bytes(), 1e6);
}

TEST_F(Node, HasLessWhereTheJobsGroupOrOneAboveItIsLimited) {
  write("proc/self/cgroup", "0::/job/step\n");
  write("sys/fs/cgroup/job/step/memory.max", "max\n");
  write("sys/fs/cgroup/job/step/memory.current", "1000\n");
  EXPECT_EQ(available_bytes(root_), 4000 * 1024.0);
  write("sys/fs/cgroup/job/memory.max", "2000000\n");
  write("sys/fs/cgroup/job/memory.current", "1500000\n");
  EXPECT_EQ(available_bytes(root_), 500000.0);
  write("sys/fs/cgroup/job/memory.stat", "anon 5\ninactive_file 300000\n");
  EXPECT_EQ(available_bytes(root_), 800000.0) << "files read before can be dropped";
  write("sys/fs/cgroup/job/step/memory.max", "1001\n");
  EXPECT_EQ(available_bytes(root_), 1.0);
}

TEST_F(Node, ReadsControlGroupsOfTheFirstVersionAndOfContainers) {
  write("proc/self/cgroup", "9:cpu,cpuacct:/a\n7:memory:/job\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "3000000\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1000000\n");
  EXPECT_EQ(available_bytes(root_), 2000000.0) << "its own folder is not to be seen";
}

TEST(Process, KnowsWhatItHoldsAndHeld) {
  const double before = resident_bytes();
  {
    const std::vector<char> held(64 << 20, 'x');
    EXPECT_GT(resident_bytes(), before + (60 << 20)) << held.size();
  }
  EXPECT_GE(peak_resident_bytes(), before + (60 << 20));
  EXPECT_EQ(allowed_bytes(), HUGE_VAL);
}

}  // namespace
}  // namespace wingbeat
