#include <csignal>
#include <filesystem>

#include "test/apps/program.hpp"
#include "test/apps/running_program.hpp"

namespace wingbeat {
namespace {

namespace fs = std::filesystem;

// Files and folders that are taken away from a run.
class Vanished : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("case.toml", small_case());
  }
};

// Nothing computed is lost: the folder is made anew, where that is possible.
TEST_F(Vanished, FolderOfResultsIsMadeAnewOrEndsTheRunWithAMessage) {
  for (const bool can_be_made : {true, false}) {
    RunningProgram running(folder_, program_,
                           {"steady", "case.toml", "--output", "out", "solver.flow_method=runge_kutta",
                            "solver.steady_tolerance=1e-30", "pseudo_time.max_cycles=1000000"},
                           2);
    ASSERT_TRUE(running.has_printed("Runge-Kutta on")) << running.output();
    fs::remove_all(folder_ / "out");
    if (!can_be_made) write("out", "a file");
    running.signal_launcher(SIGUSR1);
    EXPECT_EQ(running.finish(), can_be_made ? 4 : 2) << running.output();
    if (can_be_made)
      EXPECT_TRUE(files("out").contains("solution.cgns"));
    else
      expect_in("wingbeat: out", running.output());
  }
}

// Each point reads the mesh: those that find it have it, the others say what they miss and are tried again.
TEST_F(Vanished, MeshOfASweepFailsThePointsThatNeedIt) {
  ASSERT_EQ(run({"mesh", "case.toml", "--output", "made"}).exit_code, 0);
  write("sweep.toml",
        "[mesh]\nfile = \"made/mesh.cgns\"\n[flow]\nmach = 0.7\n[sweep]\nverb = \"steady\"\n"
        "parameters = [\"flow.mach = 0.60 to 0.70 step 0.02\"]\n");
  RunningProgram running(folder_, program_, {"sweep", "sweep.toml", "--output", "out"}, 2);
  ASSERT_TRUE(running.has_written("out/sweep.jsonl", "\"status\":\"converged\"")) << running.output();
  fs::rename(folder_ / "made/mesh.cgns", folder_ / "mesh.cgns");
  EXPECT_EQ(running.finish(), 1) << running.output();
  expect_in("made/mesh.cgns; allowed: an existing file", read("out/sweep.csv"));
  fs::rename(folder_ / "mesh.cgns", folder_ / "made/mesh.cgns");
  const auto again = run({"sweep", "sweep.toml", "--output", "out", "--retry-failed"}, 2);
  EXPECT_EQ(again.exit_code, 0) << again.errors;
}

}  // namespace
}  // namespace wingbeat
