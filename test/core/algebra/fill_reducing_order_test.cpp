#include "core/algebra/fill_reducing_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace wingbeat {
namespace {

struct Pattern {
  std::vector<int> row_begin{0}, columns;
};

// A grid whose rows reach right and up only: what is missing must be filled in for METIS.
Pattern one_way_grid(int n) {
  Pattern p;
  for (int cell = 0; cell < n * n; ++cell) {
    p.columns.push_back(cell);
    if (cell % n + 1 < n) p.columns.push_back(cell + 1);
    if (cell + n < n * n) p.columns.push_back(cell + n);
    p.row_begin.push_back(static_cast<int>(p.columns.size()));
  }
  return p;
}

// Off-diagonal entries of L by plain symbolic elimination.
std::size_t fill(const Pattern& p, const std::vector<int>& order) {
  const int n = static_cast<int>(order.size());
  std::vector<int> step(n);
  for (int q = 0; q < n; ++q) step[order[q]] = q;
  std::vector<std::set<int>> below(n);
  for (int row = 0; row < n; ++row)
    for (int k = p.row_begin[row]; k < p.row_begin[row + 1]; ++k) {
      const auto [low, high] = std::minmax(step[row], step[p.columns[k]]);
      if (low != high) below[low].insert(high);
    }
  std::size_t count = 0;
  for (int q = 0; q < n; ++q) {
    count += below[q].size();
    if (below[q].empty()) continue;
    const int parent = *below[q].begin();
    below[parent].insert(std::next(below[q].begin()), below[q].end());
  }
  return count;
}

TEST(FillReducingOrder, IsAPermutationAndRepeatable) {
  const Pattern p = one_way_grid(24);
  const auto order = fill_reducing_order(p.row_begin, p.columns);
  EXPECT_EQ(order, fill_reducing_order(p.row_begin, p.columns));
  auto sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < 24 * 24; ++i) EXPECT_EQ(sorted[i], i);
}

TEST(FillReducingOrder, HalvesTheFillOfTheNaturalOrder) {
  const Pattern p = one_way_grid(32);
  std::vector<int> natural(32 * 32);
  std::iota(natural.begin(), natural.end(), 0);
  EXPECT_LT(2 * fill(p, fill_reducing_order(p.row_begin, p.columns)), fill(p, natural));
}

TEST(FillReducingOrder, HandlesCellsWithoutNeighbours) {
  EXPECT_EQ(fill_reducing_order(std::vector{0}, {}), std::vector<int>{});
  EXPECT_EQ(fill_reducing_order(std::vector{0, 1, 2}, std::vector{0, 1}), (std::vector{0, 1}));
}

}  // namespace
}  // namespace wingbeat
