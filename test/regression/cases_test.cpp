// The cases that come with the program, on coarse meshes: against each other and against kept figures.
#include <algorithm>
#include <cmath>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

class Cases : public Program {
 protected:
  nlohmann::json solve(const std::string& verb, const std::string& name, std::vector<std::string> options) {
    const std::string output = verb + "-" + std::to_string(++runs_);
    std::vector<std::string> arguments{
        verb, std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/" + name + "/case.toml", "--output", output,
        "mesh.cells=[64,16]"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun done = run(arguments, 1);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return result(output);
  }
  // V of the cycles of these energies, in their order.
  std::vector<double> speeds(const std::string& name, const std::string& energies,
                             std::vector<std::string> options = {"time.harmonics=1"}) {
    options.push_back("lco.energies=" + energies);
    std::vector<double> found;
    const nlohmann::json solved = solve("lco", name, options);
    for (const auto& cycle : solved["lco"]) found.push_back(cycle["reduced_velocity"]);
    return found;
  }
  int runs_ = 0;
};

// Solutions are converged to nine digits or more; the figures kept have six.
constexpr double kept = 2e-6;

TEST_F(Cases, IsogaiAFluttersAlikeByThreeMethods) {
  const auto by_pk = solve("pk", "isogai-a", {"pk.frequencies=12", "pk.samples=30"});
  const auto coupled = solve("flutter", "isogai-a", {});
  const double linear = by_pk["linear_flutter"]["reduced_velocity"];
  EXPECT_NEAR(by_pk["pk"]["crossings"][0]["reduced_velocity"].get<double>() / linear, 1.0, 1e-8);
  // E_0 = 1e-6 moves V by a term in E_0.
  EXPECT_NEAR(coupled["flutter"]["reduced_velocity"].get<double>() / linear, 1.0, 1e-4);
  // Kept from `wingbeat flutter` on this mesh.
  EXPECT_NEAR(coupled["flutter"]["reduced_velocity"], 3.050937, kept);
  EXPECT_NEAR(coupled["flutter"]["frequency_ratio"], 0.959968, kept);
}

TEST_F(Cases, FlutterByIncompleteFactorsIsThatByExactOnes) {
  const auto exact = solve("flutter", "naca64a010", {})["flutter"];
  const auto incomplete = solve("flutter", "naca64a010", {"solver.subdomain=ilu"})["flutter"];
  for (const char* key : {"reduced_velocity", "frequency_ratio"})
    EXPECT_NEAR(incomplete[key].get<double>() / exact[key].get<double>(), 1.0, 1e-8) << key;
  EXPECT_GT(incomplete["factor_megabytes"], 0.0);
  EXPECT_LT(incomplete["factor_megabytes"], 0.6 * exact["factor_megabytes"].get<double>());
}

TEST_F(Cases, IsogaiAHasItsTransonicDip) {
  const auto speed = [&](const std::string& mach) {
    return solve("flutter", "isogai-a", {"flow.mach=" + mach})["flutter"]["speed_index"].get<double>();
  };
  const double before = speed("0.75"), bottom = speed("0.85"), behind = speed("0.875");
  EXPECT_LT(bottom, 0.5 * before);
  EXPECT_LT(bottom, 0.95 * behind);
}

TEST_F(Cases, TheSubcriticalBranchFallsAndTurns) {
  const auto v = speeds("naca64a010-subcritical", "[1e-6,6e-3,2e-2]");
  ASSERT_EQ(v.size(), 3u);
  const double linear = solve("pk", "naca64a010-subcritical",
                              {"pk.frequencies=12", "pk.samples=20"})["linear_flutter"]["reduced_velocity"];
  EXPECT_NEAR(v[0] / linear, 1.0, 1e-4);
  EXPECT_LT(v[1], 0.92 * v[0]);
  EXPECT_GT(v[2], 1.1 * v[0]);
  // Kept from `wingbeat lco` on this mesh with one harmonic.
  EXPECT_NEAR(v[1], 2.470904, kept);
  EXPECT_NEAR(v[2], 3.185232, kept);
}

TEST_F(Cases, TheCubicPlungeSpringTurnsARisingBranch) {
  const auto v = speeds("naca64a010-plunge-cubic", "[1e-6,4e-3,1e-2]");
  ASSERT_EQ(v.size(), 3u);
  EXPECT_GT(v[1], v[0]);
  EXPECT_LT(v[2], v[1]);
  EXPECT_NEAR(v[1], 2.784595, kept);
  EXPECT_NEAR(v[2], 2.740451, kept);
}

// Far outside the gap the section forgets it: the speed tends to that without freeplay.
TEST_F(Cases, FreeplayInPitchLowersTheSpeedOfSmallCycles) {
  const auto v = speeds("naca64a010-pitch-freeplay", "[4e-3,1e-2]");
  const auto without = speeds("naca64a010-pitch-freeplay", "[4e-3,1e-2]",
                              {"time.harmonics=1", "structure.pitch_freeplay_deg=0"});
  ASSERT_EQ(v.size(), 2u);
  ASSERT_EQ(without.size(), 2u);
  EXPECT_LT(v[0] / without[0], v[1] / without[1]);
  EXPECT_LT(v[1] / without[1], 0.9);
  EXPECT_NEAR(v[0], 2.320108, kept);
  EXPECT_NEAR(v[1], 2.599635, kept);
}

}  // namespace
}  // namespace wingbeat
