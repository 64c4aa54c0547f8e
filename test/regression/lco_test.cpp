#include <cmath>
#include <sstream>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

// The residual allowed, 1e-10 of uniform flow's, over a pitch amplitude of 0.01 rad leaves loads some 1e-8 of
// themselves, and V, which is their root, and omega as much. dV/dE is above 20 here: E = 1e-3 is known to
// 1e-6.
constexpr double cycle_tolerance = 1e-8;
constexpr double energy_tolerance = 1e-6;

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string& csv) {
  Rows rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

class Lco : public Program {
 protected:
  ProgramRun start(const std::string& output, std::vector<std::string> options, int ranks = 1) const {
    std::vector<std::string> arguments{"lco", case_, "mesh.cells=[48,12]", "--output", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments, ranks);
  }
  nlohmann::json solve(const std::string& output, const std::vector<std::string>& options,
                       int ranks = 1) const {
    const ProgramRun done = start(output, options, ranks);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return result(output)["lco"];
  }
  // lco.csv below its heading.
  Rows branch(const std::string& output) const {
    Rows rows = rows_of(read(output + "/lco.csv"));
    rows.erase(rows.begin());
    return rows;
  }

  const std::string case_ = std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/naca64a010/case.toml";
};

void expect_same_cycle(const nlohmann::json& a, const nlohmann::json& b) {
  for (const char* key : {"reduced_velocity", "frequency_ratio"})
    EXPECT_NEAR(a[key].get<double>(), b[key].get<double>(), cycle_tolerance * b[key].get<double>()) << key;
  const double energy = b["energy"];
  EXPECT_NEAR(a["energy"].get<double>(), energy, energy_tolerance * energy);
}

// The staggered iteration ends with a structural residual of 1e-9, over amplitudes of 0.01 some 1e-7.
TEST_F(Lco, BranchAndIterationByTurnsFindTheSameCycles) {
  const std::vector<std::string> energies{"time.harmonics=2", "lco.energies=[1e-3, 4e-3]"};
  const auto branch = solve("branch", energies);
  const auto turns = solve("turns", {energies[0], energies[1], "solver.method=staggered"});
  ASSERT_EQ(branch.size(), 2u);
  ASSERT_EQ(turns.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    for (const char* key : {"energy", "reduced_velocity", "frequency_ratio", "pitch_amplitude_deg"})
      EXPECT_NEAR(turns[i][key].get<double>() / branch[i][key].get<double>(), 1.0, 1e-6) << key;
}

TEST_F(Lco, CycleOfASpeedIsTheCycleOfItsEnergyOnAnyRanks) {
  const auto by_energy = solve("energy", {"time.harmonics=2", "lco.energies=[3e-3]"});
  ASSERT_EQ(by_energy.size(), 1u);
  EXPECT_NEAR(by_energy[0]["energy"].get<double>(), 3e-3, 3e-11);
  const std::string v = "lco.reduced_velocity=" + by_energy[0]["reduced_velocity"].dump();
  for (const int ranks : {1, 2}) {
    const auto by_speed = solve("speed-" + std::to_string(ranks), {"time.harmonics=2", v}, ranks);
    ASSERT_EQ(by_speed.size(), 1u);
    expect_same_cycle(by_speed[0], by_energy[0]);
  }
}

TEST_F(Lco, RestartTakesOverTheBranchAndRepeatsNothing) {
  solve("part", {"lco.energies=[1e-3]"});
  const auto whole = solve("whole", {"lco.energies=[1e-3, 4e-3]"});
  const auto resumed = solve("resumed", {"lco.energies=[1e-3, 4e-3]", "--restart", "part/solution.cgns"});
  ASSERT_EQ(resumed.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) expect_same_cycle(resumed[i], whole[i]);

  const Rows before = branch("part"), after = branch("resumed");
  ASSERT_GT(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(after[i], before[i]);
  for (std::size_t i = 1; i < after.size(); ++i)
    EXPECT_GT(std::stod(after[i][2]), 1.01 * std::stod(after[i - 1][2])) << "row " << i;

  const auto again = solve("again", {"lco.energies=[1e-3, 4e-3]", "--restart", "resumed/solution.cgns"});
  EXPECT_EQ(again, resumed);
  EXPECT_EQ(branch("again"), after);
}

TEST_F(Lco, RestartFromABranchOfAnotherCaseIsRefusedByItsKey) {
  solve("part", {"lco.energies=[1e-4]"});
  const ProgramRun refused =
      start("refused", {"flow.mach=0.81", "lco.energies=[1e-4]", "--restart", "part/solution.cgns"});
  expect_refused(refused, "refused", "flow.mach");
}

TEST_F(Lco, HarmonicsAreAddedWhereTheHighestCarriesMoreThanItsShare) {
  const auto grown = solve("grown", {"lco.energies=[1e-3, 4e-3]", "lco.harmonic_share=2e-5"});
  ASSERT_EQ(grown.size(), 2u);
  EXPECT_EQ(grown[0]["harmonics"], 2);
  EXPECT_EQ(grown[1]["harmonics"], 3);
  for (const auto& cycle : grown) EXPECT_LE(cycle["highest_harmonic_share"].get<double>(), 2e-5);
  const auto fixed = solve("fixed", {"lco.energies=[4e-3]", "time.harmonics=3"});
  expect_same_cycle(grown[1], fixed[0]);
}

TEST_F(Lco, SpeedTheBranchDoesNotReachEndsWithTheReason) {
  const ProgramRun done = start("short", {"lco.reduced_velocity=3.5", "lco.max_energy=1e-3"});
  EXPECT_EQ(done.exit_code, 1);
  expect_in("no cycle was found at lco.reduced_velocity = 3.5 up to lco.max_energy = 0.001", done.errors);
  expect_in("the branch ends at E_0", done.errors);
  EXPECT_EQ(result("short")["status"], "stalled");
  EXPECT_GE(branch("short").size(), 3u);
}

// Below its onset a supercritical branch has no cycle; rest solves all rows there.
TEST_F(Lco, RestIsNoCycleOfAGivenSpeed) {
  const ProgramRun done =
      run({"lco", case_, "mesh.cells=[64,16]", "lco.reduced_velocity=2.74", "--output", "rest"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(result("rest")["status"], "stalled");
}

}  // namespace
}  // namespace wingbeat
