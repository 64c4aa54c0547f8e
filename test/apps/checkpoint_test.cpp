#include "test/apps/checkpoint.hpp"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include "test/nightly.hpp"

namespace wingbeat {
namespace {

// ---- Signals
// --------------------------------------------------------------------------------------------------

// Open MPI's mpirun passes SIGUSR1 on; SIGTERM has to reach the ranks.
TEST_F(Checkpoint, IsLeftBySignalsToMpirunAndToRanks) {
  for (const int ranks : {2, 4}) {
    for (const bool to_launcher : {true, false}) {
      RunningProgram running(
          folder_, program_,
          words("pitch", "out",
                cycles_ + Words{"solver.flow_tolerance=1e-30", "pseudo_time.max_cycles=1000000"}),
          ranks);
      ASSERT_TRUE(running.has_printed("Runge-Kutta on")) << running.output();
      if (to_launcher)
        running.signal_launcher(SIGUSR1);
      else
        running.signal_ranks(SIGTERM);
      EXPECT_EQ(running.finish(), 4) << running.output();
      EXPECT_EQ(result("out")["status"], "interrupted");
      EXPECT_TRUE(files("out").contains("solution.cgns")) << running.output();
      EXPECT_EQ(solve("pitch", "on", cycles_ + Words{"--restart", "out"}, 1)["status"], "converged");
    }
  }
}

// A run that cannot poll, here for want of a rank that goes on, is ended by the second one.
TEST_F(Checkpoint, IsNotWaitedForAfterASecondSignal) {
  const Words endless = cycles_ + Words{"solver.steady_tolerance=1e-30", "pseudo_time.max_cycles=1000000"};
  RunningProgram running(folder_, program_, words("steady", "out", endless), 2);
  ASSERT_TRUE(running.has_printed("Runge-Kutta on")) << running.output();
  running.signal_ranks(SIGSTOP);
  for (const int signal : {SIGUSR1, SIGTERM}) running.signal_ranks(signal);
  running.signal_ranks(SIGCONT);
  const int code = running.finish();
  EXPECT_TRUE(code != 0 && code != 4) << code << running.output();
  EXPECT_FALSE(files("out").contains("result.json"));
}

void replace(std::string& text, const std::string& part, const std::string& by) {
  const auto found = text.find(part);
  ASSERT_NE(found, std::string::npos) << part;
  text.replace(found, part.size(), by);
}

// As a user copies it, with mpirun's own option; a file stands for the queue.
TEST_F(Checkpoint, LetsTheBatchScriptOfTheManualReturnToTheQueue) {
  std::ifstream manual(std::string(WINGBEAT_SOURCE_DIR) + "/docs/tutorials/cluster.md");
  const std::string text(std::istreambuf_iterator<char>(manual), {});
  const auto begin = text.find("#!/bin/bash\n#SBATCH");
  ASSERT_NE(begin, std::string::npos);
  std::string script = text.substr(begin, text.find("```", begin) - begin);
  replace(script, "mpirun", std::string(WINGBEAT_MPIEXEC) + " -n 2");
  replace(script, "sigkill_timeout 10", "sigkill_timeout 1");
  replace(script, "wingbeat flutter case.toml",
          "'" + program_ +
              "' pitch case.toml solver.flow_method=runge_kutta solver.flow_tolerance=1e-30 "
              "pseudo_time.max_cycles=1000000");
  replace(script, "scontrol requeue \"$SLURM_JOB_ID\"", "touch queued");
  write("job.sh", script);
  write("queue.sh",
        "bash job.sh > job.log 2>&1 &\njob=$!\n"
        "for i in $(seq 600); do grep -q 'Runge-Kutta on' job.log && break; sleep 0.1; done\n"
        "kill -USR1 $job\nwait $job\n");
  const int status = std::system(("cd '" + folder_.string() + "' && bash queue.sh").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 4) << read("job.log");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "queued")) << read("job.log");
  EXPECT_EQ(result("run")["status"], "interrupted");
}

// ---- What a restart is of
// -------------------------------------------------------------------------------------

