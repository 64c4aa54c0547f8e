#include "flow/backward_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

// The formula for t^degree at t = 1 with steps dt.
double difference_of_power(const BackwardDifference& formula, int degree, double dt) {
  double sum = 0.0;
  for (int k = 0; k <= formula.order; ++k)
    sum += formula.c[static_cast<std::size_t>(k)] * std::pow(1.0 - k * dt, degree);
  return sum / dt;
}

TEST(BackwardDifference, HasTheFamiliarCoefficients) {
  const std::array<std::array<double, 4>, 3> expected{
      {{1.0, -1.0, 0.0, 0.0}, {3.0 / 2, -2.0, 1.0 / 2, 0.0}, {11.0 / 6, -3.0, 3.0 / 2, -1.0 / 3}}};
  for (int order = 1; order <= 3; ++order)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(BackwardDifference(order).c[k], expected[static_cast<std::size_t>(order - 1)][k], 1e-15);
}

// Beyond its degree the error is -dt^p w^(p+1) / (p + 1), exactly so for a polynomial of degree p + 1.
TEST(BackwardDifference, IsExactForPolynomialsOfItsOrderOnly) {
  constexpr double dt = 0.1;
  double factorial = 1.0;
  for (int order = 1; order <= 3; ++order) {
    const BackwardDifference formula(order);
    for (int degree = 0; degree <= order; ++degree)
      EXPECT_NEAR(difference_of_power(formula, degree, dt), degree, 1e-13) << order;
    factorial *= order;
    EXPECT_NEAR(difference_of_power(formula, order + 1, dt), order + 1 - factorial * std::pow(dt, order),
                1e-13);
  }
}

// A step of dw/dt = i omega w multiplies w by e^z, z of eq:bdf-oscillation: to the third power of theta =
// omega dt, order 2 lowers the frequency and damps, order 3 lets it be and drives as strongly.
TEST(BackwardDifference, TurnsOscillationsAsItsSymbolTells) {
  constexpr double theta = 0.05;
  for (int order : {2, 3}) {
    const BackwardDifference formula(order);
    Complex z(0.0, theta);
    for (int k = 0; k < 20; ++k) {  // Newton's method for sum_k c_k e^{-kz} = i theta
      Complex value(0.0, -theta), slope = 0.0;
      for (int j = 0; j <= order; ++j) {
        const Complex term = formula.c[static_cast<std::size_t>(j)] * std::exp(-z * static_cast<double>(j));
        value += term;
        slope -= static_cast<double>(j) * term;
      }
      z -= value / slope;
    }
    const double third = std::pow(theta, 3), fourth = std::pow(theta, 4), sixth = std::pow(theta, 6);
    // The next terms are odd and even powers in turn, with coefficients of the size of one.
    EXPECT_NEAR(z.real(), (order == 2 ? -0.25 : 0.25) * fourth, 5.0 * sixth) << order;
    EXPECT_NEAR(z.imag(), theta - (order == 2 ? third / 3.0 : 0.0), 5.0 * fourth * theta) << order;
  }
}

TEST(BackwardDifference, RefusesOtherOrders) {
  for (int order : {-1, 0, 4}) EXPECT_THROW(BackwardDifference{order}, InternalError);
}

TEST(Extrapolation, IsExactForThePolynomialThroughItsLevelsOnly) {
  for (int levels = 1; levels <= 4; ++levels) {
    const auto weights = extrapolation_weights(levels);
    ASSERT_EQ(weights.size(), static_cast<std::size_t>(levels));
    for (int degree = 0; degree <= levels; ++degree) {
      double next = 0.0;
      for (int k = 0; k < levels; ++k)
        next += weights[static_cast<std::size_t>(k)] * std::pow(1.0 - 0.1 * (k + 1), degree);
      if (degree < levels)
        EXPECT_NEAR(next, 1.0, 1e-14);
      else
        EXPECT_GE(std::abs(next - 1.0), 1e-5);
    }
  }
}

}  // namespace
}  // namespace wingbeat
