#include "core/spectral/time_spectral.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// f(theta) = sum_h Re(c_h e^{i h theta}) with c_h = (1/(1 + h), -h/3), and its derivative.
double value(int harmonics, double theta) {
  double f = 0.0;
  for (int h = 0; h <= harmonics; ++h) f += std::cos(h * theta) / (1 + h) + h / 3.0 * std::sin(h * theta);
  return f;
}
double slope(int harmonics, double theta) {
  double f = 0.0;
  for (int h = 0; h <= harmonics; ++h)
    f += -h * std::sin(h * theta) / (1 + h) + h * h / 3.0 * std::cos(h * theta);
  return f;
}

TEST(TimeSpectral, DerivativeIsExactForEveryHarmonicItHolds) {
  for (int harmonics = 0; harmonics <= 8; ++harmonics) {
    const TimeSpectral time(harmonics);
    const int n = time.instances();
    constexpr int width = 3;
    std::vector<double> f(n * width), df(n * width, 1.0);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < width; ++j) f[i * width + j] = (j + 1) * value(harmonics, time.phase(i));
    time.add_derivative(2.0, f, df);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < width; ++j) {
        const double exact = 1.0 + 2.0 * (j + 1) * slope(harmonics, time.phase(i));
        EXPECT_NEAR(df[i * width + j], exact, 1e-13 * (1 + harmonics * harmonics * harmonics));
      }
    }
  }
}

TEST(TimeSpectral, EigenvaluesAreTheHarmonicsTimesI) {
  const TimeSpectral time(4);
  const int n = time.instances();
  for (int m = -4; m <= 4; ++m) {
    for (int row = 0; row < n; ++row) {
      std::complex<double> product = 0.0;
      for (int column = 0; column < n; ++column)
        product += time.derivative(row, column) * std::polar(1.0, m * time.phase(column));
      const auto expected = std::complex<double>(0.0, m) * std::polar(1.0, m * time.phase(row));
      EXPECT_LT(std::abs(product - expected), 1e-13);
    }
  }
}

TEST(TimeSpectral, DerivativeIsAntisymmetricToTheLastBit) {
  const TimeSpectral time(3);
  for (int n = 0; n < time.instances(); ++n)
    for (int m = 0; m < time.instances(); ++m) EXPECT_EQ(time.derivative(n, m), -time.derivative(m, n));
}

TEST(TimeSpectral, WideFieldsAreDifferentiatedAsNarrowOnes) {
  const TimeSpectral time(2);
  constexpr int width = 1300;  // more than two of the stretches worked on at a time
  std::vector<double> f(time.instances() * width), df(f.size());
  for (int n = 0; n < time.instances(); ++n)
    for (int j = 0; j < width; ++j) f[n * width + j] = std::sin(time.phase(n) + j % 7);
  time.add_derivative(1.0, f, df);
  for (int n = 0; n < time.instances(); ++n)
    for (int j = 0; j < width; ++j) EXPECT_NEAR(df[n * width + j], std::cos(time.phase(n) + j % 7), 1e-13);
}

TEST(TimeSpectral, HarmonicsOfAKnownSignalAreItsCoefficients) {
  const TimeSpectral time(3);
  std::vector<double> f;
  for (int n = 0; n < time.instances(); ++n) f.push_back(value(3, time.phase(n)));
  const auto coefficients = time.harmonics_of(f);
  ASSERT_EQ(coefficients.size(), 4u);
  for (int h = 0; h <= 3; ++h)
    EXPECT_LT(std::abs(coefficients[h] - std::complex<double>(1.0 / (1 + h), -h / 3.0)), 1e-14);
}

TEST(TimeSpectral, InstancesOfUndoesHarmonicsOf) {
  const TimeSpectral time(5);
  std::vector<double> f(time.instances() * 2);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = std::sin(1.7 * static_cast<double>(i * i));
  const auto again = time.instances_of(time.harmonics_of(f));
  ASSERT_EQ(again.size(), f.size());
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(again[i], f[i], 1e-14);
}

TEST(TimeSpectral, RefusesAFieldThatDoesNotDivideIntoInstances) {
  const TimeSpectral time(1);
  std::vector<double> f(4), df(4);
  EXPECT_THROW(time.add_derivative(1.0, f, df), InternalError);
  EXPECT_THROW(TimeSpectral(-1), InternalError);
}

}  // namespace
}  // namespace wingbeat
