#include <cmath>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

class Gradient : public Program {
 protected:
  const std::string case_ = std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/naca64a010/case.toml";

  nlohmann::json gradient(const std::string& output, std::vector<std::string> options, int ranks = 1) {
    std::vector<std::string> arguments{"gradient", case_, "mesh.cells=[64,16]", "--output", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun done = run(arguments, ranks);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return result(output)["gradient"];
  }
};

const std::vector<std::string> everything{
    "gradient.parameters=[\"bumps\",\"mach\",\"angle_of_attack\",\"structure\"]"};

std::vector<double> derivatives(const nlohmann::json& gradient) {
  std::vector<double> values;
  for (const auto& entry : gradient["design"]) values.push_back(entry["derivative"]);
  return values;
}

TEST_F(Gradient, OfTheFlutterSpeedPassesItsChecks) {
  std::vector<std::string> options = everything;
  options.insert(options.end(), {"--check", "gradient.max_differences=0"});
  const auto g = gradient("checked", options);
  EXPECT_EQ(g["objective"], "flutter_speed");
  EXPECT_EQ(g["design"].size(), 31U);
  EXPECT_LE(g["check"]["transpose"], 1e-12);
  EXPECT_LE(g["check"]["tangent"], 1e-9);
  EXPECT_LE(g["check"]["finite_difference"], 1e-6);
  EXPECT_LE(g["adjoint"]["iterations"], 50);
  EXPECT_EQ(files("checked").count("step_study.csv"), 1U);
  EXPECT_EQ(files("checked").count("wall.csv"), 1U);
  EXPECT_EQ(files("checked").count("bumps.csv"), 1U);
}

// A solution within the primal's tolerances, another order of sums, and Schwarz in place of LU: eight digits
// are left of the largest derivatives.
TEST_F(Gradient, IsTheSameOnAnyRanks) {
  std::vector<std::string> options = everything;
  options.insert(options.end(), {"gradient.tolerance=1e-12", "solver.flow_tolerance=1e-11"});
  const std::vector<double> one = derivatives(gradient("one", options));
  double size = 0.0;
  for (double value : one) size = std::max(size, std::abs(value));
  for (int ranks : {2, 3}) {
    const std::vector<double> more = derivatives(gradient("more-" + std::to_string(ranks), options, ranks));
    ASSERT_EQ(more.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i)
      EXPECT_NEAR(more[i], one[i], 1e-8 * size) << i << " on " << ranks << " ranks";
  }
}

TEST_F(Gradient, StartsFromTheSolutionOfAnEarlierRun) {
  const ProgramRun flutter = run({"flutter", case_, "mesh.cells=[64,16]", "--output", "flutter"});
  ASSERT_EQ(flutter.exit_code, 0) << flutter.errors;
  const auto again = gradient("again", {"--restart", "flutter/solution.cgns"});
  const auto anew = gradient("anew", {});
  const std::vector<double> a = derivatives(again), b = derivatives(anew);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-6 * std::abs(b[5])) << i;
}

TEST_F(Gradient, OfIncompleteFactorsIsThatOfExactOnes) {
  const std::vector<double> exact = derivatives(gradient("lu", {}));
  const std::vector<double> incomplete = derivatives(gradient("ilu", {"solver.subdomain=ilu"}));
  for (std::size_t i = 0; i < exact.size(); ++i)
    EXPECT_NEAR(incomplete[i], exact[i], 1e-6 * std::abs(exact[5])) << i;
}

TEST_F(Gradient, WritesTheDerivativeByEveryNode) {
  gradient("nodes", {"gradient.parameters=[\"nodes\"]", "gradient.objective=drag"});
  const std::string table = read("nodes/nodes.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 64 * 17);
}

TEST_F(Gradient, RefusesWhatHasNotConvergedByName) {
  const ProgramRun done =
      run({"gradient", case_, "mesh.cells=[64,16]", "solver.max_newton_iterations=1", "--output", "short"});
  EXPECT_EQ(done.exit_code, 1);
  const auto entry = result("short");
  EXPECT_FALSE(entry.contains("gradient"));
  expect_in("the flutter point has not converged: no gradient of flutter_speed is given", entry["message"]);
}

TEST_F(Gradient, RefusesObjectivesThatLackTheirKeys) {
  expect_refused(run({"gradient", case_, "gradient.objective=lco_amplitude", "--output", "a"}), "a",
                 "lco.reduced_velocity: missing; gradient.objective = \"lco_amplitude\"");
  expect_refused(run({"gradient", case_, "gradient.objective=lco_speed", "--output", "b"}), "b",
                 "lco.energies: gradient.objective = \"lco_speed\" is of the cycle of one given E_0");
  expect_refused(run({"gradient", case_, "gradient.fixed_lift=true", "--output", "c"}), "c",
                 "gradient.fixed_lift: holds the lift of steady drag or moment");
  expect_refused(run({"gradient", case_, "gradient.objective=darg", "--output", "d"}), "d", "did you mean");
}

}  // namespace
}  // namespace wingbeat
