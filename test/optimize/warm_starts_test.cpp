#include "optimize/warm_starts.hpp"

#include <gtest/gtest.h>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

using Numbers = std::vector<double>;

TEST(WarmStarts, TheNearestIsThatByScaledDistance) {
  WarmStarts starts({0.01, 1.0}, 5);
  EXPECT_TRUE(starts.is_empty());
  starts.add(Numbers{0.01, 0.0}, {1.0});
  starts.add(Numbers{0.0, 0.5}, {2.0});
  EXPECT_FALSE(starts.is_empty());
  EXPECT_EQ(starts.nearest(Numbers{0.0, 0.0}).solution, Numbers{2.0}) << "half a scale away, not one";
  EXPECT_EQ(starts.nearest(Numbers{0.009, 0.1}).solution, Numbers{1.0});
  EXPECT_EQ(starts.nearest(Numbers{0.009, 0.1}).design, (Numbers{0.01, 0.0}));
}

TEST(WarmStarts, TheNewestAreKept) {
  WarmStarts starts({1.0}, 2);
  for (const double x : {0.0, 1.0, 2.0}) starts.add(Numbers{x}, {10.0 * x});
  EXPECT_EQ(starts.nearest(Numbers{0.0}).solution, Numbers{10.0}) << "the first has gone";
  EXPECT_EQ(starts.nearest(Numbers{9.0}).solution, Numbers{20.0});
}

TEST(WarmStarts, ADesignSolvedAgainReplacesItsSolutionAndIsTheNewest) {
  WarmStarts starts({1.0}, 2);
  starts.add(Numbers{0.0}, {1.0});
  starts.add(Numbers{1.0}, {2.0});
  starts.add(Numbers{0.0}, {3.0});
  EXPECT_EQ(starts.nearest(Numbers{0.0}).solution, Numbers{3.0});
  EXPECT_EQ(starts.nearest(Numbers{1.0}).solution, Numbers{2.0});
  starts.add(Numbers{5.0}, {4.0});
  EXPECT_EQ(starts.nearest(Numbers{1.0}).solution, Numbers{3.0}) << "it is 1.0 that has gone";
}

TEST(WarmStarts, RefusesWhatDoesNotFit) {
  WarmStarts starts({1.0}, 1);
  EXPECT_THROW(starts.nearest(Numbers{0.0}), InternalError);
  EXPECT_THROW(starts.add(Numbers{0.0, 1.0}, {1.0}), InternalError);
}

}  // namespace
}  // namespace wingbeat
