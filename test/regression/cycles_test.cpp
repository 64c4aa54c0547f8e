#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

// Runge-Kutta cycles and Newton drive the same residuals to 1e-10 of uniform flow's, which leaves the
// loads three digits more than compared here.
constexpr double load_tolerance = 1e-7;

class FlowByCycles : public Program {
 protected:
  nlohmann::json solve(const std::string& verb, const std::string& file, const std::string& cells,
                       const std::string& flow_method) {
    const std::string output = verb + "-" + flow_method;
    const int ranks = flow_method == "runge_kutta" ? 2 : 1;
    const ProgramRun done = run(
        {verb, file, "mesh.cells=" + cells, "solver.flow_method=" + flow_method, "--output", output}, ranks);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return result(output)[verb];
  }
};

// Which of the two solvers did the work.
void expect_solved_by(const nlohmann::json& solved, bool cycles, bool newton) {
  EXPECT_EQ(solved["cycles"] > 0, cycles);
  EXPECT_EQ(solved["iterations"] > 0, newton);
  EXPECT_LE(solved["residual"], 1e-10);
}

TEST_F(FlowByCycles, GivesTheSteadyLoadsOfNewton) {
  write("case.toml", "[mesh]\nairfoil = \"naca0012\"\n[flow]\nmach = 0.8\nangle_of_attack_deg = 1.25\n");
  const auto newton = solve("steady", "case.toml", "[96,24]", "newton");
  expect_solved_by(newton, false, true);
  EXPECT_GT(newton["cl"], 0.3);
  for (const std::string method : {"runge_kutta", "runge_kutta_newton"}) {
    const auto cycles = solve("steady", "case.toml", "[96,24]", method);
    expect_solved_by(cycles, true, method == "runge_kutta_newton");
    for (const char* load : {"cl", "cd", "cm"})
      EXPECT_NEAR(cycles[load], newton[load], load_tolerance) << method << ' ' << load;
  }
}

TEST_F(FlowByCycles, GivesTheHarmonicsOfNewtonInForcedPitch) {
  const std::string ct6 = std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/agard-ct6/case.toml";
  const auto newton = solve("pitch", ct6, "[64,16]", "newton");
  expect_solved_by(newton, false, true);
  for (const std::string method : {"runge_kutta", "runge_kutta_newton"}) {
    const auto cycles = solve("pitch", ct6, "[64,16]", method);
    expect_solved_by(cycles, true, method == "runge_kutta_newton");
    for (std::size_t n : {0, 1})
      for (const char* load : {"cl", "cd", "cm"})
        for (std::size_t part : {0, 1})
          EXPECT_NEAR(cycles["harmonics"][n][load][part], newton["harmonics"][n][load][part], load_tolerance)
              << method << ' ' << load << ' ' << n;
  }
}

}  // namespace
}  // namespace wingbeat
