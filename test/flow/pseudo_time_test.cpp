#include "flow/pseudo_time.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "test/flow/multigrid_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;

struct PseudoTime : ::testing::Test {
  MultigridCase c{section_mesh("naca0012", 64, 16, 1, 60.0), 0.8, 1.25};

  PseudoTimeResult solve(std::vector<double>& w, const PseudoTimeOptions& options,
                         const PseudoTimeObserver& observer = {}) {
    Multigrid<2> multigrid(c.flow, c.divided(), options.multigrid);
    return pseudo_time<2>(c.flow, multigrid, w, c.motions, c.kappa, options, observer);
  }
};

TEST_F(PseudoTime, ReportsTheResidualOfTheStateThatItReturns) {
  PseudoTimeOptions options;
  options.tolerance = 1e-5;
  auto w = c.flow.uniform_state();
  std::vector<double> residuals;
  const auto result = solve(w, options, [&](const PseudoTimeIteration& i) {
    EXPECT_EQ(i.cycle, static_cast<int>(residuals.size()));
    residuals.push_back(i.residual);
    return true;
  });
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_NEAR(residuals.front(), 1.0, 1e-12) << "uniform flow";
  EXPECT_EQ(result.residual, residuals.back());
  EXPECT_EQ(result.cycles + 1, static_cast<int>(residuals.size()));
  EXPECT_NEAR(relative_residual(c, w), result.residual, 1e-6 * result.residual);
}

TEST_F(PseudoTime, StopsAtTheLimitOfCyclesAndWhenAskedTo) {
  PseudoTimeOptions options;
  options.max_cycles = 7;
  auto w = c.flow.uniform_state();
  EXPECT_EQ(solve(w, options).status, SolveStatus::iteration_limit);
  int seen = 0;
  w = c.flow.uniform_state();
  const auto result = solve(w, options, [&](const PseudoTimeIteration&) { return ++seen < 3; });
  EXPECT_EQ(result.status, SolveStatus::interrupted);
  EXPECT_EQ(result.cycles, 2);
  EXPECT_NEAR(relative_residual(c, w), result.residual, 1e-6 * result.residual);
}

TEST_F(PseudoTime, RetreatsToAShorterStepThatConverges) {
  PseudoTimeOptions options;
  options.tolerance = 1e-6;
  options.multigrid.runge_kutta.cfl = 100.0;
  auto w = c.flow.uniform_state();
  int retreats = 0;
  const auto result = solve(w, options, [&](const PseudoTimeIteration& i) {
    EXPECT_DOUBLE_EQ(i.cfl, 100.0 * std::pow(0.5, i.retreats));
    EXPECT_TRUE(i.retreats == retreats || i.retreats == retreats + 1);
    retreats = i.retreats;
    return true;
  });
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_GE(result.retreats, 3);
  EXPECT_DOUBLE_EQ(result.cfl, 100.0 * std::pow(0.5, result.retreats));
  EXPECT_NEAR(relative_residual(c, w), result.residual, 1e-6 * result.residual);
}

// Through retreats, which go back to a state of cycles before.
TEST_F(PseudoTime, GoesOnBitForBitFromAnyCycle) {
  PseudoTimeOptions options;
  options.tolerance = 1e-6;
  options.multigrid.runge_kutta.cfl = 100.0;
  auto whole = c.flow.uniform_state();
  const auto expected = solve(whole, options);
  ASSERT_GE(expected.retreats, 3);
  const auto go_on = [&](std::vector<double> w, const PseudoTimeMemory& memory) {
    Multigrid<2> multigrid(c.flow, c.divided(), options.multigrid);
    const auto result = pseudo_time<2>(c.flow, multigrid, w, c.motions, c.kappa, options, {}, &memory);
    return std::tuple(w, result.cycles, result.retreats, result.cfl);
  };
  const std::tuple all(whole, expected.cycles, expected.retreats, expected.cfl);
  for (const int left : {0, 13, 40}) {
    auto w = c.flow.uniform_state();
    const auto begun = solve(w, options, [&](const PseudoTimeIteration& i) { return i.cycle < left; });
    ASSERT_TRUE(begun.memory) << left;
    EXPECT_EQ(go_on(w, *begun.memory), all) << "stopped before cycle " << left;
    options.max_cycles = left;
    w = c.flow.uniform_state();
    const auto limited = solve(w, options);
    options.max_cycles = PseudoTimeOptions{}.max_cycles;
    ASSERT_TRUE(limited.memory) << left;
    EXPECT_EQ(go_on(w, *limited.memory), all) << "at the limit of " << left;
  }
  // What the state alone cannot know: without it the way is another.
  auto w = c.flow.uniform_state();
  solve(w, options, [&](const PseudoTimeIteration& i) { return i.cycle < 40; });
  EXPECT_NE(solve(w, options).cycles + 40, expected.cycles);
}

// As a checkpoint does, from the iteration, without stopping.
TEST_F(PseudoTime, ShowsTheStateAndWhatGoesWithItAtEveryCycle) {
  PseudoTimeOptions options;
  options.tolerance = 1e-4;
  auto w = c.flow.uniform_state();
  std::vector<double> seen;
  PseudoTimeMemory memory;
  const auto expected = solve(w, options, [&](const PseudoTimeIteration& i) {
    if (i.cycle != 17) return true;
    seen.assign(i.w.begin(), i.w.end());
    memory = {i.cycle, i.retreats, i.cfl, {i.good.begin(), i.good.end()}};
    return true;
  });
  Multigrid<2> multigrid(c.flow, c.divided(), options.multigrid);
  const auto result = pseudo_time<2>(c.flow, multigrid, seen, c.motions, c.kappa, options, {}, &memory);
  EXPECT_EQ(seen, w);
  EXPECT_EQ(result.cycles, expected.cycles);
}

TEST_F(PseudoTime, GivesUpAtTheLastGoodState) {
  PseudoTimeOptions options;
  options.max_retreats = 1;
  options.multigrid.runge_kutta.cfl = 1000.0;
  auto w = c.flow.uniform_state();
  const auto result = solve(w, options);
  EXPECT_EQ(result.status, SolveStatus::diverged);
  EXPECT_EQ(result.retreats, 1);
  EXPECT_TRUE(is_physical<2>(w, 1.4));
  EXPECT_LE(relative_residual(c, w), 1e3);
}

TEST_F(PseudoTime, FullMultigridStartsNearerToTheSolutionThanUniformFlow) {
  MultigridCase finer(section_mesh("naca0012", 128, 32, 1, 60.0), 0.8, 1.25);
  const auto w = full_multigrid_start<2>(finer.flow, finer.divided(), finer.motions, finer.kappa, {});
  EXPECT_TRUE(is_physical<2>(w, 1.4));
  EXPECT_LE(relative_residual(finer, w), 0.5) << "of uniform flow's";
}

TEST_F(PseudoTime, StartsFromUniformFlowWithoutCoarseMeshes) {
  PseudoTimeOptions single;
  single.multigrid.levels = 1;
  const auto w = full_multigrid_start<2>(c.flow, c.divided(), c.motions, c.kappa, single);
  EXPECT_EQ(largest_difference(c.comm, w, c.flow.uniform_state()), 0.0);
}

}  // namespace
}  // namespace wingbeat
