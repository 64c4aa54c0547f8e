// The branch of limit cycles of a section whose pitch spring softens, then hardens: the speed falls with
// the amplitude to a fold and rises again. Every tabulated cycle is met, up the branch and down it.
#include <gtest/gtest.h>

#include "test/verification/quasi_steady_cycle.hpp"

namespace wingbeat {
namespace {

using namespace quasi_steady;

constexpr int harmonics = 7;
constexpr Spring softening{-1.5, 50.0};

struct Tabulated {
  double amplitude_deg, velocity, frequency;
};
const std::vector<Tabulated> table = {{1.0, .831908925061, .831908922371},
                                      {5.0, .829236591719, .829235783625},
                                      {9.0, .828410787463, .828410530393}};

Correction correct(BranchPoint& point, const BranchRow& row) {
  LimitCycle problem(section(softening), harmonics, row);
  NewtonOptions options;
  options.forcing_max = 1e-3;
  options.refactor_iterations = 4;
  options.max_iterations = 15;
  const NewtonResult result = newton(Comm(), problem, point.u, options);
  point.amplitude = problem.amplitude(point.u);
  point.speed = point.u.back();
  return {result.status, result.iterations};
}

BranchPoint cycle_of(double amplitude) {
  const FlutterRoot hopf = hopf_point();
  LimitCycle problem(section(softening), harmonics, amplitude);
  BranchPoint point{problem.start(hopf, amplitude), amplitude, hopf.reduced_velocity};
  EXPECT_EQ(correct(point, {.amplitude = amplitude, .speed = point.speed}).status, SolveStatus::converged);
  return point;
}

BranchFollower branch_from(double from_deg, double to_deg) {
  BranchOptions options;
  options.amplitude_scale = 10.0 * degree;
  options.speed_scale = 0.25;
  return {cycle_of(from_deg * degree), cycle_of(to_deg * degree), options, correct};
}

BranchStep go_to(BranchFollower& branch, const BranchTarget& target) {
  BranchStep step = BranchStep::advanced;
  for (int k = 0; k < 50 && step == BranchStep::advanced; ++k) step = branch.advance(target);
  return step;
}

void expect_cycle(const BranchPoint& found, const Tabulated& expected) {
  EXPECT_NEAR(found.amplitude, expected.amplitude_deg * degree, 1e-10);
  EXPECT_NEAR(found.speed, expected.velocity, 1e-10);
  EXPECT_NEAR(found.u[found.u.size() - 2], expected.frequency, 1e-10);
}

TEST(LcoBranch, AmplitudesAreMetRisingAndFallingRoundTheFoldOfSpeed) {
  BranchFollower up = branch_from(0.1, 0.3);
  for (const Tabulated& cycle : table) {
    ASSERT_EQ(go_to(up, {BranchTarget::Kind::amplitude, cycle.amplitude_deg * degree}), BranchStep::reached)
        << up.why();
    expect_cycle(up.found(), cycle);
  }
  // Down from beyond the last: the branch that Newton gives at 12 and 11 degrees.
  BranchFollower down = branch_from(12.0, 11.0);
  for (auto cycle = table.rbegin(); cycle != table.rend(); ++cycle) {
    ASSERT_EQ(go_to(down, {BranchTarget::Kind::amplitude, cycle->amplitude_deg * degree}),
              BranchStep::reached)
        << down.why();
    expect_cycle(down.found(), *cycle);
  }
}

TEST(LcoBranch, SpeedsAreMetOnBothSidesOfTheFoldInBothDirections) {
  // The cycle of 9 degrees lies beyond the fold: its speed is met once before it and once there.
  const Tabulated& beyond = table[2];
  const BranchTarget target{BranchTarget::Kind::speed, beyond.velocity};
  BranchFollower up = branch_from(0.1, 0.3), down = branch_from(12.0, 11.0);
  ASSERT_EQ(go_to(up, target), BranchStep::reached) << up.why();
  const BranchPoint before = up.found();
  EXPECT_LT(before.amplitude, 7.8 * degree);  // where d(k3 A^2 + (5/6) k5 A^4)/dA vanishes
  ASSERT_EQ(go_to(up, target), BranchStep::reached) << up.why();
  // dV/dA is 0.004 a radian there: twelve digits of V give ten of A.
  EXPECT_NEAR(up.found().amplitude, 9.0 * degree, 1e-9);
  ASSERT_EQ(go_to(down, target), BranchStep::reached) << down.why();
  EXPECT_NEAR(down.found().amplitude, 9.0 * degree, 1e-9);
  ASSERT_EQ(go_to(down, target), BranchStep::reached) << down.why();
  EXPECT_NEAR(down.found().amplitude, before.amplitude, 1e-9);
}

TEST(LcoBranch, GivenSpeedAndGivenAmplitudeAreTheSameCycle) {
  BranchFollower branch = branch_from(0.1, 0.3);
  ASSERT_EQ(go_to(branch, {BranchTarget::Kind::speed, table[1].velocity}), BranchStep::reached);
  expect_cycle(branch.found(), {5.0, table[1].velocity, table[1].frequency});
}

}  // namespace
}  // namespace wingbeat
