#include "core/algebra/block_ilu.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/io/error.hpp"
#include "test/core/algebra/model_grid.hpp"

namespace wingbeat::test {
namespace {

using Complex = std::complex<double>;
constexpr int full = 1000;  // more levels than there are cells

// The model grid of one rank with its ILU(fill).
template <class T, int B>
struct Factored {
  Comm alone{MPI_COMM_SELF};
  ModelGrid<B> grid;
  BlockSparse<B> matrix = grid.matrix();
  std::vector<T> shift = grid.template shift<T>();
  ShiftedOperator<T, B> op{grid, matrix, shift};
  std::shared_ptr<const IluPattern> pattern;
  BlockIlu<T, B> ilu;

  Factored(int ni, int nj, int fill)
      : grid(alone, ni, nj),
        pattern(std::make_shared<const IluPattern>(
            ilu_pattern(grid.pattern->row_begin, grid.pattern->columns, fill))),
        ilu(pattern) {
    ilu.factor(blocks());
  }
  std::vector<T> blocks() {
    std::vector<T> values(matrix.values().begin(), matrix.values().end());
    for (int row = 0; row < grid.pattern->row_count; ++row)
      for (int r = 0; r < B; ++r)
        values[static_cast<std::size_t>(grid.pattern->find(row, row)) * B * B + r * B + r] += shift[row];
    return values;
  }
};

template <class T, int B>
void expect_inverse() {
  const Factored<T, B> s(10, 6, full);
  const auto b = s.grid.template field<T>(0.6);
  std::vector<T> x(b.size()), ax(b.size());
  s.ilu.solve(b, x);
  s.op.apply(x, ax);
  EXPECT_LT(distance(s.alone, ax, b), 1e-12 * norm(s.alone, b));
  s.ilu.solve_transpose(b, x);
  s.op.apply_transpose(x, ax);
  EXPECT_LT(distance(s.alone, ax, b), 1e-12 * norm(s.alone, b));
}

TEST(BlockIlu, WithFullFillIsTheInverse) {
  expect_inverse<double, 1>();
  expect_inverse<double, 3>();
  expect_inverse<double, 4>();
  expect_inverse<double, 5>();
  expect_inverse<Complex, 1>();
  expect_inverse<Complex, 4>();
}

// What defines ILU: L U equals the matrix where entries are kept.
template <class T>
void expect_definition(int fill) {
  constexpr int B = 4;
  const Factored<T, B> s(8, 4, fill);
  const auto n = static_cast<Eigen::Index>(s.op.local_size());
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> a(n, n), inverse(n, n);
  std::vector<T> unit(static_cast<std::size_t>(n)), column(unit.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    std::fill(unit.begin(), unit.end(), T(0));
    unit[static_cast<std::size_t>(j)] = T(1);
    s.op.apply(unit, column);
    std::copy(column.begin(), column.end(), a.col(j).begin());
    s.ilu.solve(unit, column);
    std::copy(column.begin(), column.end(), inverse.col(j).begin());
  }
  const decltype(a) product = inverse.inverse();
  double elsewhere = 0.0;
  for (int row = 0; row < n / B; ++row)
    for (int cell = 0; cell < n / B; ++cell) {
      const auto begin = s.pattern->columns.begin();
      const bool is_kept =
          std::binary_search(begin + s.pattern->row_begin[row], begin + s.pattern->row_begin[row + 1], cell);
      const double error = (product - a).block(row * B, cell * B, B, B).norm();
      if (is_kept)
        EXPECT_LT(error, 1e-11) << row << ", " << cell;
      else
        elsewhere = std::max(elsewhere, error);
    }
  EXPECT_GT(elsewhere, 1e-4);
}

TEST(BlockIlu, AgreesWithTheMatrixOnItsPattern) {
  for (const int fill : {0, 1, 2}) {
    expect_definition<double>(fill);
    expect_definition<Complex>(fill);
  }
}

template <class T, int B>
void expect_dot_test(int fill) {
  const Factored<T, B> s(16, 6, fill);
  const auto x = s.grid.template field<T>(0.3);
  const auto v = s.grid.template field<T>(0.9);
  std::vector<T> mx(x.size()), mtv(x.size());
  s.ilu.solve(x, mx);
  s.ilu.solve_transpose(v, mtv);
  EXPECT_LT(std::abs(bilinear(s.alone, v, mx) - bilinear(s.alone, mtv, x)),
            1e-13 * norm(s.alone, v) * norm(s.alone, mx));
}

TEST(BlockIlu, TransposePassesTheDotTest) {
  for (const int fill : {0, 1, 3}) {
    expect_dot_test<double, 1>(fill);
    expect_dot_test<double, 4>(fill);
    expect_dot_test<double, 5>(fill);
    expect_dot_test<Complex, 1>(fill);
    expect_dot_test<Complex, 3>(fill);
    expect_dot_test<Complex, 4>(fill);
  }
}

TEST(BlockIlu, TakesMoreMemoryWithMoreFill) {
  const Factored<double, 4> none(16, 6, 0), one(16, 6, 1), two(16, 6, 2);
  EXPECT_GE(none.ilu.bytes(), 8.0 * 16 * static_cast<double>(none.grid.pattern->block_count()));
  EXPECT_LT(none.ilu.bytes(), one.ilu.bytes());
  EXPECT_LT(one.ilu.bytes(), two.ilu.bytes());
}

TEST(BlockIlu, RefusesASingularDiagonalBlock) {
  Factored<double, 4> s(10, 6, 1);
  auto blocks = s.blocks();
  // Two like rows in the first cell, whose diagonal block is factored as it is.
  const auto diagonal = static_cast<std::size_t>(s.grid.pattern->find(0, 0)) * 16;
  for (std::size_t c = 0; c < 4; ++c) blocks[diagonal + 4 + c] = blocks[diagonal + c];
  EXPECT_THROW(s.ilu.factor(blocks), InternalError);
  EXPECT_FALSE(s.ilu.is_factored());
  blocks[diagonal] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(s.ilu.factor(blocks), InternalError);
  std::vector<double> x(s.op.local_size()), y(x.size());
  EXPECT_THROW(s.ilu.solve(x, y), InternalError);
}

TEST(BlockIlu, RefusesValuesAndVectorsOfAWrongSize) {
  Factored<double, 3> s(10, 6, 1);
  std::vector<double> x(s.op.local_size()), y(x.size() - 1);
  EXPECT_THROW(s.ilu.solve(x, y), InternalError);
  EXPECT_THROW(s.ilu.solve_transpose(y, x), InternalError);
  EXPECT_THROW(s.ilu.factor(x), InternalError);
}

// Levels by their definition, on a dense matrix of them.
std::vector<std::vector<int>> dense_levels(const BlockPattern& p) {
  constexpr int none = 1 << 20;
  const int n = p.row_count;
  std::vector<std::vector<int>> level(n, std::vector<int>(n, none));
  for (int i = 0; i < n; ++i)
    for (int k = p.row_begin[i]; k < p.row_begin[i + 1]; ++k) level[i][p.columns[k]] = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < i; ++k)
      for (int j = k + 1; j < n; ++j) level[i][j] = std::min(level[i][j], level[i][k] + level[k][j] + 1);
  return level;
}

TEST(IluPattern, KeepsWhatItsLevelsSay) {
  const Comm alone(MPI_COMM_SELF);
  const ModelGrid<1> grid(alone, 8, 5);
  const BlockPattern& p = *grid.pattern;
  const auto levels = dense_levels(p);
  for (const int fill : {0, 1, 2, 4}) {
    const IluPattern ilu = ilu_pattern(p.row_begin, p.columns, fill);
    for (int i = 0; i < p.row_count; ++i) {
      std::vector<int> expected;
      for (int j = 0; j < p.row_count; ++j)
        if (levels[i][j] <= fill) expected.push_back(j);
      const std::vector<int> kept(ilu.columns.begin() + ilu.row_begin[i],
                                  ilu.columns.begin() + ilu.row_begin[i + 1]);
      EXPECT_EQ(kept, expected) << "row " << i << ", fill " << fill;
      EXPECT_EQ(ilu.columns[ilu.diagonal[i]], i);
      for (int k = p.row_begin[i]; k < p.row_begin[i + 1]; ++k)
        EXPECT_EQ(ilu.columns[ilu.positions[k]], p.columns[k]);
    }
  }
}

TEST(IluPattern, RefusesAMissingDiagonal) {
  const std::vector<int> row_begin{0, 2, 3}, columns{0, 1, 0};
  EXPECT_THROW(ilu_pattern(row_begin, columns, 1), InternalError);
  EXPECT_THROW(ilu_pattern(row_begin, columns, -1), InternalError);
}

}  // namespace
}  // namespace wingbeat::test
