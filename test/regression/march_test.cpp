#include <cmath>
#include <string>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

class March : public Program {
 protected:
  nlohmann::json solve(const std::string& verb, std::vector<std::string> options, int ranks = 1) {
    const std::string output = "run-" + std::to_string(++runs_);
    std::vector<std::string> arguments{verb, case_, "mesh.cells=[48,12]", "--output", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun done = run(arguments, ranks);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return result(output);
  }
  // The third column of the last row of march.csv.
  double last_energy(const std::string& output) const {
    const std::string text = read(output + "/march.csv");
    std::string row = text.substr(text.rfind('\n', text.size() - 2) + 1);
    for (int i = 0; i < 2; ++i) row = row.substr(row.find(',') + 1);
    return std::stod(row);
  }

  const std::string case_ = std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/naca64a010/case.toml";
  int runs_ = 0;
};

// Two independent methods for the same section on the same mesh. Marching at 96 steps a period errs by
// (omega dt)^2/3 = 6e-4 in frequency, and by omega (omega dt)^3/4 in growth, some 1e-4 of V over its slope.
TEST_F(March, FindsTheFlutterPointOfTheTimeSpectralMethod) {
  const auto spectral = solve("flutter", {})["flutter"];
  const double v = spectral["reduced_velocity"], omega = spectral["frequency_ratio"];
  const std::string guess = "march.reduced_velocity=" + std::to_string(0.98 * v);
  const auto marched = solve("march", {guess, "--find-flutter"});
  EXPECT_NEAR(marched["flutter"]["reduced_velocity"].get<double>(), v, 3e-4 * v);
  EXPECT_NEAR(marched["flutter"]["frequency_ratio"].get<double>(), omega, 1e-3 * omega);
  EXPECT_LE(marched["flutter"]["reduced_velocity_error"].get<double>(), 1e-4 * v);
  EXPECT_GE(marched["marches"].size(), 2u);
  EXPECT_EQ(marched["marches"][0]["verdict"], "decays");
}

// There small motion outgrows what is small within few periods, and a march that went on would settle on a
// limit cycle, which does not grow either. The rates are known well enough for 1e-4 of V from both guesses.
TEST_F(March, FindsTheFlutterPointFromFarAboveIt) {
  const std::vector<std::string> common{"--find-flutter", "march.steps_per_period=32"};
  auto near = common, far = common;
  near.push_back("march.reduced_velocity=2.9");
  far.push_back("march.reduced_velocity=4");
  const double expected = solve("march", near)["flutter"]["reduced_velocity"];
  EXPECT_NEAR(solve("march", far)["flutter"]["reduced_velocity"].get<double>(), expected, 2e-4 * expected);
}

// A march begun again from its own levels goes on as if it had not stopped, but for the forces' prediction:
// within the tolerance, 1e-4 of what changes in a step, which is 0.04 of the motion.
TEST_F(March, GoesOnFromItsLevels) {
  const std::vector<std::string> common{"march.reduced_velocity=2.9", "march.until=end", "march.snapshots=0"};
  auto options = common;
  options.push_back("march.periods=2");
  const auto whole = solve("march", options);
  options.back() = "march.periods=1";
  solve("march", options);
  options.insert(options.end(), {"--restart", "run-2/solution.cgns"});
  const auto second = solve("march", options);
  EXPECT_EQ(whole["march"]["time_steps"], 192);
  EXPECT_EQ(second["march"]["time_steps"], 96);
  const double expected = last_energy("run-1"), found = last_energy("run-3");
  EXPECT_NEAR(found / expected, 1.0, 1e-5);
}

}  // namespace
}  // namespace wingbeat