TEST_F(Checkpoint, SaysWhichKeysDiffer) {
  solve("steady", "one", {});
  solve("steady", "same", {"--restart", "one"});
  EXPECT_EQ(log("same").find("another case"), std::string::npos);
  solve("steady", "other", {"--restart", "one", "flow.mach=0.78", "solver.max_steady_iterations=150"});
  expect_in("solution.cgns: is of another case, and so a start: flow.mach = 0.78 (was 0.8)\n", log("other"));
}

TEST_F(Checkpoint, OfAnotherMeshOrSectionIsRefused) {
  solve("steady", "one", {});
  expect_refused_restart(
      {"--restart", "one", "mesh.cells=[48, 16]"},
      {"one/solution.cgns: is the solution of another mesh or section: mesh.cells = [48, 16] "
       "(was [48, 12]); give the case"});
  expect_refused_restart({"--restart", "one", "mesh.airfoil=naca0012"},
                         {"mesh.airfoil = \"naca0012\" (was \"naca64a010\")"});
  const auto periodic = run(words("pitch", "pitch", {"solver.flow_tolerance=1e-3"}), 2);
  ASSERT_EQ(periodic.exit_code, 0) << periodic.errors;
  expect_refused_restart({"--restart", "pitch"}, {"holds 3 instances, this run can start from 1"});
}

TEST_F(Checkpoint, ThatIsDamagedIsPassedOverOrRefused) {
  solve("steady", "out", {});
  solve("steady", "out", {});
  const auto cut = [&](const char* name) { std::filesystem::resize_file(folder_ / "out" / name, 5000); };
  cut("solution.cgns");
  expect_refused_restart({"--restart", "out/solution.cgns"}, {"out/solution.cgns: "});
  const auto on = run(words("steady", "on", {"--restart", "out"}), 2);
  EXPECT_EQ(on.exit_code, 0) << on.errors;
  expect_in("warning", on.errors);
  expect_in("goes on from out/solution.previous.cgns", on.output);
  cut("solution.previous.cgns");
  expect_refused_restart({"--restart", "out"}, {"--restart out: holds no solution that is whole"});
}

// So that a job can be queued again whatever became of it.
TEST_F(Checkpoint, ThatIsNotThereYetIsNoFaultInTheRunsOwnFolder) {
  EXPECT_EQ(solve("steady", "out", {"--restart", "out"})["status"], "converged");
  expect_in("out holds nothing to go on from yet: begins anew", log("out"));
  std::filesystem::create_directory(folder_ / "empty");
  expect_refused_restart({"--restart", "empty"}, {"--restart empty: the folder holds no solution.cgns"});
  expect_refused_restart({"--restart", "missing"}, {"--restart missing: no such file or folder"});
}

// ---- Killed
// ---------------------------------------------------------------------------------------------------

// At random moments of a run that hardly does anything but write checkpoints. The run that is left alone in
// the end arrives where one arrives that was never killed.
TEST_F(Checkpoint, IsWholeWheneverTheRunIsKilled) {
  const int kills = testing::is_nightly() ? 100 : 10;
  // Long enough not to end before the last kill: half a period for each.
  const Words march{"march.reduced_velocity=2.9", "march.periods=" + std::to_string(kills / 2),
                    "march.snapshots=0", "march.steps_per_period=64", "march.until=end"};
  solve("march", "whole", march);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> milliseconds(0, 120);
  for (int i = 0; i < kills; ++i) {
    const Words on = i == 0 ? Words{} : Words{"--restart", "out"};
    RunningProgram running(folder_, program_, words("march", "out", march + at_every_step + on), 2);
    // Its second row is written when there is a checkpoint of the first step.
    ASSERT_TRUE(i == 0 ? running.has_written("out/march.csv", "\n0.1963")
                       : running.has_printed("the march goes on after"))
        << i << running.output();
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(random)));
    running.kill();
    EXPECT_TRUE(files("out").contains("solution.cgns"));
  }
  solve("march", "out", march + Words{"--restart", "out"});
  expect_in("goes on from out/solution.cgns", log("out"));
  expect_same_file("march.csv", "whole", "out");
  for (const std::string& name : files("out")) EXPECT_EQ(name.find(".part-"), std::string::npos) << name;
}

}  // namespace
}  // namespace wingbeat
