#include "core/algebra/schwarz.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/algebra/gmres.hpp"
#include "core/io/error.hpp"
#include "test/core/algebra/schwarz_case.hpp"

namespace wingbeat::test {
namespace {

// Cells of a rank and `layers` steps of the stencil around them, owned first.
std::vector<long> subdomain_cells(const ModelGrid<B>& grid, int layers) {
  std::vector<long> cells = grid.cells;
  std::set<long> seen(cells.begin(), cells.end());
  for (int layer = 0; layer < layers; ++layer) {
    const std::vector<long> reached = cells;
    for (const long g : reached)
      for (const long c : grid.neighbours(g))
        if (seen.insert(c).second) cells.push_back(c);
  }
  return cells;
}

// The definition, R0^T (R A R^T)^-1 R b, with dense matrices and globally known entries.
template <class T>
std::vector<T> dense_schwarz(const ModelGrid<B>& grid, int layers, double seed) {
  const auto cells = subdomain_cells(grid, layers);
  const auto n = static_cast<Eigen::Index>(cells.size()) * B;
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> a = decltype(a)::Zero(n, n);
  Eigen::Matrix<T, Eigen::Dynamic, 1> b(n);
  std::map<long, Eigen::Index> number;
  for (const long g : cells) number.emplace(g, static_cast<Eigen::Index>(number.size()));
  for (const long g : cells) {
    const Eigen::Index row = number[g] * B;
    for (int r = 0; r < B; ++r) {
      const double at = seed + 0.71 * static_cast<double>(g) + 5.3 * r;
      if constexpr (std::is_same_v<T, double>)
        b[row + r] = noise(at);
      else
        b[row + r] = T(noise(at), noise(at + 0.5));
      for (const long c : grid.neighbours(g))
        if (number.contains(c))
          for (int s = 0; s < B; ++s) a(row + r, number[c] * B + s) = ModelGrid<B>::entry(g, c, r, s);
      a(row + r, row + r) += ModelGrid<B>::template shift_of<T>(g);
    }
  }
  const Eigen::Matrix<T, Eigen::Dynamic, 1> x = a.partialPivLu().solve(b);
  return std::vector<T>(x.data(), x.data() + grid.cells.size() * B);
}

template <class T>
void expect_definition(int overlap) {
  const Preconditioned<T> s(16, 6, {.overlap = overlap});
  const auto b = s.grid.template field<T>(0.6);
  std::vector<T> y(b.size());
  s.schwarz.apply(b, y);
  const auto expected = dense_schwarz<T>(s.grid, overlap, 0.6);
  EXPECT_LT(distance(s.comm, y, expected), 1e-12 * norm(s.comm, expected)) << "overlap " << overlap;
}

TEST(Schwarz, IsItsDefinitionForAnyOverlap) {
  for (const int overlap : {0, 1, 2, 3}) {
    expect_definition<double>(overlap);
    expect_definition<Complex>(overlap);
  }
}

TEST(Schwarz, OverlapGrowsByLayersOfTheMatrixGraph) {
  const Comm comm;
  const ModelGrid<B> grid(comm, 16, 6);
  for (const int overlap : {0, 1, 2, 3}) {
    const Subdomain subdomain(comm, grid.halo, grid.pattern, {.overlap = overlap});
    EXPECT_EQ(subdomain.owned_count(), static_cast<int>(grid.cells.size()));
    EXPECT_EQ(subdomain.cell_count(), static_cast<int>(subdomain_cells(grid, overlap).size()));
  }
}

TEST(Schwarz, IsTheExactInverseOnOneRank) {
  const Preconditioned<Complex> s(16, 6, {.overlap = 2});
  if (s.comm.size() > 1) GTEST_SKIP() << "exact on one rank only";
  const auto b = s.grid.field<Complex>(0.6);
  std::vector<Complex> x(b.size()), ax(b.size());
  s.schwarz.apply(b, x);
  s.op.apply(x, ax);
  EXPECT_LT(distance(s.comm, ax, b), 1e-13 * norm(s.comm, b));
  s.schwarz.apply_transpose(b, x);
  s.op.apply_transpose(x, ax);
  EXPECT_LT(distance(s.comm, ax, b), 1e-13 * norm(s.comm, b));
}

template <class T>
void expect_dot_test(int overlap) {
  const Preconditioned<T> s(16, 6, {.overlap = overlap});
  const auto x = s.grid.template field<T>(0.3);
  const auto v = s.grid.template field<T>(0.9);
  std::vector<T> mx(x.size()), mtv(x.size());
  s.schwarz.apply(x, mx);
  s.schwarz.apply_transpose(v, mtv);
  EXPECT_LT(std::abs(bilinear(s.comm, v, mx) - bilinear(s.comm, mtv, x)),
            1e-13 * norm(s.comm, v) * norm(s.comm, mx));
}

TEST(Schwarz, TransposePassesTheDotTest) {
  for (const int overlap : {0, 1, 2}) {
    expect_dot_test<double>(overlap);
    expect_dot_test<Complex>(overlap);
  }
}

template <class T>
void expect_gmres_converges(bool transpose) {
  const Preconditioned<T> s(32, 12, {.overlap = 1});
  const TransposedOperator<T> op_transposed(s.op), schwarz_transposed(s.schwarz);
  const LinearOperator<T>& op = transpose ? static_cast<const LinearOperator<T>&>(op_transposed) : s.op;
  const LinearOperator<T>& m =
      transpose ? static_cast<const LinearOperator<T>&>(schwarz_transposed) : s.schwarz;
  const auto exact = s.grid.template field<T>(0.8);
  std::vector<T> b(exact.size()), x(exact.size());
  op.apply(exact, b);
  const auto result = gmres<T>(s.comm, op, m, b, x, {.relative_tolerance = 1e-12});
  EXPECT_EQ(result.status, GmresStatus::converged);
  EXPECT_LE(result.iterations, s.comm.size() == 1 ? 1 : 30);
  EXPECT_LT(distance(s.comm, x, exact), 1e-10 * norm(s.comm, exact));
}

TEST(Schwarz, MakesGmresConvergeInFewIterations) {
  expect_gmres_converges<double>(false);
  expect_gmres_converges<double>(true);
  expect_gmres_converges<Complex>(false);
  expect_gmres_converges<Complex>(true);
}

TEST(Schwarz, FactorsNewValuesOnTheSameAnalysis) {
  Preconditioned<double> s(16, 6, {.overlap = 1});
  const auto b = s.grid.field<double>(0.6);
  std::vector<double> before(b.size()), after(b.size());
  s.schwarz.apply(b, before);
  for (double& value : s.matrix.values()) value *= 4.0;
  for (double& value : s.shift) value *= 4.0;
  s.schwarz.factor(s.matrix, std::span<const double>(s.shift));
  s.schwarz.apply(b, after);
  for (double& value : after) value *= 4.0;
  EXPECT_LT(distance(s.comm, before, after), 1e-12 * norm(s.comm, before));
}

TEST(Schwarz, ASingularMatrixOnOneRankIsRefusedOnAll) {
  Preconditioned<double> s(16, 6, {.overlap = 1});
  if (s.comm.is_root()) {
    for (int k = s.grid.pattern->row_begin[0]; k < s.grid.pattern->row_begin[1]; ++k)
      std::fill_n(s.matrix.block(k).begin(), B, 0.0);  // the first row of cell 0
  }
  std::string message;
  try {
    s.schwarz.factor(s.matrix, {});
  } catch (const InternalError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("rank " + std::to_string(s.comm.rank())), std::string::npos) << message;
  if (s.comm.is_root()) {
    EXPECT_NE(message.find("singular"), std::string::npos) << message;
  }
  EXPECT_FALSE(s.schwarz.is_factored());
}

}  // namespace
}  // namespace wingbeat::test
