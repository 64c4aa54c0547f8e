#include "optimize/root_tracker.hpp"

#include <gtest/gtest.h>

namespace wingbeat {
namespace {

FlutterRoot root(double speed, double frequency, double growth_slope = 1.0) {
  FlutterRoot r;
  r.reduced_velocity = speed;
  r.frequency = frequency;
  r.growth_slope = growth_slope;
  return r;
}

TEST(RootTracker, TheDistanceIsTheLargerRelativeDifference) {
  EXPECT_NEAR(distance(root(1.1, 0.8), root(1.0, 0.8)), 0.1, 1e-15);
  EXPECT_NEAR(distance(root(1.1, 1.0), root(1.0, 0.8)), 0.25, 1e-15);
  EXPECT_EQ(distance(root(1.0, 0.8), root(1.0, 0.8)), 0.0);
}

TEST(RootTracker, TheFirstIsTheLowestThatDestabilises) {
  RootTracker tracker(0.05);
  EXPECT_FALSE(tracker.follow({root(0.5, 1.2, -1.0), root(2.0, 1.0), root(1.0, 0.8)}));
  EXPECT_TRUE(tracker.has_first());
  ASSERT_EQ(tracker.known().size(), 1U);
  EXPECT_EQ(tracker.known()[0].reduced_velocity, 1.0);
  EXPECT_EQ(tracker.next_ratio(), 2.0);
}

TEST(RootTracker, RootsThatCrossAreFollowed) {
  RootTracker tracker(0.05);
  int told = 0;
  for (int i = 0; i <= 40; ++i) {
    const double first = 1.0 + 0.005 * i, second = 1.2 - 0.005 * i;  // they meet at i = 20
    if (const auto found = tracker.follow({root(second, 1.0), root(first, 0.8)})) {
      ++told;
      EXPECT_EQ(found->frequency, 1.0);
      EXPECT_LE(second, 1.05 * first);
      EXPECT_GT(second + 0.005, 1.05 * (first - 0.005)) << "told as soon as it is near";
    }
    ASSERT_TRUE(tracker.has_first());
    EXPECT_EQ(tracker.known()[0].frequency, 0.8);
    EXPECT_EQ(tracker.known()[0].reduced_velocity, first);
    if (told == 0) {
      EXPECT_NEAR(tracker.next_ratio().value(), second / first, 1e-15);
    } else {
      ASSERT_EQ(tracker.known().size(), 2U);
      EXPECT_EQ(tracker.known()[1].reduced_velocity, second);
    }
  }
  EXPECT_EQ(told, 1);
  EXPECT_FALSE(tracker.next_ratio()) << "all are known";
}

TEST(RootTracker, ARootThatAppearsBelowTheFirstIsTold) {
  RootTracker tracker(0.05);
  tracker.follow({root(1.0, 0.8)});
  EXPECT_FALSE(tracker.next_ratio());
  const auto found = tracker.follow({root(0.6, 1.4), root(1.0, 0.8)});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->frequency, 1.4);
  EXPECT_EQ(tracker.next_ratio(), 0.6);
  EXPECT_TRUE(tracker.has_first());
}

TEST(RootTracker, OneNewcomerADesignIsTold) {
  RootTracker tracker(0.05);
  const std::vector<FlutterRoot> roots{root(1.0, 0.8), root(1.02, 1.2), root(1.04, 1.8)};
  EXPECT_EQ(tracker.follow(roots)->frequency, 1.2);
  EXPECT_EQ(tracker.follow(roots)->frequency, 1.8);
  EXPECT_FALSE(tracker.follow(roots));
  EXPECT_EQ(tracker.known().size(), 3U);
}

TEST(RootTracker, TheFirstRootLostIsToldAndFoundAgain) {
  RootTracker tracker(0.05);
  tracker.follow({root(1.0, 0.8), root(1.04, 1.2)});
  EXPECT_EQ(tracker.known().size(), 2U);
  EXPECT_FALSE(tracker.follow({root(1.05, 1.2)}));
  EXPECT_FALSE(tracker.has_first());
  EXPECT_EQ(tracker.known()[0].reduced_velocity, 1.0) << "as seen last";
  EXPECT_EQ(tracker.known()[1].reduced_velocity, 1.05);
  tracker.follow({root(1.01, 0.81), root(1.05, 1.2)});
  EXPECT_TRUE(tracker.has_first());
  EXPECT_EQ(tracker.known()[0].frequency, 0.81);
}

TEST(RootTracker, ALostRootDoesNotTakeThePlaceOfANeighbour) {
  RootTracker tracker(0.05);
  tracker.follow({root(1.0, 0.95), root(1.04, 1.0)});
  ASSERT_EQ(tracker.known().size(), 2U);
  EXPECT_FALSE(tracker.follow({root(1.041, 1.001)}));
  EXPECT_FALSE(tracker.has_first()) << "what is left is the second";
  EXPECT_EQ(tracker.known()[0].frequency, 0.95);
  EXPECT_EQ(tracker.known()[1].frequency, 1.001);
}

TEST(RootTracker, WithoutRootsNothingIsKnown) {
  RootTracker tracker(0.05);
  EXPECT_FALSE(tracker.follow({}));
  EXPECT_FALSE(tracker.has_first());
  EXPECT_TRUE(tracker.known().empty());
  tracker.follow({root(1.0, 0.8)});
  EXPECT_FALSE(tracker.follow({root(1.0, 0.8, -1.0)})) << "it no longer destabilises";
  EXPECT_FALSE(tracker.has_first());
}

}  // namespace
}  // namespace wingbeat
