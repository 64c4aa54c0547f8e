#include <unistd.h>

#include <filesystem>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

namespace fs = std::filesystem;

const std::string steady_case =
    "[mesh]\nairfoil = \"naca64a010\"\ncells = [48, 12]\n[flow]\nmach = 0.7\n[structure]\nelastic_axis = "
    "-0.6\n"
    "static_unbalance = 0.25\ngyration_radius_squared = 0.75\nfrequency_ratio = 0.5\nmass_ratio = 75\n"
    "[march]\nreduced_velocity = 2.5\nperiods = 3\n";

// A disk that takes no more, as a limit of the size of a file stands for it.
class FullDisk : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("case.toml", steady_case);
    before_ = program_;
  }
  // From now on files end after so many kilobytes.
  void limit_files(int kilobytes) {
    // Open MPI's own shared memory must not come under the limit.
    write("limited", "#!/bin/sh\nexport PMIX_MCA_gds=hash\ntrap '' XFSZ\nulimit -f " +
                         std::to_string(2 * kilobytes) + "\nexec '" + before_ + "' \"$@\"\n");
    fs::permissions(folder_ / "limited", fs::perms::owner_all);
    program_ = (folder_ / "limited").string();
  }
  void expect_nothing_half_written() const {
    for (const auto& name : files("out")) EXPECT_EQ(name.find(".part"), std::string::npos) << name;
    EXPECT_FALSE(files("out").contains("lock"));
  }

  std::string before_;
};

TEST_F(FullDisk, LeavesTheEarlierSolutionAndSaysWhatCouldNotBeWritten) {
  ASSERT_EQ(run({"steady", "case.toml", "--output", "out"}).exit_code, 0);
  const std::string solution = read("out/solution.cgns");
  ASSERT_GT(solution.size(), 20000U);
  limit_files(16);
  const auto full = run({"steady", "case.toml", "--output", "out"});
  EXPECT_EQ(full.exit_code, 2) << full.errors;
  expect_in("out/solution.cgns: ", full.errors);
  expect_in("out/solution.cgns: ", result("out")["message"].get<std::string>());
  EXPECT_TRUE(read("out/solution.cgns") == solution) << "the earlier one";
  expect_nothing_half_written();
}

TEST_F(FullDisk, EndsAMarchWhoseTableCannotBeWritten) {
  fs::create_directories(folder_ / "out");
  fs::create_symlink("/dev/full", folder_ / "out/march.csv");
  const auto full = run({"march", "case.toml", "--output", "out"}, 2);
  EXPECT_EQ(full.exit_code, 2) << full.errors;
  expect_in("out/march.csv: cannot write the file: No space left on device", full.errors);
  expect_in("out/march.csv: cannot write", result("out")["message"].get<std::string>());
}

class Folder : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("case.toml", steady_case);
  }
};

TEST_F(Folder, ThatCannotBeWrittenIsRefusedAtOnce) {
  const auto refused = run({"steady", "case.toml", "--output", "/proc/wingbeat"}, 2);
  EXPECT_EQ(refused.exit_code, 2);
  expect_in("/proc/wingbeat: cannot create the folder: ", refused.errors);
  if (::geteuid() == 0) return;  // whom no permission stops
  fs::create_directories(folder_ / "out");
  fs::permissions(folder_ / "out", fs::perms::owner_read | fs::perms::owner_exec);
  const auto denied = run({"steady", "case.toml", "--output", "out"});
  EXPECT_EQ(denied.exit_code, 2);
  expect_in("out/lock: cannot write the file: Permission denied", denied.errors);
}

}  // namespace
}  // namespace wingbeat
