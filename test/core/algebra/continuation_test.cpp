#include "core/algebra/continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace wingbeat {
namespace {

// The family of points (amplitude, speed) on a circle of radius 1/2 about (2, 3): it has two folds of
// each. Newton on (circle, row) from the predicted point; u holds the same two numbers.
Correction on_circle(BranchPoint& point, const BranchRow& row) {
  double x = point.amplitude, y = point.speed;
  for (int iteration = 1; iteration <= 12; ++iteration) {
    const double f = (x - 2.0) * (x - 2.0) + (y - 3.0) * (y - 3.0) - 0.25;
    const double g = row.by_amplitude * (x / row.amplitude - 1.0) + row.by_speed * (y / row.speed - 1.0);
    if (std::hypot(f, g) < 1e-14) {
      point = {{x, y}, x, y};
      return {SolveStatus::converged, iteration};
    }
    const double fx = 2.0 * (x - 2.0), fy = 2.0 * (y - 3.0);
    const double gx = row.by_amplitude / row.amplitude, gy = row.by_speed / row.speed;
    const double det = fx * gy - fy * gx;
    x -= (f * gy - g * fy) / det;
    y -= (g * fx - f * gx) / det;
  }
  return {SolveStatus::iteration_limit, 12};
}

BranchPoint at_angle(double angle) {
  const double x = 2.0 + 0.5 * std::cos(angle), y = 3.0 + 0.5 * std::sin(angle);
  return {{x, y}, x, y};
}

BranchFollower follower(double from, double to, const Corrector& corrector = on_circle) {
  return {
      at_angle(from), at_angle(to), {.step = 0.1, .largest_step = 0.2, .wanted_iterations = 6}, corrector};
}

double angle_of(const BranchPoint& point) { return std::atan2(point.speed - 3.0, point.amplitude - 2.0); }

BranchStep go_to(BranchFollower& branch, const BranchTarget& target, int most_steps = 60) {
  BranchStep step = BranchStep::advanced;
  for (int k = 0; k < most_steps && step == BranchStep::advanced; ++k) step = branch.advance(target);
  return step;
}

TEST(Continuation, GoesRoundAllFoldsAndMeetsEverySpeedTwiceATurn) {
  BranchFollower branch = follower(0.0, 0.05);
  const BranchTarget target{BranchTarget::Kind::speed, 3.2};
  const double angle = std::asin(0.4);
  for (int turn = 0; turn < 2; ++turn)
    for (const double expected : {angle, std::numbers::pi - angle}) {
      ASSERT_EQ(go_to(branch, target), BranchStep::reached) << branch.why();
      EXPECT_NEAR(angle_of(branch.found()), expected, 1e-12);
      EXPECT_DOUBLE_EQ(branch.found().speed, 3.2);
    }
}

TEST(Continuation, MeetsAnAmplitudeOnBothSidesOfItsFold) {
  BranchFollower branch = follower(-0.3, -0.25);
  const BranchTarget target{BranchTarget::Kind::amplitude, 2.0 + 0.5 * std::cos(0.2)};
  for (const double expected : {-0.2, 0.2}) {
    ASSERT_EQ(go_to(branch, target), BranchStep::reached) << branch.why();
    EXPECT_NEAR(angle_of(branch.found()), expected, 1e-12);
  }
}

TEST(Continuation, BothCrossingsWithinOneStepAreMet) {
  BranchFollower branch = follower(1.2, 1.3);
  // The top of the circle at 0.0001 below it: the two solutions are 0.04 apart, less than a step.
  const BranchTarget target{BranchTarget::Kind::speed, 3.4999};
  const double angle = std::asin(2.0 * 0.4999);
  ASSERT_EQ(go_to(branch, target), BranchStep::reached);
  EXPECT_NEAR(angle_of(branch.found()), angle, 1e-10);
  ASSERT_EQ(go_to(branch, target), BranchStep::reached);
  EXPECT_NEAR(angle_of(branch.found()), std::numbers::pi - angle, 1e-10);
}

TEST(Continuation, TurningLeadsBack) {
  BranchFollower branch = follower(0.0, 0.05);
  ASSERT_EQ(go_to(branch, {BranchTarget::Kind::amplitude, 1.8}), BranchStep::reached);
  EXPECT_FALSE(branch.grows());
  branch.turn();
  EXPECT_TRUE(branch.grows());
  ASSERT_EQ(go_to(branch, {BranchTarget::Kind::speed, 3.1}), BranchStep::reached);
  EXPECT_NEAR(angle_of(branch.found()), std::asin(0.2), 1e-12);
}

// The same solution twice, but for round-off, has no direction: the one before is kept.
TEST(Continuation, ATargetWhereTheBranchAlreadyIsDoesNotLoseItsDirection) {
  BranchFollower branch = follower(-1.0, -0.9);
  const double here = branch.last().amplitude, further = at_angle(-0.3).amplitude;
  ASSERT_EQ(go_to(branch, {BranchTarget::Kind::amplitude, std::nextafter(here, 3.0)}), BranchStep::reached);
  ASSERT_EQ(go_to(branch, {BranchTarget::Kind::amplitude, further}), BranchStep::reached);
  EXPECT_NEAR(angle_of(branch.found()), -0.3, 1e-8);
}

TEST(Continuation, StepsThatFailAreHalvedAndThenGivenUpWithAReason) {
  // No correction beyond a quarter of the circle converges.
  BranchFollower branch = follower(0.0, 0.05, [](BranchPoint& point, const BranchRow& row) {
    if (angle_of(point) > 1.5) return Correction{SolveStatus::stalled, 9};
    return on_circle(point, row);
  });
  EXPECT_EQ(go_to(branch, {BranchTarget::Kind::amplitude, 1.6}), BranchStep::failed);
  EXPECT_GT(angle_of(branch.last()), 1.45);
  EXPECT_NE(branch.why().find("stalled"), std::string::npos);
}

TEST(Continuation, AnInterruptEndsTheWayAtTheLastSolution) {
  int calls = 0;
  BranchFollower branch = follower(0.0, 0.05, [&](BranchPoint& point, const BranchRow& row) {
    return ++calls < 3 ? on_circle(point, row) : Correction{SolveStatus::interrupted, 0};
  });
  EXPECT_EQ(go_to(branch, {BranchTarget::Kind::amplitude, 1.6}), BranchStep::interrupted);
  EXPECT_NEAR(std::hypot(branch.last().amplitude - 2.0, branch.last().speed - 3.0), 0.5, 1e-12);
}

}  // namespace
}  // namespace wingbeat
