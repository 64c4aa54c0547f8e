#include "core/algebra/cuthill_mckee_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace wingbeat {
namespace {

struct Pattern {
  std::vector<int> row_begin{0}, columns;
};

// Cells of an ni x nj grid under scattered numbers, its rows reaching one cell right and one up.
Pattern scattered_grid(int ni, int nj) {
  const int n = ni * nj, stride = 37;  // prime to n
  std::vector<std::vector<int>> rows(n);
  for (int j = 0; j < nj; ++j)
    for (int i = 0; i < ni; ++i) {
      const auto number = [&](int a, int b) { return (a + ni * b) * stride % n; };
      std::vector<int>& row = rows[number(i, j)];
      row.push_back(number(i, j));
      if (i + 1 < ni) row.push_back(number(i + 1, j));
      if (j + 1 < nj) row.push_back(number(i, j + 1));
      std::sort(row.begin(), row.end());
    }
  Pattern p;
  for (const auto& row : rows) {
    p.columns.insert(p.columns.end(), row.begin(), row.end());
    p.row_begin.push_back(static_cast<int>(p.columns.size()));
  }
  return p;
}

int bandwidth(const Pattern& p, const std::vector<int>& order) {
  std::vector<int> step(order.size());
  for (std::size_t q = 0; q < order.size(); ++q) step[order[q]] = static_cast<int>(q);
  int width = 0;
  for (std::size_t row = 0; row < order.size(); ++row)
    for (int k = p.row_begin[row]; k < p.row_begin[row + 1]; ++k)
      width = std::max(width, std::abs(step[row] - step[p.columns[k]]));
  return width;
}

bool is_permutation(std::vector<int> order, int n) {
  std::sort(order.begin(), order.end());
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  return order == all;
}

TEST(CuthillMckeeOrder, BringsNeighboursTogether) {
  const Pattern p = scattered_grid(20, 6);
  const auto order = cuthill_mckee_order(p.row_begin, p.columns);
  ASSERT_TRUE(is_permutation(order, 120));
  // Layers of a grid from its corner are its diagonals, none longer than its short side.
  EXPECT_LE(bandwidth(p, order), 7);
  EXPECT_EQ(order, cuthill_mckee_order(p.row_begin, p.columns));
}

TEST(CuthillMckeeOrder, TakesPartsThatDoNotHangTogether) {
  const std::vector<int> row_begin{0, 1, 3, 4, 6}, columns{0, 1, 3, 2, 1, 3};
  EXPECT_TRUE(is_permutation(cuthill_mckee_order(row_begin, columns), 4));
  EXPECT_TRUE(cuthill_mckee_order(std::vector<int>{0}, {}).empty());
}

}  // namespace
}  // namespace wingbeat
