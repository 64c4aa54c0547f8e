#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "test/optimize/toy_programs.hpp"

// What Ipopt writes and reads besides the programme.
namespace wingbeat {
namespace {

namespace fs = std::filesystem;

// Works in an empty folder for as long as it lives.
class EmptyFolder {
 public:
  EmptyFolder() : before_(fs::current_path()) {
    std::string name = (fs::temp_directory_path() / "wingbeat_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder_ = name;
    fs::current_path(folder_);
  }
  ~EmptyFolder() {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }
  EmptyFolder(const EmptyFolder&) = delete;
  EmptyFolder& operator=(const EmptyFolder&) = delete;

  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

 private:
  fs::path before_, folder_;
};

std::vector<std::string> lines_of(const IpoptOptions& options) {
  ToyProgram program = hock_schittkowski_71();
  std::vector<std::string> lines;
  run_ipopt(program, options, [&](std::string_view line) { lines.emplace_back(line); });
  return lines;
}

bool contains(const std::vector<std::string>& lines, std::string_view text) {
  return std::ranges::any_of(lines,
                             [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

TEST(IpoptText, GoesLineByLineToTheCallerAndNowhereElse) {
  const EmptyFolder folder;
  testing::internal::CaptureStdout();
  const auto lines = lines_of({});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_TRUE(contains(lines, "EXIT: Optimal Solution Found."));
  EXPECT_TRUE(contains(lines, "inf_pr"));
  EXPECT_FALSE(contains(lines, "\n"));
  EXPECT_FALSE(contains(lines, "Eclipse")) << "the banner";
  EXPECT_EQ(folder.file_count(), 0U);
}

TEST(IpoptText, IsAsLongAsThePrintLevelAsks) {
  EXPECT_TRUE(lines_of({.extra = {"print_level = 0"}}).empty());
  EXPECT_GT(lines_of({.extra = {"print_level = 6"}}).size(), lines_of({}).size());
}

TEST(IpoptText, NoFileOfOptionsIsRead) {
  const EmptyFolder folder;
  std::ofstream("ipopt.opt") << "max_iter 1\n";
  ToyProgram program = hock_schittkowski_71();
  EXPECT_EQ(minimize(program).status, OptimizerStatus::converged);
}

}  // namespace
}  // namespace wingbeat
