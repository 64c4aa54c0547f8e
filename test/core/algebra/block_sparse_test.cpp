#include "core/algebra/block_sparse.hpp"

#include <gtest/gtest.h>

#include "test/core/algebra/model_grid.hpp"

namespace wingbeat::test {
namespace {

template <int B>
void expect_products_of_entries() {
  const Comm comm;
  const ModelGrid<B> grid(comm, 12, 5);
  const BlockSparse<B> a = grid.matrix();
  const std::vector<double> x = grid.template field<double>(0.2);
  std::vector<double> y(x.size()), expected(x.size());
  std::vector<double> zero(grid.cells.size());
  ShiftedOperator<double, B>(grid, a, zero).apply(x, y);
  for (std::size_t row = 0; row < grid.cells.size(); ++row) {
    for (const long column : grid.neighbours(grid.cells[row]))
      for (int r = 0; r < B; ++r)
        for (int s = 0; s < B; ++s)
          expected[row * B + r] += ModelGrid<B>::entry(grid.cells[row], column, r, s) *
                                   noise(0.2 + 0.71 * static_cast<double>(column) + 5.3 * s);
  }
  EXPECT_LT(distance(comm, y, expected), 1e-14 * norm(comm, expected));
}

TEST(BlockSparse, MultiplyIsTheSumOverEntriesOnAnyRanks) {
  expect_products_of_entries<1>();
  expect_products_of_entries<3>();
  expect_products_of_entries<4>();
  expect_products_of_entries<5>();
}

TEST(BlockSparse, MultiplyAddsToItsTarget) {
  const Comm comm;
  const ModelGrid<4> grid(comm, 8, 3);
  const BlockSparse<4> a = grid.matrix();
  const std::vector<double> x = grid.field<double>(0.1);
  const std::vector<double> ghosts(grid.halo.ghost_count() * 4);
  std::vector<double> once(x.size()), twice(x.size());
  a.multiply_add(x, ghosts, once);
  a.multiply_add(x, ghosts, twice);
  a.multiply_add(x, ghosts, twice);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(twice[i], 2.0 * once[i], 1e-13);
}

template <int B>
void expect_dot_test() {
  const Comm comm;
  const ModelGrid<B> grid(comm, 12, 5);
  const BlockSparse<B> a = grid.matrix();
  const ShiftedOperator<double, B> op(grid, a, std::vector<double>(grid.cells.size()));
  const auto x = grid.template field<double>(0.3);
  const auto v = grid.template field<double>(0.9);
  std::vector<double> ax(x.size()), atv(x.size());
  op.apply(x, ax);
  op.apply_transpose(v, atv);
  EXPECT_NEAR(bilinear(comm, v, ax), bilinear(comm, atv, x), 1e-13 * norm(comm, v) * norm(comm, ax));
}

TEST(BlockSparse, TransposePassesTheDotTest) {
  expect_dot_test<1>();
  expect_dot_test<3>();
  expect_dot_test<4>();
  expect_dot_test<5>();
}

TEST(BlockPattern, FindGivesThePositionOrMinusOne) {
  const BlockPattern pattern{2, 5, {0, 3, 5}, {0, 2, 4, 1, 3}};
  EXPECT_EQ(pattern.find(0, 2), 1);
  EXPECT_EQ(pattern.find(0, 3), -1);
  EXPECT_EQ(pattern.find(1, 3), 4);
  EXPECT_EQ(pattern.find(1, 4), -1);
}

}  // namespace
}  // namespace wingbeat::test
