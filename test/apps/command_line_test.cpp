#include <cstdlib>
#include <fstream>
#include <iterator>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

class CommandLineOfProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("case.toml", "[mesh]\nairfoil = \"naca0012\"\ncells = [32, 8]\n");
  }
};

TEST_F(CommandLineOfProgram, HelpAndVersionSucceed) {
  const auto help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const std::string verb :
       {"steady", "pitch", "flutter", "lco", "pk", "mesh", "partition", "plot", "reference"})
    expect_in(verb, help.output);
  expect_in("section.key=value", run({"mesh", "--help"}).output);
  const auto version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.output.rfind("wingbeat " WINGBEAT_VERSION, 0), 0u) << version.output;
}

TEST_F(CommandLineOfProgram, WrongCommandLinesAreBadInput) {
  const auto misspelt = run({"partitoin", "case.toml"});
  EXPECT_EQ(misspelt.exit_code, 2);
  expect_in("partitoin: unknown verb; did you mean partition?", misspelt.errors);
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_EQ(run({"mesh"}).exit_code, 2);
  EXPECT_EQ(run({"mesh", "case.toml", "--unknown"}).exit_code, 2);
  const auto walltime = run({"mesh", "case.toml", "--walltime", "-3"});
  EXPECT_EQ(walltime.exit_code, 2);
  expect_in("not a number of seconds > 0", walltime.errors);
  EXPECT_EQ(run({"partition", "case.toml", "--ranks", "0"}).exit_code, 2);
  EXPECT_EQ(run({"mesh", "case.toml", "--restart", "case.toml"}).exit_code, 2) << "it has nothing to restart";
  const auto repeated = run({"pk", "case.toml", "pk.reduced_velocities=[1, 2, 2]"});
  EXPECT_EQ(repeated.exit_code, 2);
  expect_in("must rise", repeated.errors);
}

TEST_F(CommandLineOfProgram, OutputFolderIsNamedByCaseAndVerb) {
  write("wings/small.toml", "[mesh]\nairfoil = \"naca0012\"\ncells = [32, 8]\n");
  write("wings/naca/case.toml", "[mesh]\nairfoil = \"naca0012\"\ncells = [32, 8]\n");
  EXPECT_EQ(run({"mesh", "wings/small.toml"}).exit_code, 0);
  EXPECT_EQ(run({"mesh", "wings/naca/case.toml"}).exit_code, 0);
  EXPECT_EQ(run({"mesh", "wings/small.toml", "--output", "results/here"}).exit_code, 0);
  const std::set<std::string> expected{"case.toml", "log.txt", "mesh.cgns", "mesh.csv", "result.json"};
  for (const std::string output : {"small-mesh", "naca-mesh", "results/here"})
    EXPECT_EQ(files(output), expected);
}

TEST_F(CommandLineOfProgram, ResolvedCaseRunsToTheSameResult) {
  ASSERT_EQ(run({"mesh", "case.toml", "mesh.blocks=3", "--output", "first"}).exit_code, 0);
  ASSERT_EQ(run({"mesh", "first/case.toml", "--output", "second"}).exit_code, 0);
  const auto first = result("first"), second = result("second");
  EXPECT_EQ(first["mesh"], second["mesh"]);
  EXPECT_EQ(first["mesh"]["blocks"], 3);
  EXPECT_EQ(first["mesh"]["cells"], 256);
  EXPECT_EQ(first["command"], "mesh");
  EXPECT_EQ(first["status"], "converged");
  EXPECT_GT(first["wall_seconds"]["total"].get<double>(), 0.0);
  expect_in("mesh case.toml on 1 rank", read("first/case.toml"));
}

TEST_F(CommandLineOfProgram, DryRunPrintsTheResolvedCaseAndWritesNothing) {
  const auto dry = run({"mesh", "case.toml", "--dry-run", "flow.mach=0.7", "--output", "dry"});
  EXPECT_EQ(dry.exit_code, 0);
  expect_in("mach = 0.7", dry.output);
  expect_in("# command line", dry.output);
  expect_in("# 256 cells in 1 block\n", dry.output);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "dry"));
}

TEST_F(CommandLineOfProgram, RanksSpeakOnce) {
  const auto one = run({"partition", "case.toml", "--ranks", "7", "--output", "one"});
  const auto two = run({"partition", "case.toml", "--ranks", "7", "--output", "two"}, 2);
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  ASSERT_EQ(two.exit_code, 0) << two.errors;
  EXPECT_EQ(result("two")["ranks"], 2);
  EXPECT_EQ(result("one")["partition"], result("two")["partition"]);
  const std::string line = "edge cut";
  EXPECT_EQ(two.output.find(line), two.output.rfind(line));
}

TEST_F(CommandLineOfProgram, ReferencePageIsCurrent) {
  const auto page = run({"reference", "--markdown"});
  EXPECT_EQ(page.exit_code, 0);
  std::ifstream stream(WINGBEAT_SOURCE_DIR "/docs/case-reference.md");
  const std::string kept{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(page.output, kept) << "run: wingbeat reference --markdown > docs/case-reference.md";
}

TEST_F(CommandLineOfProgram, PlotDrawsWhatAFolderHolds) {
  if (std::system(
          "(python3 -c 'import matplotlib' || /usr/bin/python3 -c 'import matplotlib') 2> /dev/null") != 0)
    GTEST_SKIP() << "no matplotlib";
  ASSERT_EQ(run({"mesh", "case.toml", "--output", "out"}).exit_code, 0);
  const auto plot = run({"plot", "out"});
  EXPECT_EQ(plot.exit_code, 0) << plot.errors;
  expect_in("out/plots/mesh.png", plot.output);
  EXPECT_TRUE(files("out/plots").contains("mesh.png"));
}

TEST_F(CommandLineOfProgram, PlotRefusesAFolderWithoutTables) {
  write("empty/result.json", "{}");
  EXPECT_EQ(run({"plot", "empty"}).exit_code, 2);
}

TEST_F(CommandLineOfProgram, PlotRefusesAMissingFolder) {
  const auto plot = run({"plot", "nowhere"});
  EXPECT_EQ(plot.exit_code, 2);
  expect_in("nowhere: no such folder", plot.errors);
}

}  // namespace
}  // namespace wingbeat
