#include <cmath>

#include "test/apps/program.hpp"
#include "test/nightly.hpp"

namespace wingbeat {
namespace {

// Flow and structure by turns, and all rows at once, solve the same equations. The flow residual allowed,
// 1e-10, over the least pitch amplitude here, 3e-4 rad, leaves loads, V and omega some 3e-7.
constexpr double method_tolerance = 1e-6;

class Staggered : public Program {
 protected:
  nlohmann::json solve(const std::string& verb, std::vector<std::string> options, int ranks = 1) {
    const std::string output = "run-" + std::to_string(++runs_);
    std::vector<std::string> arguments{verb, case_, "--output", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun done = run(arguments, ranks);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return result(output)[verb];
  }
  std::string last_output() const { return "run-" + std::to_string(runs_); }

  const std::string case_ = std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/naca64a010/case.toml";
  int runs_ = 0;
};

void expect_same_point(const nlohmann::json& a, const nlohmann::json& b) {
  for (const char* key : {"reduced_velocity", "frequency_ratio"})
    EXPECT_NEAR(a[key].get<double>(), b[key].get<double>(), method_tolerance) << key;
}

void expect_by_turns(const nlohmann::json& solved) {
  EXPECT_GT(solved["staggered_iterations"], 0);
  EXPECT_GT(solved["flow_cycles"], 0);
  EXPECT_EQ(solved["newton_iterations"], 0);
  EXPECT_LE(solved["residuals"]["flow"], 1e-10);
  EXPECT_LE(solved["residuals"]["structure"], 1e-9);
}

// The same point of the paper's section on any mesh, at the flutter boundary and well into a limit cycle.
class StaggeredOnMesh : public Staggered {
 protected:
  void expect_methods_agree(const std::string& cells, const std::vector<int>& ranks, bool finishes) {
    for (const std::string energy : {"1e-6", "5e-3"}) {
      const std::vector<std::string> common{"mesh.cells=" + cells, "flutter.energy=" + energy};
      auto staggered = common;
      staggered.push_back("solver.method=staggered");
      const auto coupled = solve("flutter", common, ranks.front());
      EXPECT_EQ(coupled["flow_cycles"], 0);
      for (const int n : ranks) {
        const auto turns = solve("flutter", staggered, n);
        expect_by_turns(turns);
        expect_same_point(coupled, turns);
        EXPECT_NEAR(turns["energy"].get<double>() / std::stod(energy), 1.0, 1e-8);
      }
      if (!finishes) continue;
      staggered.push_back("solver.flow_method=runge_kutta_newton");
      const auto finished = solve("flutter", staggered);
      EXPECT_GT(finished["newton_iterations"], 0);
      EXPECT_GT(finished["flow_cycles"], 0);
      EXPECT_LE(finished["residuals"]["flow"], 1e-10);
      expect_same_point(coupled, finished);
    }
  }
};

TEST_F(StaggeredOnMesh, AndCoupledGiveTheSameFlutterPointAndLimitCycle) {
  expect_methods_agree("[96,24]", {1, 2}, true);
}

TEST_F(StaggeredOnMesh, AndCoupledAgreeOnThePapersMeshes) {
  if (!testing::is_nightly()) GTEST_SKIP() << "set WINGBEAT_NIGHTLY=1";
  for (const std::string cells : {"[250,50]", "[256,64]"}) expect_methods_agree(cells, {2}, false);
}

// dV/dE is about 25 on this branch: a speed known to 1e-8 leaves E = 4e-3 some 1e-7 of itself.
TEST_F(Staggered, GivenSpeedReturnsTheEnergyWhoseSpeedItIs) {
  const std::vector<std::string> coarse{"mesh.cells=[48,12]"};
  const auto branch = solve("lco", {coarse[0], "lco.energies=[1e-3, 4e-3]"});
  ASSERT_EQ(branch.size(), 2u);
  EXPECT_TRUE(files(last_output()).contains("lco.csv"));
  EXPECT_NEAR(branch[0]["energy"], 1e-3, 1e-11);
  EXPECT_NEAR(branch[1]["energy"], 4e-3, 4e-11);
  EXPECT_GT(branch[1]["reduced_velocity"].get<double>(), branch[0]["reduced_velocity"].get<double>() + 0.01);
  const std::string speed = "lco.reduced_velocity=" + branch[1]["reduced_velocity"].dump();
  const std::vector<std::vector<std::string>> methods{
      {}, {"solver.method=staggered"}, {"solver.method=staggered", "solver.flow_method=runge_kutta_newton"}};
  for (const auto& method : methods) {
    std::vector<std::string> options{coarse[0], "lco.energies=[1e-3]", speed};
    options.insert(options.end(), method.begin(), method.end());
    const auto found = solve("lco", options);
    ASSERT_EQ(found.size(), 2u);
    expect_same_point(found[0], branch[0]);
    expect_same_point(found[1], branch[1]);
    EXPECT_NEAR(found[1]["energy"].get<double>() / branch[1]["energy"].get<double>(), 1.0, 1e-5);
    if (method.size() == 1) expect_by_turns(found[1]);
  }
}

}  // namespace
}  // namespace wingbeat
