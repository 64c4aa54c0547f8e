#include "core/io/nearest_name.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wingbeat {
namespace {

TEST(EditDistance, CountsInsertionDeletionSubstitutionAndSwap) {
  EXPECT_EQ(edit_distance("mach", "mach"), 0);
  EXPECT_EQ(edit_distance("mach", "match"), 1);
  EXPECT_EQ(edit_distance("match", "mach"), 1);
  EXPECT_EQ(edit_distance("mach", "macb"), 1);
  EXPECT_EQ(edit_distance("mach", "mcah"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(EditDistance, IgnoresCase) { EXPECT_EQ(edit_distance("Mach", "mACH"), 0); }

TEST(NearestName, FindsTheClosestAndRefusesTheFar) {
  const std::vector<std::string> names{"mach", "gamma", "jst_k2", "jst_k4"};
  EXPECT_EQ(nearest_name("mch", names), "mach");
  EXPECT_EQ(nearest_name("jst_k5", names), "jst_k2");  // the first of equals
  EXPECT_EQ(nearest_name("completely_different", names), "");
  EXPECT_EQ(nearest_name("mach", {}), "");
}

}  // namespace
}  // namespace wingbeat
