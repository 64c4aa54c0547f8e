#include <csignal>
#include <fstream>
#include <random>
#include <thread>

#include "test/apps/program.hpp"
#include "test/apps/running_program.hpp"
#include "test/nightly.hpp"

namespace wingbeat {
namespace {

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const Words at_every_step{"checkpoint.interval=1e-9", "checkpoint.largest_share=1"};

// Runs that are stopped, killed and gone on with, under a real mpirun. Pressures on the wall are written with
// all their digits, so that equal text means equal bits.
class Checkpoint : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("case.toml",
          "[mesh]\nairfoil = \"naca64a010\"\ncells = [48, 12]\n[flow]\nmach = 0.8\n"
          "[pitch]\namplitude_deg = 1.0\nreduced_frequency = 0.2\n"
          "[structure]\nelastic_axis = -0.6\nstatic_unbalance = 0.25\ngyration_radius_squared = 0.75\n"
          "frequency_ratio = 0.5\nmass_ratio = 75\n");
  }

  Words words(const std::string& verb, const std::string& output, const Words& options = {}) const {
    return Words{verb, "case.toml", "--output", output} + options;
  }
  nlohmann::json solve(const std::string& verb, const std::string& output, const Words& options,
                       int ranks = 2, int exit_code = 0) const {
    const auto done = run(words(verb, output, options), ranks);
    EXPECT_EQ(done.exit_code, exit_code) << done.errors << done.output;
    return result(output);
  }
  std::string log(const std::string& output) const { return read(output + "/log.txt"); }
  void expect_same_file(const std::string& file, const std::string& a, const std::string& b) const {
    const std::string expected = read(a + "/" + file);
    EXPECT_FALSE(expected.empty());
    EXPECT_TRUE(read(b + "/" + file) == expected) << file << " of " << a << " and " << b << " differ";
  }
  void expect_refused_restart(const Words& options, const Words& parts) const {
    const auto refused = run(words("steady", "refused", options));
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    for (const std::string& part : parts) expect_in(part, refused.errors);
  }

  const Words cycles_{"solver.flow_method=runge_kutta"};
  const Words turns_{"solver.method=staggered"};
};

// ---- Signals
// --------------------------------------------------------------------------------------------------

