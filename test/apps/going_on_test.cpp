#include <algorithm>
#include <csignal>

#include "test/apps/checkpoint.hpp"

namespace wingbeat {
namespace {

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
  kill_at("flutter, staggered", row_20_, words("flutter", "part", turns_));
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

// Each cycle of a list goes on where it was, from the state of rest that it began with.
TEST_F(Checkpoint, GoesOnWithTheSecondCycleOfAListBitForBit) {
  const Words list = turns_ + Words{"lco.energies=[1e-4, 4e-4]"};
  const auto whole = solve("lco", "whole", list);
  kill_at("cycle 2, staggered", row_20_, words("lco", "part", list));
  const auto on = solve("lco", "on", list + Words{"--restart", "part"});
  ASSERT_EQ(on["lco"].size(), 2U);
  EXPECT_EQ(log("on").find("cycle 1, "), std::string::npos) << "it was in the record";
  for (const char* file : {"lco.csv", "cycles.csv", "surface.csv"}) expect_same_file(file, "whole", "on");
}

// A branch goes on with steps as long as they had grown, not with its first one: no more cycles lie on the
// way than without the interruption, but for the one at which it was stopped.
TEST_F(Checkpoint, GoesOnAlongABranchWithItsStep) {
  const Words branch{"lco.energies=[2e-2]", "lco.step=0.02"};
  const auto cycles = [&](const std::string& output) {
    const std::string lines = read(output + "/lco.jsonl");
    return std::ranges::count(lines, '\n') - 1;  // below the case
  };
  const auto whole = solve("lco", "whole", branch);
  {
    RunningProgram running(folder_, program_, words("lco", "part", branch), 2);
    ASSERT_TRUE(running.has_printed("cycle 5, E_0")) << running.output();
    running.signal_launcher(SIGUSR1);
    EXPECT_EQ(running.finish(), 4) << running.output();
  }
  const auto on = solve("lco", "on", branch + Words{"--restart", "part"});
  EXPECT_LE(cycles("on"), cycles("whole") + 1);
  ASSERT_EQ(on["lco"].size(), 1U);
  const double v = whole["lco"][0]["reduced_velocity"];
  EXPECT_NEAR(on["lco"][0]["reduced_velocity"].get<double>(), v, 1e-8 * v);
}

// The marches that are done are not done again.
TEST_F(Checkpoint, GoesOnWithTheSecondMarchOfASearchForFlutter) {
  const Words search{"march.reduced_velocity=2.8", "march.steps_per_period=32", "--find-flutter"};
  const auto whole = solve("march", "whole", search);
  ASSERT_GE(whole["marches"].size(), 2U);
  kill_at("growth rate/w_a", "march at V", words("march", "part", search));
  const auto on = solve("march", "on", search + Words{"--restart", "part"});
  EXPECT_EQ(on["marches"].size(), whole["marches"].size());
  EXPECT_EQ(on["marches"][0], whole["marches"][0]);
  // Factors are made again from the state they were of: what is left is their round-off.
  const double v = whole["flutter"]["reduced_velocity"];
  EXPECT_NEAR(on["flutter"]["reduced_velocity"].get<double>(), v, 1e-8 * v);
}

// Its long part before the linear one is the steady flow.
TEST_F(Checkpoint, OfASteadyFlowIsWherePkStarts) {
  solve("steady", "steady", {});
  const auto anew = solve("pk", "anew", {}), from = solve("pk", "from", {"--restart", "steady"});
  EXPECT_LE(from["steady"]["iterations"].get<int>(), 2);
  EXPECT_GT(anew["steady"]["iterations"].get<int>(), 2);
  const double v = anew["linear_flutter"]["reduced_velocity"];
  EXPECT_NEAR(from["linear_flutter"]["reduced_velocity"].get<double>(), v, 1e-8 * v);
}

// The points under way go on, too, not only the sweep with the next ones, wherever they stand in its list.
TEST_F(Checkpoint, GoesOnWithThePointsOfASweepBitForBit) {
  write("case.toml",
        small_case() + "[sweep]\nverb = \"steady\"\nparameters = [\"flow.mach = [0.8, 0.78]\"]\n");
  for (const std::string groups : {"1", "2"}) {
    const Words options = cycles_ + Words{"--groups", groups};
    const std::string whole = "whole-" + groups, part = "part-" + groups;
    solve("sweep", whole, options);
    // Where both points are begun at once, the second one alone is left after this.
    const std::string last = part + (groups == "1" ? "/points/0001" : "/points/0002");
    {
      RunningProgram running(folder_, program_, words("sweep", part, options), 2);
      ASSERT_TRUE(running.has_written(last + "/log.txt", row_20_)) << running.output();
      running.signal_launcher(SIGUSR1);
      EXPECT_EQ(running.finish(), 4) << running.output();
    }
    EXPECT_EQ(result(last)["status"], "interrupted");
    // A key that does not say what is solved may change, and the list may grow in front.
    solve("sweep", part,
          options + Words{"checkpoint.interval=100", "sweep.parameters=[\"flow.mach = [0.76, 0.8, 0.78]\"]"});
    EXPECT_EQ(log(last).find("\n           0 "), std::string::npos) << "it began anew";
    const std::string same = whole + last.substr(part.size());
    expect_same_file("surface.csv", same, last);
    EXPECT_EQ(result(last)["steady"]["cycles"], result(same)["steady"]["cycles"]);
  }
}

}  // namespace
}  // namespace wingbeat
