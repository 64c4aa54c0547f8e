#include <gtest/gtest.h>

#include <cmath>

#include "apps/sweep/sweep_branches.hpp"
#include "apps/sweep/sweep_refine.hpp"

namespace wingbeat {
namespace {

// Two branches that cross in speed between 0.2 and 0.3, far apart in frequency; one ends after 0.3.
TEST(SweepBranches, KeepTheirNumbersWhereTheLowestChanges) {
  const std::vector<double> places{0.0, 0.1, 0.2, 0.3, 0.4};
  const std::vector<std::vector<SweptRoot>> roots{{{2.0, 0.9}, {3.0, 0.5}},
                                                  {{2.2, 0.9}, {2.8, 0.5}},
                                                  {{2.4, 0.9}, {2.6, 0.5}},
                                                  {{2.4, 0.5}, {2.6, 0.9}},
                                                  {{2.2, 0.5}}};
  const auto numbers = linked_branches(places, roots);
  EXPECT_EQ(numbers, (std::vector<std::vector<int>>{{1, 2}, {1, 2}, {1, 2}, {2, 1}, {2}}));
}

TEST(SweepBranches, FollowARootThatRunsFastAndPassGaps) {
  const std::vector<double> places{0.0, 0.1, 0.2, 0.3};
  const std::vector<std::vector<SweptRoot>> roots{{{2.0, 0.60}}, {{2.4, 0.66}}, {}, {{3.2, 0.78}}};
  const auto numbers = linked_branches(places, roots);
  EXPECT_EQ(numbers[1], std::vector<int>{1});
  EXPECT_EQ(numbers[3], std::vector<int>{1});
}

TEST(SweepRefinement, GoesWhereTheCurveBendsUntilItIsStraightEnough) {
  std::vector<CurvePoint> points;
  const auto kink = [](double x) { return std::vector<double>{std::abs(x - 0.52)}; };
  for (int i = 0; i <= 10; ++i) points.push_back({0.1 * i, kink(0.1 * i)});
  const auto places = refined_places(points, 0.01, 0.01, 10);
  ASSERT_FALSE(places.empty());
  for (const double place : places) EXPECT_NEAR(place, 0.52, 0.14);
  std::vector<CurvePoint> straight;
  for (int i = 0; i <= 10; ++i) straight.push_back({0.1 * i, {3.0 * i, -1.0}});
  EXPECT_TRUE(refined_places(straight, 0.01, 0.01, 10).empty());
}

TEST(SweepRefinement, StopsAtTheCountAndAtTheLeastWidth) {
  const auto jump = [](double x) { return std::vector<double>{x < 0.55 ? 0.0 : 1.0}; };
  std::vector<CurvePoint> points;
  for (int i = 0; i <= 10; ++i) points.push_back({0.1 * i, jump(0.1 * i)});
  EXPECT_EQ(refined_places(points, 0.01, 0.0, 2).size(), 2u);
  EXPECT_TRUE(refined_places(points, 0.01, 0.051, 10).empty());
}

TEST(SweepRefinement, SeeksTheEdgeOfAGap) {
  const std::vector<CurvePoint> points{{0.0, {1.0}}, {1.0, {1.0}}, {2.0, {}}, {3.0, {}}, {4.0, {}}};
  EXPECT_EQ(refined_places(points, 0.01, 0.1, 1).size(), 1u);
  EXPECT_LT(refined_places(points, 0.01, 0.1, 1)[0], 2.0);
}

}  // namespace
}  // namespace wingbeat
