#include "core/parallel/shared_board.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace wingbeat {
namespace {

// Every rank takes numbers until none is left: each is taken once. Without the lock two ranks would read the
// same.
TEST(SharedBoard, GivesEveryNumberToOneRankAlone) {
  const Comm comm;
  constexpr long count = 300;
  SharedBoard board(comm, std::vector<long>{0});
  std::vector<long> taken;
  while (true) {
    long own = count;
    board.use([&](std::span<long> numbers) {
      own = numbers[0];
      if (own < count) ++numbers[0];
    });
    if (own == count) break;
    taken.push_back(own);
  }
  comm.barrier();
  std::vector<long> all = comm.gather(std::span<const long>(taken));
  if (!comm.is_root()) return;
  std::ranges::sort(all);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(count));
  for (long i = 0; i < count; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
}

TEST(SharedBoard, IsFreeAgainAfterAFailure) {
  const Comm comm;
  SharedBoard board(comm, std::vector<long>{7});
  EXPECT_THROW(board.use([](std::span<long>) { throw std::runtime_error("full"); }), std::runtime_error);
  board.use([](std::span<long> numbers) { EXPECT_EQ(numbers[0], 7); });
  comm.barrier();
}

// The others may be at work and never come.
TEST(SharedBoard, IsLeftByAnExceptionWithoutTheOthers) {
  const Comm comm;
  const auto leave = [&] {
    const SharedBoard board(comm, std::vector<long>{7});
    if (comm.is_root()) comm.barrier();  // which the others reach when they have left
    throw std::runtime_error("failed");
  };
  EXPECT_THROW(leave(), std::runtime_error);
  if (!comm.is_root()) comm.barrier();
}

}  // namespace
}  // namespace wingbeat
