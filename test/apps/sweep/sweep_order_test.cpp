#include "apps/sweep/sweep_order.hpp"

#include <gtest/gtest.h>

namespace wingbeat {
namespace {

using enum PointState;

PointPlaces line(const std::vector<double>& places) {
  PointPlaces points;
  for (const double place : places) {
    points.places.push_back({place});
    points.classes.push_back(0);
  }
  return points;
}

TEST(SweepOrder, GoesOnToTheNearestPointAndStartsFromTheNearestDone) {
  const PointPlaces points = line({0.0, 0.25, 0.5, 0.75, 1.0});
  const std::vector<PointState> states{done, pending, running, pending, done};
  EXPECT_EQ(next_point(points, states, 4), 3u);
  EXPECT_EQ(next_point(points, states, 0), 1u);
  EXPECT_EQ(nearest_done(points, states, 3), 4u);
  EXPECT_EQ(nearest_done(points, states, 1), 0u);
}

TEST(SweepOrder, LetsGroupsBeginFarApart) {
  const PointPlaces points = line({0.0, 0.25, 0.5, 0.75, 1.0});
  std::vector<PointState> states(5, pending);
  EXPECT_EQ(next_point(points, states, std::nullopt), 0u);
  states[0] = running;
  EXPECT_EQ(next_point(points, states, std::nullopt), 4u);
  states[4] = running;
  EXPECT_EQ(next_point(points, states, std::nullopt), 2u);
}

TEST(SweepOrder, NeverStartsFromAFailedPointOrOneOfAnotherMesh) {
  PointPlaces points = line({0.0, 0.25, 0.5});
  points.classes = {1, 0, 0};
  EXPECT_EQ(nearest_done(points, std::vector{done, pending, failed}, 1), std::nullopt);
  EXPECT_EQ(nearest_done(points, std::vector{done, pending, done}, 1), 2u);
}

TEST(SweepOrder, EndsWhenNothingIsPending) {
  EXPECT_EQ(next_point(line({0.0, 1.0}), std::vector{done, failed}, 0), std::nullopt);
}

}  // namespace
}  // namespace wingbeat
