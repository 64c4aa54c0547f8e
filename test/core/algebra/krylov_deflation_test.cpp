#include "core/algebra/krylov_deflation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>

#include "core/algebra/hessenberg_least_squares.hpp"
#include "core/io/error.hpp"
#include "test/core/algebra/model_grid.hpp"

namespace wingbeat::test {
namespace {

using Complex = std::complex<double>;

template <class T>
T entry(double seed) {
  if constexpr (std::is_same_v<T, double>)
    return noise(seed);
  else
    return {noise(seed), noise(seed + 0.5)};
}

// (m+1) x m, dense in the first k columns as after a deflated restart, Hessenberg after them.
template <class T>
DenseMatrix<T> projected_matrix(int m, int k) {
  DenseMatrix<T> h = DenseMatrix<T>::Zero(m + 1, m);
  for (int j = 0; j < m; ++j) {
    const int last = j < k ? k : j + 1;
    for (int i = 0; i < last; ++i) h(i, j) = entry<T>(1.7 * i + 0.61 * j) + T(i == j ? 2.0 : 0.0);
    h(last, j) = j < k ? entry<T>(0.3 * j) : T(0.4 + 0.1 * noise(j));
  }
  return h;
}

template <class T>
HessenbergLeastSquares<T> least_squares(const DenseMatrix<T>& h, const DenseVector<T>& c, int k) {
  HessenbergLeastSquares<T> small = k == 0
                                        ? HessenbergLeastSquares<T>(std::real(c[0]))
                                        : HessenbergLeastSquares<T>(h.topLeftCorner(k + 1, k), c.head(k + 1));
  for (int j = k; j < h.cols(); ++j) {
    const std::vector<T> column(h.col(j).begin(), h.col(j).begin() + j + 1);
    const double estimate = small.add_column(column, std::real(h(j + 1, j)));
    const std::vector<T> y = small.solution();
    const Eigen::Map<const DenseVector<T>> solution(y.data(), j + 1);
    EXPECT_NEAR(estimate, (c.head(j + 2) - h.topLeftCorner(j + 2, j + 1) * solution).norm(), 1e-13);
  }
  return small;
}

template <class T>
void expect_minimiser(int k) {
  constexpr int m = 9;
  const auto h = projected_matrix<T>(m, k);
  DenseVector<T> c = DenseVector<T>::Zero(m + 1);
  for (int i = 0; i <= k; ++i) c[i] = k == 0 ? T(1.5) : entry<T>(0.9 * i);
  const auto small = least_squares<T>(h, c, k);
  const auto y = small.solution();
  const DenseVector<T> expected = h.colPivHouseholderQr().solve(c);
  EXPECT_LT((Eigen::Map<const DenseVector<T>>(y.data(), m) - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT((small.matrix() - h).norm(), 1e-15);
}

TEST(HessenbergLeastSquares, IsTheMinimiserWithAndWithoutAKeptPart) {
  for (const int k : {0, 1, 4, 8}) {
    expect_minimiser<double>(k);
    expect_minimiser<Complex>(k);
  }
}

TEST(HessenbergLeastSquares, RefusesAKeptPartOfAWrongShape) {
  EXPECT_THROW(HessenbergLeastSquares<double>(DenseMatrix<double>::Zero(3, 3), DenseVector<double>::Zero(3)),
               InternalError);
}

template <class T>
void expect_arnoldi_relation(int count) {
  constexpr int m = 12;
  const auto h = projected_matrix<T>(m, 3);
  DenseVector<T> c = DenseVector<T>::Zero(m + 1);
  for (int i = 0; i <= 3; ++i) c[i] = entry<T>(0.9 * i);
  const DenseVector<T> residual = c - h * h.colPivHouseholderQr().solve(c).eval();
  const auto space = deflated_space<T>(h, count);
  ASSERT_TRUE(space);
  const auto k = space->hessenberg.cols();
  EXPECT_GE(k, count - 1);
  EXPECT_LE(k, std::min(count + 1, m - 1));
  EXPECT_EQ(space->basis.cols(), k + 1);
  EXPECT_LT((space->basis.adjoint() * space->basis - DenseMatrix<T>::Identity(k + 1, k + 1)).norm(), 1e-13);
  const DenseMatrix<T> images = h * space->basis.topLeftCorner(m, k);
  EXPECT_LT((images - space->basis * space->hessenberg).norm(), 1e-12 * images.norm());
  // The residual lies in what is kept.
  EXPECT_LT((residual - space->basis * (space->basis.adjoint() * residual)).norm(), 1e-14 * c.norm());
}

TEST(KrylovDeflation, KeepsTheArnoldiRelationAndTheResidual) {
  for (const int count : {1, 2, 5, 10}) {
    expect_arnoldi_relation<double>(count);
    expect_arnoldi_relation<Complex>(count);
  }
}

// H^H H g = theta H_m^H g, theta found from the pencil itself.
TEST(KrylovDeflation, KeepsTheHarmonicRitzVectorsOfLeastMagnitude) {
  constexpr int m = 10, count = 3;
  const auto h = projected_matrix<Complex>(m, 0);
  const auto space = deflated_space<Complex>(h, count);
  ASSERT_TRUE(space);
  const DenseMatrix<Complex> square = h.topRows(m);
  const DenseMatrix<Complex> pencil = square.adjoint().partialPivLu().solve(h.adjoint() * h);
  const Eigen::ComplexEigenSolver<DenseMatrix<Complex>> solver(pencil);
  std::vector<int> order(m);
  for (int i = 0; i < m; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::abs(solver.eigenvalues()[a]) < std::abs(solver.eigenvalues()[b]);
  });
  const DenseMatrix<Complex> kept = space->basis.topLeftCorner(m, count);
  for (int i = 0; i < count; ++i) {
    const DenseVector<Complex> g = solver.eigenvectors().col(order[i]);
    EXPECT_LT((g - kept * (kept.adjoint() * g)).norm(), 1e-10);
  }
}

TEST(KrylovDeflation, KeepsConjugatePairsWhole) {
  // Pairs of magnitude 1, 2, 3 and 4.
  DenseMatrix<double> h = DenseMatrix<double>::Zero(9, 8);
  for (int p = 0; p < 4; ++p)
    h.block<2, 2>(2 * p, 2 * p) << 0.6 * (p + 1), -0.8 * (p + 1), 0.8 * (p + 1), 0.6 * (p + 1);
  for (int j = 0; j < 8; ++j) h(j + 1, j) += 1e-9;
  for (const int count : {1, 2, 3, 4, 5, 6, 7}) {
    const auto space = deflated_space<double>(h, count);
    ASSERT_TRUE(space) << count;
    EXPECT_EQ(space->hessenberg.cols(), std::min(count + count % 2, 6)) << count;
  }
}

TEST(KrylovDeflation, KeepsNothingOfAMatrixWithoutFullRank) {
  DenseMatrix<double> h = projected_matrix<double>(6, 0);
  h.col(5) = h.col(4);
  EXPECT_FALSE(deflated_space<double>(h, 2));
  EXPECT_FALSE(deflated_space<double>(projected_matrix<double>(6, 0), 0));
}

}  // namespace
}  // namespace wingbeat::test
