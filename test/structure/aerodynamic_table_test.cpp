#include "structure/aerodynamic_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "core/io/error.hpp"
#include "structure/branch_following.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

Eigen::MatrixXcd smooth(double k) {
  Eigen::MatrixXcd q(2, 2);
  q << Complex(std::cos(k), std::sin(k)), 1.0 / Complex(1.0, k), Complex(k * k, -k),
      std::exp(Complex(0.0, -2.0 * k));
  return q;
}

double largest_error(int samples, double k_min) {
  const AerodynamicTable table = tabulate(smooth, spread_reduced_frequencies(k_min, 1.0, samples));
  double error = 0.0;
  for (double k = k_min; k <= 1.0; k += 0.003) error = std::max(error, (table(k) - smooth(k)).norm());
  return error;
}

TEST(AerodynamicTable, ReproducesItsSamplesAndIsOfFourthOrder) {
  const std::vector<double> k = spread_reduced_frequencies(0.1, 1.0, 9);
  const AerodynamicTable table = tabulate(smooth, k);
  for (const double sample : k) EXPECT_LT((table(sample) - smooth(sample)).norm(), 1e-15);
  for (const double k_min : {0.0, 0.1}) {
    const double order = std::log2(largest_error(17, k_min) / largest_error(33, k_min));
    EXPECT_GT(order, 3.8) << "from k = " << k_min;
  }
}

TEST(AerodynamicTable, IsExactForCubics) {
  const auto cubic = [](double k) {
    return Eigen::MatrixXcd::Constant(1, 1, Complex(1.0 - k + k * k * k, 2.0 + 3.0 * k * k - k * k * k))
        .eval();
  };
  const AerodynamicTable table = tabulate(cubic, std::vector<double>{0.1, 0.2, 0.45, 0.7, 1.1});
  for (double k = 0.1; k <= 1.1; k += 0.01) {
    EXPECT_LT((table(k) - cubic(k)).norm(), 1e-14);
    EXPECT_NEAR(table.derivative(k)(0, 0).real(), -1.0 + 3.0 * k * k, 1e-13);
    EXPECT_NEAR(table.derivative(k)(0, 0).imag(), 6.0 * k - 3.0 * k * k, 1e-13);
  }
}

TEST(AerodynamicTable, IsEvenAndOddAtZero) {
  const AerodynamicTable table = tabulate(smooth, std::vector<double>{0.0, 0.2, 0.4, 0.7, 1.0});
  EXPECT_LT(table.derivative(0.0).real().norm(), 1e-15);
  // No curvature of the imaginary part: its slope changes with k^2 only.
  const double h = 1e-4;
  EXPECT_LT((table.derivative(h) - table.derivative(0.0)).imag().norm(), 20.0 * h * h);
}

TEST(AerodynamicTable, DoesNotExtrapolate) {
  const AerodynamicTable table = tabulate(smooth, spread_reduced_frequencies(0.1, 1.0, 5));
  EXPECT_THROW(table(0.0999), InternalError);
  EXPECT_THROW(table(1.0001), InternalError);
  EXPECT_THROW(table(std::numeric_limits<double>::quiet_NaN()), InternalError);
}

TEST(AerodynamicTable, RefusesSamplesItCannotInterpolate) {
  EXPECT_THROW(tabulate(smooth, std::vector<double>{0.1, 0.2, 0.3}), InputError);
  EXPECT_THROW(tabulate(smooth, std::vector<double>{0.1, 0.3, 0.2, 0.4}), InputError);
  EXPECT_THROW(tabulate(smooth, std::vector<double>{-0.1, 0.1, 0.2, 0.4}), InputError);
  const auto broken = [](double k) { return Eigen::MatrixXcd::Constant(1, 1, 1.0 / (k - 0.2)).eval(); };
  EXPECT_THROW(tabulate(broken, std::vector<double>{0.1, 0.2, 0.3, 0.4}), InputError);
  EXPECT_THROW(spread_reduced_frequencies(0.5, 0.5, 8), InputError);
}

TEST(BranchMatch, FollowsPredictionsNotOrder) {
  const std::vector<Complex> predicted = {{1.0, 0.0}, {2.0, 0.0}, {0.0, 3.0}};
  const std::vector<Complex> candidates = {{0.0, 3.05}, {1.01, 0.0}, {2.02, 0.0}};
  const BranchMatch match = match_branches(predicted, candidates);
  EXPECT_EQ(match.candidate, (std::vector<int>{1, 2, 0}));
  EXPECT_TRUE(match.is_clear);
}

TEST(BranchMatch, SaysWhereTwoBranchesCannotBeToldApart) {
  const std::vector<Complex> predicted = {{1.0, 0.0}, {1.1, 0.0}};
  const std::vector<Complex> candidates = {{1.06, 0.0}, {1.07, 0.0}};
  const BranchMatch match = match_branches(predicted, candidates);
  EXPECT_FALSE(match.is_clear);
  EXPECT_NE(match.candidate[0], match.candidate[1]);
}

}  // namespace
}  // namespace wingbeat
