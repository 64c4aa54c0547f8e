#include <filesystem>

#include "test/apps/program.hpp"

namespace wingbeat {
namespace {

// What a run takes, said before it is taken.
class Memory : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("case.toml", small_case());
  }
  // With a limit on what each process may ask for.
  void limit_to_megabytes(int megabytes) {
    write("limited",
          "#!/bin/sh\nulimit -v " + std::to_string(1000 * megabytes) + "\nexec '" + program_ + "' \"$@\"\n");
    program_ = (folder_ / "limited").string();
    std::filesystem::permissions(program_, std::filesystem::perms::owner_all);
  }
};

TEST_F(Memory, IsEstimatedToAFifth) {
  struct Run {
    std::string verb;
    int ranks;
    std::vector<std::string> options;
  };
  const std::vector<Run> runs{
      {"steady", 1, {}},
      {"steady", 2, {"mesh.cells=[128, 32]"}},
      {"steady", 1, {"mesh.cells=[128, 32]", "solver.subdomain=ilu"}},
      {"steady",
       1,
       {"mesh.cells=[250, 50]", "solver.flow_method=runge_kutta", "solver.steady_tolerance=1e-2"}},
      {"pitch", 1, {"time.harmonics=3"}},
      {"pitch", 2, {"solver.flow_method=runge_kutta"}},
      {"flutter", 1, {"mesh.cells=[96, 24]", "solver.flow_method=runge_kutta"}},
      {"flutter", 2, {"time.harmonics=3"}},
      {"flutter", 1, {"time.harmonics=3", "solver.subdomain=ilu"}},
      {"flutter", 1, {"mesh.cells=[128, 32]", "solver.method=staggered"}},
      {"lco", 1, {"lco.energies=[1e-4]"}},
      {"march", 1, {"march.reduced_velocity=2.9", "march.periods=0.1", "march.until=end"}},
      {"gradient", 1, {"design.bumps=4"}},
      {"pk", 1, {"pk.samples=4"}}};
  for (const Run& run : runs) {
    std::vector<std::string> arguments{run.verb, "case.toml", "--output", "out", "mesh.cells=[64, 16]"};
    arguments.insert(arguments.end(), run.options.begin(), run.options.end());
    const ProgramRun done = this->run(arguments, run.ranks);
    ASSERT_EQ(done.exit_code, 0) << done.errors;
    const auto memory = result("out")["memory"];
    const double peak = memory["peak_megabytes"], estimate = memory["estimated_megabytes"];
    EXPECT_NEAR(estimate / peak, 1.0, 0.2) << run.verb << " on " << run.ranks << ", " << run.options.size()
                                           << " options: " << estimate << " MB for " << peak;
  }
}

TEST_F(Memory, IsToldByAPlan) {
  const auto plan = run({"flutter", "case.toml", "--dry-run"}, 2);
  EXPECT_EQ(plan.exit_code, 0) << plan.errors;
  expect_in("# memory: about ", plan.output);
  expect_in(" MB on 2 ranks, ", plan.output);
}

TEST_F(Memory, ThatIsNotThereIsRefusedBeforeItIsTaken) {
  limit_to_megabytes(1000);
  const auto refused = run({"flutter", "case.toml", "mesh.cells=[400, 100]", "--output", "out"}, 2);
  expect_refused(refused, "out", "a mesh of 40000 cells takes about ");
  expect_in("MB; run on more nodes", refused.errors);
  EXPECT_EQ(refused.output.find("steady flow"), std::string::npos) << "work had begun";
  // By another method it fits.
  EXPECT_EQ(run({"steady", "case.toml", "mesh.cells=[400, 100]", "solver.flow_method=runge_kutta",
                 "solver.steady_tolerance=1e-1", "--output", "out"},
                2)
                .exit_code,
            0);
}

// Such a library would ask for it for ever.
TEST_F(Memory, ThatALibraryNeedsIsCountedAmongTheAddressSpace) {
  limit_to_megabytes(400);
  expect_refused(run({"steady", "case.toml", "--output", "out"}), "out", "a mesh of 576 cells takes about ");
}

}  // namespace
}  // namespace wingbeat
