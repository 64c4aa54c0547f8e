#include "core/parallel/rank_texts.hpp"

#include <gtest/gtest.h>

namespace wingbeat {
namespace {

using Lines = std::vector<std::string>;

TEST(RankTexts, LinesNeedNoLastEnd) {
  EXPECT_EQ(lines_of("a\nb\n"), (Lines{"a", "b"}));
  EXPECT_EQ(lines_of("a\n\nb"), (Lines{"a", "", "b"}));
  EXPECT_TRUE(lines_of("").empty());
}

TEST(RankTexts, AreJoinedInRankOrderAndTheFirstCounts) {
  const Comm comm;
  const int last = comm.size() - 1;
  std::string all;
  for (int rank = 0; rank < comm.size(); ++rank) all += std::to_string(rank);
  EXPECT_EQ(joined(comm, std::to_string(comm.rank())), all);
  EXPECT_EQ(first_line(comm, std::to_string(comm.rank())), "0");
  EXPECT_EQ(first_line(comm, comm.rank() == last ? "of the last\nmore" : ""), "of the last");
  EXPECT_EQ(first_line(comm, ""), "");
}

}  // namespace
}  // namespace wingbeat