// Open MPI's mpirun passes SIGUSR1 on; SIGTERM has to reach the ranks.
TEST_F(Checkpoint, IsLeftBySignalsToMpirunAndToRanks) {
  for (const int ranks : {2, 4}) {
    for (const bool to_launcher : {true, false}) {
      RunningProgram running(folder_, program_,
                             words("pitch", "out", cycles_ + Words{"solver.flow_tolerance=1e-30"}), ranks);
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

// ---- Going on
// -------------------------------------------------------------------------------------------------

TEST_F(Checkpoint, GoesOnWithSteadyCyclesBitForBit) {
  const auto whole = solve("steady", "whole", cycles_);
  solve("steady", "part", cycles_ + Words{"pseudo_time.max_cycles=30"}, 2, 1);
  const auto on = solve("steady", "on", cycles_ + Words{"--restart", "part/solution.cgns"});
  expect_same_file("surface.csv", "whole", "on");
  EXPECT_EQ(on["steady"]["cycles"], whole["steady"]["cycles"]) << "counted over both runs";
  // Elsewhere, to what the tolerance leaves open.
  for (const int ranks : {1, 4}) {
    const auto other = solve("steady", "other", cycles_ + Words{"--restart", "part"}, ranks);
    EXPECT_NEAR(other["steady"]["cd"].get<double>(), whole["steady"]["cd"].get<double>(), 1e-10);
  }
  // With another CFL number there is no going on: it is a start, and says nothing.
  solve("steady", "start", cycles_ + Words{"--restart", "part", "pseudo_time.cfl=4"});
  EXPECT_NE(read("start/surface.csv"), read("whole/surface.csv"));
}

TEST_F(Checkpoint, GoesOnWithPeriodicCyclesAndOnAMeshCutOtherwise) {
  const auto whole = solve("pitch", "whole", cycles_);
  solve("pitch", "part", cycles_ + Words{"pseudo_time.max_cycles=20"}, 2, 1);
  solve("pitch", "on", cycles_ + Words{"--restart", "part"});
  expect_same_file("surface.csv", "whole", "on");
  const auto cut = solve("pitch", "cut", cycles_ + Words{"--restart", "part", "mesh.blocks=3"});
  const auto lift = [](const nlohmann::json& json) {
    return json["pitch"]["harmonics"][1]["cl"][1].get<double>();
  };
  EXPECT_NEAR(lift(cut), lift(whole), 1e-10);
}

// By checkpoints on the way, too, not only by that of the end: the run is killed.
TEST_F(Checkpoint, GoesOnWithTurnsBitForBit) {
  const auto whole = solve("flutter", "whole", turns_);
  {
    RunningProgram running(folder_, program_, words("flutter", "part", turns_ + at_every_step), 2);
    ASSERT_TRUE(running.has_printed("staggered, Runge-Kutta")) << running.output();
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    running.kill();
  }
  solve("flutter", "on", turns_ + Words{"--restart", "part"});
  EXPECT_FALSE(result("on").contains("steady")) << "killed too early: nothing was tested";
  for (const char* file : {"surface.csv", "cycles.csv"}) expect_same_file(file, "whole", "on");
  EXPECT_EQ(result("on")["flutter"]["reduced_velocity"], whole["flutter"]["reduced_velocity"]);
}

// Where Newton ends depends on where it begins, within the tolerance.
TEST_F(Checkpoint, GoesOnWithNewtonToTheSameSolution) {
  // Above round-off, which a residual of 1e-12 is.
  const Words tight{"solver.flow_tolerance=4e-12", "solver.structure_tolerance=1e-11"};
  const auto whole = solve("flutter", "whole", tight);
  {
    RunningProgram running(folder_, program_, words("flutter", "part", tight + at_every_step), 2);
    ASSERT_TRUE(running.has_printed("coupled Newton")) << running.output();
    running.signal_launcher(SIGUSR1);
    EXPECT_EQ(running.finish(), 4);
  }
  for (const int ranks : {1, 2}) {
    const auto on = solve("flutter", "on", tight + Words{"--restart", "part"}, ranks);
    for (const char* number : {"reduced_velocity", "frequency_ratio"})
      EXPECT_NEAR(on["flutter"][number].get<double>(), whole["flutter"][number].get<double>(), 1e-10);
  }
}

// march.csv is that of the whole march, whichever way its steps are solved. Five periods are enough for a
// verdict, and so for the period whose pressures are kept.
TEST_F(Checkpoint, GoesOnWithAMarchBitForBit) {
  const Words march{"march.reduced_velocity=2.9", "march.periods=7", "march.snapshots=2",
                    "march.steps_per_period=24", "march.until=end"};
  for (const bool by_cycles : {false, true}) {
    const Words options = march + (by_cycles ? cycles_ : Words{});
    const auto whole = solve("march", "whole", options);
    solve("march", "part", options + Words{"march.periods=4.2"});
    const auto on = solve("march", "on", options + Words{"--restart", "part"});
    EXPECT_EQ(on["march"]["time_steps"], whole["march"]["time_steps"]);
    for (const char* file : {"march.csv", "surface.csv"}) expect_same_file(file, "whole", "on");
    expect_in("the march goes on after", log("on"));
  }
}

// A march that is complete gives the start of another.
TEST_F(Checkpoint, OfACompleteMarchBeginsANewOne) {
  const Words march{"march.reduced_velocity=2.9", "march.periods=0.5", "march.snapshots=0",
                    "march.steps_per_period=32", "march.until=end"};
  solve("march", "one", march);
  const auto two = solve("march", "two", march + Words{"--restart", "one"});
  EXPECT_EQ(two["march"]["time_steps"], 16);
  expect_in("a new one begins from its levels", log("two"));
  solve("march", "faster", march + Words{"--restart", "one", "march.reduced_velocity=3.0"});
  expect_in("is of another case, and so a start: march.reduced_velocity = 3.0 (was 2.9)", log("faster"));
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
  const Words march{"march.reduced_velocity=2.9", "march.periods=2", "march.snapshots=0",
                    "march.steps_per_period=64", "march.until=end"};
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
