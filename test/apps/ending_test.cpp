#include <csignal>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

// Cycles that do not get to the end say why and what to do, and leave a solution to go on from.
class CyclesEnd : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("case.toml", small_case() + "[solver]\nflow_method = \"runge_kutta\"\n");
  }

  // The result must have this status and this part of a message, and a solution.
  void expect_ended(const std::string& status, const std::vector<std::string>& advice) const {
    const auto json = result("out");
    EXPECT_EQ(json["status"], status);
    for (const std::string& part : advice) expect_in(part, json["message"].get<std::string>());
    EXPECT_TRUE(files("out").contains("solution.cgns"));
    EXPECT_TRUE(files("out").contains("history.csv"));
  }
};

TEST_F(CyclesEnd, AtTheirLimitWithAdvice) {
  for (const std::string verb : {"steady", "pitch", "flutter"}) {
    const auto limited = run({verb, "case.toml", "--output", "out", "pseudo_time.max_cycles=5"});
    EXPECT_EQ(limited.exit_code, 1) << limited.errors;
    const std::vector<std::string> advice{"pseudo_time.max_cycles = 5", "--restart and this folder",
                                          "solver.flow_method = runge_kutta_newton"};
    expect_ended("iteration-limit", advice);
    for (const std::string& part : advice) expect_in(part, limited.errors);
  }
}

TEST_F(CyclesEnd, InTurnsWithTheStructureAtTheirLimitAndGoOnFromThere) {
  const std::vector<std::string> staggered{"flutter", "case.toml", "solver.method=staggered", "--output"};
  auto limited = staggered, on = staggered;
  limited.insert(limited.end(), {"out", "staggered.max_iterations=20"});
  EXPECT_EQ(run(limited).exit_code, 1);
  expect_ended("iteration-limit", {"staggered.max_iterations = 20", "--restart and this folder"});
  on.insert(on.end(), {"on", "--restart", "out/solution.cgns"});
  EXPECT_EQ(run(on, 2).exit_code, 0);
  EXPECT_FALSE(result("on").contains("steady")) << "a periodic solution goes straight on";
}

TEST_F(CyclesEnd, WithoutAFlowWhereStepsAreTooLong) {
  const auto diverged = run({"steady", "case.toml", "--output", "out", "pseudo_time.cfl=60",
                             "pseudo_time.smoothing=0", "pseudo_time.max_retreats=0"},
                            2);
  EXPECT_EQ(diverged.exit_code, 1) << diverged.errors;
  expect_ended("diverged", {"pseudo_time.max_retreats = 0", "smaller pseudo_time.cfl", "wingbeat mesh",
                            "the flow broke down in instance 1 of 1, block \"block-1\", cell ("});
  EXPECT_LT(result("out")["steady"]["residual"], 50.0) << "the last good state is what is left";
  // Half the number often enough is small enough.
  const auto saved = run({"steady", "case.toml", "--output", "out", "pseudo_time.cfl=60"}, 2);
  EXPECT_EQ(saved.exit_code, 0) << saved.errors;
}

// A tolerance out of reach keeps the program at work until it is told to stop.
TEST_F(CyclesEnd, WhenTheWallTimeIsUsedUpAndGoOnFromThere) {
  for (const std::string verb : {"steady", "pitch"}) {
    const auto stopped = run({verb, "case.toml", "--output", "out", "--walltime", "0.5",
                              "solver.steady_tolerance=1e-30", "solver.flow_tolerance=1e-30"},
                             2);
    EXPECT_EQ(stopped.exit_code, 4) << stopped.errors;
    expect_ended("interrupted", {"stopped by a signal or --walltime", "--restart and this folder"});
    const auto on = run({verb, "case.toml", "--output", "on", "--restart", "out/solution.cgns"});
    EXPECT_EQ(on.exit_code, 0) << on.errors;
  }
}

TEST_F(CyclesEnd, InTurnsWithTheStructureAtASignalAndGoOnFromThere) {
  const int code = run_and_signal({"flutter", "case.toml", "--output", "out", "solver.method=staggered",
                                   "solver.structure_tolerance=1e-30"},
                                  "staggered, Runge-Kutta", SIGTERM);
  EXPECT_EQ(code, 4);
  expect_ended("interrupted", {"stopped by a signal or --walltime", "--restart and this folder"});
  const auto on = run({"flutter", "case.toml", "--output", "on", "solver.method=staggered", "--restart",
                       "out/solution.cgns"});
  EXPECT_EQ(on.exit_code, 0) << on.errors;
  EXPECT_FALSE(result("on").contains("linear_flutter")) << "a periodic solution goes straight on";
}

// Cycles of the paper's section begin at the boundary, V = 2.71 on this mesh, and rise from it.
TEST_F(CyclesEnd, BelowTheFlutterBoundaryWithoutALimitCycle) {
  const auto none =
      run({"lco", "case.toml", "--output", "out", "lco.reduced_velocity=2.6", "lco.max_energy=4e-3"});
  EXPECT_EQ(none.exit_code, 1) << none.errors;
  expect_ended("stalled", {"no cycle was found at lco.reduced_velocity = 2.6", "lco.max_energy", "lco.csv"});
}

}  // namespace
}  // namespace wingbeat
