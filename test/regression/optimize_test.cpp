// The optimisations that come with the program, on coarse meshes, from end to end.
#include <algorithm>
#include <cmath>
#include <csignal>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

class Optimize : public Program {
 protected:
  static std::string case_of(const std::string& name) {
    return std::string(WINGBEAT_SOURCE_DIR) + "/apps/cases/" + name + "/case.toml";
  }
  // Few bumps and cells: half a second a design.
  static std::vector<std::string> small(const std::string& name, const std::string& output,
                                        const std::vector<std::string>& options) {
    std::vector<std::string> arguments{
        "optimize",       case_of(name),         "--output",         output, "mesh.cells=[48,12]",
        "design.bumps=8", "optimize.compare=[]", "flutter.samples=6"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  nlohmann::json optimum(const std::string& name, const std::string& output,
                         const std::vector<std::string>& options, int ranks = 1) {
    const ProgramRun done = run(small(name, output, options), ranks);
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return result(output);
  }
};

// A cap that is met within a few iterations.
const std::string low_cap = "optimize.constraints=[\"flutter_speed <= 1.1 baseline\"]";

TEST_F(Optimize, DelaysFlutterWithoutDragAsFreshRunsConfirm) {
  const auto all =
      optimum("naca64a010-flutter-drag", "drag", {low_cap, "optimize.compare=[\"steady\",\"flutter\"]"});
  const auto& found = all["optimization"];
  const double before = found["objective_initial"], after = found["objective_final"];
  EXPECT_NEAR(after / before, 1.1, 1e-4);
  EXPECT_LE(found["kkt_error"], 1e-4);
  expect_in("+10.00 % on the baseline " + std::to_string(before).substr(0, 5), all["message"]);
  const double drag = result("drag/optimum/steady")["steady"]["cd"];
  EXPECT_LE(drag, (1.0 + 1e-4) * result("drag/baseline/steady")["steady"]["cd"].get<double>());
  EXPECT_NEAR(drag / found["outputs_final"]["drag"].get<double>(), 1.0, 1e-8);
  // Written meshes are read back to the last digit, and Newton ends near the same root.
  EXPECT_NEAR(result("drag/optimum/flutter")["flutter"]["reduced_velocity"].get<double>() / after, 1.0, 1e-7);
  EXPECT_NEAR(result("drag/baseline/flutter")["flutter"]["reduced_velocity"].get<double>() / before, 1.0,
              1e-7);
  // Each section is ready to be analysed, on its mesh and by its ordinates. A mesh made for the section
  // differs from one that follows its wall, most where cells are this large.
  const ProgramRun by_mesh = run({"steady", "drag/optimum/case.toml", "--output", "by-mesh"});
  ASSERT_EQ(by_mesh.exit_code, 0) << by_mesh.errors;
  EXPECT_NEAR(result("by-mesh")["steady"]["cd"].get<double>() / drag, 1.0, 1e-10);
  const ProgramRun anew = run({"flutter", "drag/optimum/airfoil.toml", "--output", "anew"});
  ASSERT_EQ(anew.exit_code, 0) << anew.errors;
  EXPECT_NEAR(result("anew")["flutter"]["reduced_velocity"].get<double>() / before, 1.1, 0.05);
}

TEST_F(Optimize, IsTheSameOnTwoRanksInGroupsAndInterruptedAndResumed) {
  const auto one = optimum("naca64a010-flutter-drag", "one", {low_cap})["optimization"];
  const auto two = optimum("naca64a010-flutter-drag", "two", {low_cap}, 2)["optimization"];
  EXPECT_NEAR(two["objective_final"].get<double>() / one["objective_final"].get<double>(), 1.0, 1e-4);

  // The flutter point on one rank, the drag on the other: the same numbers, and so the same way, as on one.
  const auto shared =
      optimum("naca64a010-flutter-drag", "shared", {low_cap, "optimize.groups=2"}, 2)["optimization"];
  EXPECT_EQ(shared["evaluations"], one["evaluations"]);
  EXPECT_NEAR(shared["outputs_final"]["drag"].get<double>() / one["outputs_final"]["drag"].get<double>(), 1.0,
              1e-4);
  const double bound = 0.01;
  for (std::size_t i = 0; i < one["design"].size(); ++i)
    EXPECT_NEAR(shared["design"][i]["value"].get<double>(), one["design"][i]["value"].get<double>(),
                1e-4 * bound);

  // A finished record is replayed without a solve.
  const auto replayed = optimum("naca64a010-flutter-drag", "replayed",
                                {low_cap, "--restart", "one/evaluations.jsonl"})["optimization"];
  EXPECT_EQ(replayed["resumed_evaluations"], one["evaluations"]);
  EXPECT_EQ(replayed["evaluations"], one["evaluations"]);
  EXPECT_EQ(replayed["design"], one["design"]);

  // The table's head comes before its first line: a design or two are known then.
  const int code = run_and_signal(small("naca64a010-flutter-drag", "half", {low_cap}), "designs", SIGUSR1);
  EXPECT_EQ(code, 4);
  EXPECT_EQ(result("half")["status"], "interrupted");
  const auto resumed = optimum("naca64a010-flutter-drag", "resumed",
                               {low_cap, "--restart", "half/evaluations.jsonl"})["optimization"];
  EXPECT_GE(resumed["resumed_evaluations"], 1);
  EXPECT_EQ(resumed["evaluations"], one["evaluations"]);
  EXPECT_NEAR(resumed["objective_final"].get<double>() / one["objective_final"].get<double>(), 1.0, 1e-4);
}

TEST_F(Optimize, ReducesALimitCycle) {
  const auto found = optimum("naca64a010-lco", "lco",
                             {"lco.reduced_velocity=2.95",
                              "optimize.constraints=[\"lco_amplitude >= 1.2 scale 1\"]"})["optimization"];
  EXPECT_NEAR(found["objective_final"], 1.2, 1e-3);
  EXPECT_GT(found["objective_initial"], 1.5);
}

// What is found before anything is solved leaves nothing behind.
TEST_F(Optimize, RefusesStatementsThatMakeNoSense) {
  const auto refused = [&](const std::vector<std::string>& options, const std::string& message) {
    expect_refused(run(small("naca64a010-flutter", "refused", options)), "refused", message);
  };
  refused({"optimize.constraints=[\"drga <= 1\"]"}, "drag");
  refused({"optimize.constraints=[\"drag <= 0.001\",\"drag >= 0.002\"]"}, "drag");
  refused({"optimize.ipopt=[\"mu_strateg = adaptive\"]"}, "mu_strategy");
  refused({"optimize.groups=7"}, "optimize.groups");
  refused({"optimize.compare=[\"lco\"]"}, "lco.energies");
}

// What needs the undeformed section first is refused once that is solved.
TEST_F(Optimize, RefusesWhatTheBaselineShowsToMakeNoSense) {
  const auto refused = [&](const std::vector<std::string>& options, const std::string& message) {
    const ProgramRun done = run(small("naca64a010-flutter", "refused", options));
    EXPECT_EQ(done.exit_code, 2);
    expect_in(message, done.errors);
  };
  refused({"optimize.constraints=[\"drag <= 0.9 baseline\",\"drag >= 0.01\"]"}, "cross");
  refused({"optimize.start=[0.1]"}, "optimize.start");
  optimum("naca64a010-flutter", "first", {low_cap, "optimize.max_iterations=40"});
  refused({low_cap, "flow.mach=0.79", "--restart", "first/evaluations.jsonl"}, "flow.mach");
}

// A section without structure has no flutter to compare: the default comparison leaves it out.
TEST_F(Optimize, ReducesTheDragOfASectionWithoutStructure) {
  write("drag.toml",
        "[mesh]\nairfoil = \"naca64a010\"\ncells = [48, 12]\n[flow]\nmach = 0.8\n[design]\nbumps = 8\n"
        "[optimize]\nobjective = \"drag\"\nconstraints = [\"area >= 0.98 baseline\"]\n");
  const ProgramRun done = run({"optimize", "drag.toml", "--output", "drag"});
  ASSERT_EQ(done.exit_code, 0) << done.errors;
  const auto found = result("drag")["optimization"];
  EXPECT_LT(found["objective_final"].get<double>(), 0.9 * found["objective_initial"].get<double>());
  EXPECT_LE(found["constraints"]["area >= 0.98 baseline"]["violation"], 1e-4);
  EXPECT_EQ(result("drag/optimum/steady")["status"], "converged");
}

TEST_F(Optimize, AnInfeasibleStartIsToldOfAndMended) {
  const ProgramRun done =
      run(small("naca64a010-flutter", "infeasible",
                {"optimize.constraints=[\"flutter_speed <= 1.1 baseline\",\"drag <= 0.95 baseline\"]"}));
  ASSERT_EQ(done.exit_code, 0) << done.errors;
  expect_in("violated", done.output);
  EXPECT_LE(result("infeasible")["optimization"]["constraints"]["drag <= 0.95 baseline"]["violation"], 1e-4);
}

}  // namespace
}  // namespace wingbeat
