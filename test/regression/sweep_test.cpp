// Sweeps from end to end, on coarse meshes.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <sstream>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

using Row = std::vector<std::string>;

class Sweep : public Program {
 protected:
  static std::vector<std::string> small(const std::string& output, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{
        "sweep",
        std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/naca64a010-mach/case.toml",
        "--output",
        output,
        "mesh.cells=[48,12]",
        "flutter.samples=6",
        "sweep.refine=0"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  // Column by name of sweep.csv, as texts.
  Row column(const std::string& output, const std::string& name) const {
    std::istringstream stream(read(output + "/sweep.csv"));
    Row head, cells;
    for (std::string line; std::getline(stream, line);) {
      Row row;
      std::istringstream parts(line);
      for (std::string cell; std::getline(parts, cell, ',');) row.push_back(cell);
      if (head.empty()) {
        head = row;
        continue;
      }
      cells.push_back(row.at(static_cast<std::size_t>(std::ranges::find(head, name) - head.begin())));
    }
    return cells;
  }
  void expect_same(const std::string& a, const std::string& b) const {
    EXPECT_EQ(column(a, "flow.mach"), column(b, "flow.mach"));
    EXPECT_EQ(column(a, "branch"), column(b, "branch"));
    for (const std::string name : {"reduced_velocity", "frequency_ratio"}) {
      const Row one = column(a, name), other = column(b, name);
      ASSERT_EQ(one.size(), other.size());
      for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_NEAR(std::stod(one[i]) / std::stod(other[i]), 1.0, 1e-8) << name << ' ' << i;
    }
  }
  // Of points that have ended.
  std::size_t lines(const std::string& output) const {
    std::istringstream stream(read(output + "/sweep.jsonl"));
    std::size_t count = 0;
    for (std::string line; std::getline(stream, line);) count += line.find("\"results\"") != line.npos;
    return count;
  }
};

const std::string four = "sweep.parameters=[\"flow.mach = 0.76 to 0.82 step 0.02\"]";

TEST_F(Sweep, GivesTheSameTableOnItsOwnInGroupsAndAfterAKill) {
  ASSERT_EQ(run(small("own", {four, "sweep.continuation=false"})).exit_code, 0);
  ASSERT_EQ(run(small("groups", {four, "--groups", "2"}), 2).exit_code, 0);
  expect_same("own", "groups");

  // Killed once a point is told of; the next run repeats none of those recorded.
  run_and_signal(small("killed", {four}), "converged", SIGKILL);
  const std::size_t known = lines("killed");
  ASSERT_GE(known, 1u);
  ASSERT_LT(known, 4u);
  const ProgramRun on = run(small("killed", {four}));
  ASSERT_EQ(on.exit_code, 0) << on.errors;
  EXPECT_EQ(lines("killed"), 4u);
  expect_same("own", "killed");

  // Nothing is left to do.
  ASSERT_EQ(run(small("killed", {four})).exit_code, 0);
  EXPECT_EQ(lines("killed"), 4u);
}

// From the plunge-dominated root, whose speed dips and then rises steeply, to the pitch-dominated one between
// two points 0.01 in Mach number apart, which refinement adds.
TEST_F(Sweep, ShowsBothBranchesOfTheTransonicDipAndTheSwitchBetweenThem) {
  const ProgramRun done =
      run(small("out", {"sweep.parameters=[\"flow.mach = 0.78 to 0.88 step 0.02\"]", "sweep.refine=3"}));
  ASSERT_EQ(done.exit_code, 0) << done.errors;
  EXPECT_EQ(result("out")["sweep"]["done"], 9);
  const Row mach = column("out", "flow.mach"), branch = column("out", "branch"),
            omega = column("out", "frequency_ratio");
  ASSERT_EQ(branch.size(), 9u);
  for (std::size_t i = 0; i < branch.size(); ++i) {
    const bool is_before = std::stod(mach[i]) < 0.825;
    EXPECT_EQ(branch[i], is_before ? "1" : "2") << mach[i];
    EXPECT_EQ(std::stod(omega[i]) < 0.9, is_before) << mach[i];
  }
  EXPECT_NE(std::ranges::find(mach, "0.83"), mach.end()) << "the switch is refined";
}

TEST_F(Sweep, StartsPointsFromTheirNeighbours) {
  ASSERT_EQ(run(small("out", {four})).exit_code, 0);
  const Row starts = column("out", "start");
  EXPECT_EQ(starts.front(), "none");
  EXPECT_TRUE(std::all_of(starts.begin() + 1, starts.end(),
                          [](const std::string& start) { return start.starts_with("point "); }));
  // The second point goes on with the first one's factors of the harmonic, and with those of its steady flow.
  EXPECT_EQ(result("out/points/0002")["flutter"]["factorizations"], 0);
}

TEST_F(Sweep, KeepsPointsThatFailWithTheirReasonAndTriesThemAgainWhenAsked) {
  // No root below this reduced frequency.
  const std::vector<std::string> options{
      "sweep.parameters=[\"flutter.reduced_frequency_range = [[0.02, 0.6], [0.02, 0.03]]\"]"};
  const ProgramRun first = run(small("out", options));
  EXPECT_EQ(first.exit_code, 1);
  expect_in("1 of 2 points done; 1 failed", first.errors);
  expect_in("stalled", read("out/sweep.csv"));
  expect_in("no flutter root", read("out/sweep.csv"));
  const ProgramRun second = run(small("out", options));
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_EQ(lines("out"), 2u) << "a failed point is left as it is";
  auto retried = options;
  retried.push_back("--retry-failed");
  EXPECT_EQ(run(small("out", retried)).exit_code, 1);
  EXPECT_EQ(lines("out"), 3u);
}

TEST_F(Sweep, RefusesPointsThatTheVerbRefusesBeforeAnyIsRun) {
  const auto refused = [&](const std::vector<std::string>& options, const std::string& message) {
    auto arguments = small("out", options);
    arguments.push_back("--dry-run");
    const ProgramRun run = this->run(arguments);
    EXPECT_EQ(run.exit_code, 2);
    expect_in(message, run.errors);
  };
  refused({"sweep.parameters=[\"flow.mach = [0.8, 7.0]\"]"},
          "the point flow.mach = 7.0: sweep: flow.mach=7.0");
  refused({"sweep.parameters=[\"flow.mch = [0.8]\"]"}, "did you mean flow.mach?");
  refused({"sweep.parameters=[]"}, "sweep.parameters: missing");
  refused({"sweep.refine=3", "sweep.parameters=[\"flow.scheme = ['jst', 'roe']\"]"}, "sweep.refine");
  const ProgramRun groups = run(small("out", {four, "--groups", "3"}), 2);
  EXPECT_EQ(groups.exit_code, 2);
  expect_in("the run has 2 ranks", groups.errors);
}

TEST_F(Sweep, RefusesTheRecordOfAnotherCaseAndLeavesItAsItIs) {
  const std::string one = "sweep.parameters=[\"flow.mach = [0.8]\"]";
  ASSERT_EQ(run(small("out", {one})).exit_code, 0);
  const std::string before = read("out/sweep.jsonl");
  const ProgramRun other = run(small("out", {one, "structure.mass_ratio=60"}));
  EXPECT_EQ(other.exit_code, 2);
  expect_in("structure.mass_ratio", other.errors);
  EXPECT_EQ(read("out/sweep.jsonl"), before);
}

TEST_F(Sweep, StopsAtASignalAndGoesOnWithTheRest) {
  EXPECT_EQ(run_and_signal(small("out", {four}), "converged", SIGUSR1), 4);
  EXPECT_EQ(result("out")["status"], "interrupted");
  EXPECT_GE(result("out")["sweep"]["left"], 1);
  EXPECT_EQ(run(small("out", {four})).exit_code, 0);
  EXPECT_EQ(result("out")["sweep"]["done"], 4);
}

// Other verbs make rows of what they find.
TEST_F(Sweep, RunsAnyVerbOverAGridOfAnyKeys) {
  const ProgramRun done = run(small(
      "out", {"sweep.verb=steady",
              "sweep.parameters=[\"flow.mach = [0.7, 0.75]\", \"flow.angle_of_attack_deg = 0 to 1 in 2\"]"}));
  ASSERT_EQ(done.exit_code, 0) << done.errors;
  const Row lift = column("out", "cl");
  ASSERT_EQ(lift.size(), 4u);
  EXPECT_NEAR(std::stod(lift[0]), 0.0, 1e-8);
  EXPECT_GT(std::stod(lift[3]), std::stod(lift[1])) << "lift grows with Mach number";
}

}  // namespace
}  // namespace wingbeat
