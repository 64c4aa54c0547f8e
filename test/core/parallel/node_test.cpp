#include "core/parallel/node.hpp"

#include <gtest/gtest.h>

namespace wingbeat {
namespace {

// Tests run on one machine. Ranks of other groups do not count.
TEST(Node, HoldsTheRanksOfTheGroupOnThisMachine) {
  const Comm comm;
  EXPECT_EQ(ranks_on_node(comm), comm.size());
  const SplitComm alone(comm, comm.rank());
  EXPECT_EQ(ranks_on_node(alone.get()), 1);
}

}  // namespace
}  // namespace wingbeat
