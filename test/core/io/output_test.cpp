#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "core/io/csv.hpp"
#include "core/io/error.hpp"
#include "core/io/file.hpp"
#include "core/io/log.hpp"
#include "core/io/progress.hpp"
#include "core/io/result.hpp"
#include "core/io/timer.hpp"

namespace wingbeat {
namespace {

namespace fs = std::filesystem;

class OutputFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("wingbeat-output-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(OutputFolder, WriteFileReplacesTheWholeAndLeavesNothingElse) {
  const fs::path path = folder_ / "deep" / "file.txt";
  write_file(path, "a longer first text");
  write_file(path, "second");
  EXPECT_EQ(read_file(path), "second");
  fs::rename(path, folder_ / "file.txt");
  fs::remove(folder_ / "deep");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(OutputFolder, AtomicFileWithoutCommitLeavesTheOldFileAlone) {
  const fs::path path = folder_ / "file.txt";
  write_file(path, "old");
  {
    const AtomicFile file(path);
    std::ofstream(file.temporary()) << "half-writ";
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(OutputFolder, AtomicFileKeepsTheOneBeforeAndNothingElse) {
  const auto path = folder_ / "a.txt", before = folder_ / "a.previous.txt";
  for (const char* text : {"1", "2", "3"}) {
    AtomicFile file(path);
    std::ofstream(file.temporary()) << text;
    file.commit_keeping(before);
  }
  EXPECT_EQ(read_file(path), "3");
  EXPECT_EQ(read_file(before), "2");
  // A process killed between its two renames leaves one file under both names.
  std::filesystem::remove(before);
  std::filesystem::create_hard_link(path, before);
  {
    AtomicFile file(path);
    std::ofstream(file.temporary()) << "4";
    file.commit_keeping(before);
  }
  EXPECT_EQ(read_file(path), "4");
  EXPECT_EQ(read_file(before), "3");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2);
}

TEST_F(OutputFolder, WhatKilledProcessesLeftIsRemovedAndNothingElse) {
  for (const char* name : {"solution.cgns.part-12", "a.part-", "b.part-x1", "c.part", "d.cgns"})
    std::ofstream(folder_ / name) << "text";
  remove_unfinished(folder_);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "solution.cgns.part-12"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 4);
}

TEST_F(OutputFolder, FailuresNameThePathAndTheReason) {
  write_file(folder_ / "plain", "x");
  try {
    write_file(folder_ / "plain" / "below", "y");
    FAIL() << "a file cannot be a folder";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find((folder_ / "plain").string()), std::string::npos);
  }
  try {
    read_file(folder_ / "none");
    FAIL() << "there is no such file";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
  EXPECT_THROW(read_file(folder_), InputError);
}

TEST_F(OutputFolder, ResultHoldsTheContractAndReadsBackExactly) {
  Result result{
      .command = "flutter", .status = "converged", .message = "done", .ranks = 2, .version = "1.2.3"};
  result.wall_seconds = {{"total", 1.5}, {"steady/assembly", 0.25}};
  const double v = 2.8855199999999996;
  result.findings["flutter"] = {{"reduced_velocity", v}, {"newton_iterations", 3}};
  result.write(folder_ / "result.json");
  const auto json = nlohmann::json::parse(read_file(folder_ / "result.json"));
  EXPECT_EQ(json["command"], "flutter");
  EXPECT_EQ(json["status"], "converged");
  EXPECT_EQ(json["message"], "done");
  EXPECT_EQ(json["ranks"], 2);
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["wall_seconds"]["steady/assembly"], 0.25);
  EXPECT_EQ(json["flutter"]["reduced_velocity"].get<double>(), v);
  EXPECT_EQ(file_count(), 1u);
}

TEST(Result, SurvivesValuesThatJsonCannotHold) {
  Result result{.command = "flutter", .message = "caf\xe9"};
  result.findings["steady"] = {{"cl", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_TRUE(nlohmann::json::parse(result.text())["steady"]["cl"].is_null());
}

TEST(CsvTable, QuotesWhereNeededAndKeepsNumbersExact) {
  CsvTable table({"k", "status, text"});
  table.add({CsvTable::Cell(0.1), CsvTable::Cell(std::string("a \"b\""))});
  table.add({CsvTable::Cell(3L), CsvTable::Cell(std::string("plain"))});
  EXPECT_EQ(table.text(), "k,\"status, text\"\n0.1,\"a \"\"b\"\"\"\n3,plain\n");
  EXPECT_THROW(table.add(std::vector<double>{1.0}), InternalError);
}

TEST(Timer, NestsAndAddsUp) {
  Timer timer;
  for (int pass = 0; pass < 2; ++pass) {
    auto outer = timer.measure("steady");
    auto inner = timer.measure("assembly");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  { auto other = timer.measure("newton"); }
  const auto parts = timer.parts();
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].path, "steady");
  EXPECT_EQ(parts[1].path, "steady/assembly");
  EXPECT_EQ(parts[1].depth, 1);
  EXPECT_EQ(parts[2].path, "newton");
  EXPECT_EQ(parts[1].count, 2);
  EXPECT_GE(parts[1].seconds, 0.010);
  EXPECT_GE(parts[0].seconds, parts[1].seconds);
  EXPECT_GE(timer.elapsed(), parts[0].seconds);
}

TEST(Timer, CountsPartsThatStillRun) {
  Timer timer;
  const auto running = timer.measure("running");
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_GE(timer.parts()[0].seconds, 0.002);
}

TEST(ConvergedFraction, IsTheShareOfTheLogarithm) {
  EXPECT_DOUBLE_EQ(converged_fraction(1.0, 1e-5, 1e-10), 0.5);
  EXPECT_EQ(converged_fraction(1.0, 2.0, 1e-10), 0.0);  // worse than the start
  EXPECT_EQ(converged_fraction(1.0, 1e-11, 1e-10), 1.0);
  EXPECT_EQ(converged_fraction(1e-12, 1e-11, 1e-10), 1.0);
  EXPECT_EQ(converged_fraction(1.0, std::nan(""), 1e-10), 0.0);
}

TEST(DurationText, ChangesUnits) {
  EXPECT_EQ(duration_text(8.24), "8.2 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

TEST_F(OutputFolder, BatchLogHoldsPlainLinesOnly) {
  // Standard output of a test is not a terminal here: send it to a file to be sure.
  const fs::path path = folder_ / "out.txt";
  std::fflush(stdout);
  const int kept = ::dup(STDOUT_FILENO);
  const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  ::dup2(file, STDOUT_FILENO);
  {
    Log log(true), silent(false);
    log.copy_to(folder_ / "log.txt");
    Progress progress(log, "flutter", {"iter", "V"});
    progress.row({"1", "2.9"}, 0.5);
    silent.line("not heard");
  }
  std::fflush(stdout);
  ::dup2(kept, STDOUT_FILENO);
  ::close(kept);
  ::close(file);
  const std::string text = read_file(path);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.find('\033'), std::string::npos);
  EXPECT_EQ(text.find("not heard"), std::string::npos);
  EXPECT_EQ(std::ranges::count(text, '\n'), 3);
  EXPECT_EQ(text, read_file(folder_ / "log.txt"));
}

}  // namespace
}  // namespace wingbeat
