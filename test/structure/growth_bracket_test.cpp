#include "structure/growth_bracket.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace wingbeat {
namespace {

constexpr double flutter_speed = 2.9;

// Rises through zero at the flutter speed and bends as growth rates do.
double bent_rate(double v) { return 0.08 * (v - flutter_speed) + 0.05 * std::pow(v - flutter_speed, 2); }

// Marches until the search is over; how many it took.
GrowthBracket searched(double first, double tolerance, const std::function<double(double)>& rate,
                       double rate_error = 0.0) {
  GrowthBracket search(first, {.tolerance = tolerance});
  for (int i = 0; i < 20 && !search.is_found() && !search.is_exhausted(); ++i) {
    const double v = search.next();
    search.add({v, rate(v), rate_error, 0.6 + 0.1 * (v - flutter_speed), 1e-5});
  }
  return search;
}

TEST(GrowthBracket, FindsTheSpeedOfNoGrowthFromBothSidesWithinItsError) {
  for (const double first : {1.5, 2.6, 2.85, 2.9, 2.95, 3.2, 6.0}) {
    SCOPED_TRACE(first);
    const GrowthBracket search = searched(first, 1e-5, bent_rate);
    ASSERT_TRUE(search.is_found());
    const GrowthCrossing crossing = *search.crossing();
    EXPECT_LE(crossing.reduced_velocity_error, 1e-5 * flutter_speed);
    EXPECT_NEAR(crossing.reduced_velocity, flutter_speed, 1e-5 * flutter_speed);
    // The slope of a chord from low to high is 0.08 + 0.05 (low + high), both counted from the flutter speed,
    // which lies between.
    double low = -flutter_speed, high = flutter_speed;
    for (const GrowthAtSpeed& p : search.points())
      (p.rate > 0.0 ? high : low) = p.rate > 0.0 ? std::min(high, p.reduced_velocity - flutter_speed)
                                                 : std::max(low, p.reduced_velocity - flutter_speed);
    EXPECT_NEAR(crossing.slope, 0.08, 0.05 * (high - low));
    EXPECT_NEAR(crossing.frequency, 0.6, 1e-5);
  }
}

TEST(GrowthBracket, TakesFourMarchesFromAFewPercentAway) {
  for (const double first : {2.8, 3.0}) EXPECT_LE(searched(first, 1e-4, bent_rate).points().size(), 4u);
}

TEST(GrowthBracket, StepsUpFromDecayAndDownFromGrowth) {
  GrowthBracket decays(2.0, {}), grows(2.0, {});
  decays.add({2.0, -0.01, 0.0, 0.6, 0.0});
  grows.add({2.0, 0.01, 0.0, 0.6, 0.0});
  EXPECT_DOUBLE_EQ(decays.next(), 2.06);
  EXPECT_DOUBLE_EQ(grows.next(), 1.94);
  EXPECT_FALSE(decays.crossing());
}

// The rates are each wrong by their error with an alternating sign: V is wrong by error/slope.
TEST(GrowthBracket, CountsTheErrorsOfTheRates) {
  constexpr double rate_error = 1e-4;
  int calls = 0;
  const GrowthBracket search = searched(
      2.8, 1e-6, [&](double v) { return bent_rate(v) + (++calls % 2 ? rate_error : -rate_error); },
      rate_error);
  EXPECT_FALSE(search.is_found());
  const GrowthCrossing crossing = *search.crossing();
  const double expected = rate_error / 0.08;
  EXPECT_GT(crossing.reduced_velocity_error, 0.3 * expected);
  EXPECT_LE(std::abs(crossing.reduced_velocity - flutter_speed), 3.0 * crossing.reduced_velocity_error);
}

TEST(GrowthBracket, AsksForRatesAsExactAsTheToleranceNeeds) {
  GrowthBracket search(2.8, {.tolerance = 1e-4});
  EXPECT_FALSE(search.rate_tolerance());
  for (const double v : {2.8, 3.0}) search.add({v, 0.08 * (v - flutter_speed), 0.0, 0.6, 0.0});
  EXPECT_NEAR(*search.rate_tolerance(), 0.25 * 1e-4 * flutter_speed * 0.08, 1e-12);
}

// Motion that outgrows what is small at once has a rate that is known to no better than itself.
TEST(GrowthBracket, HalvesTheSpeedsBetweenWhichGrowthSetsInWhereItsRateIsNotKnown) {
  GrowthBracket search(8.0, {});
  search.add({8.0, 0.5, 0.5, 1.0, 1.0});
  EXPECT_LT(search.next(), 8.0);
  search.add({4.0, 0.2, 0.2, 1.0, 1.0});
  search.add({2.0, -0.1, 1e-5, 0.6, 1e-5});
  EXPECT_FALSE(search.crossing());
  EXPECT_DOUBLE_EQ(search.next(), 3.0);
}

// Rates that do not rise with the speed have no crossing to extrapolate to.
TEST(GrowthBracket, GoesOnSteppingWhereGrowthDoesNotDependOnSpeed) {
  const GrowthBracket search = searched(2.0, 1e-4, [](double) { return -0.01; });
  EXPECT_FALSE(search.is_found());
  EXPECT_GT(search.points().back().reduced_velocity, 10.0);
}

}  // namespace
}  // namespace wingbeat
