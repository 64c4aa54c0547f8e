#include "structure/theodorsen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

// Values computed to 30 digits by an independent program.
TEST(TheodorsenFunction, MatchesReferenceValues) {
  struct Case {
    double k;
    Complex c;
  };
  for (const Case& expected : std::vector<Case>{{0.1, {.831924104965, -.172302228734}},
                                                {0.5, {.597936064250, -.150709503163}},
                                                {1.0, {.539434871078, -.100272902864}}})
    EXPECT_LT(std::abs(theodorsen_function(expected.k) - expected.c), 1e-12) << "k = " << expected.k;
}

TEST(TheodorsenFunction, AgreesWithHankelFunctionsOverTheWholeRange) {
  // std::cyl_neumann keeps about 13 digits.
  for (double k = 0.01; k < 60.0; k *= 1.07) {
    const Complex h0(std::cyl_bessel_j(0.0, k), -std::cyl_neumann(0.0, k));
    const Complex h1(std::cyl_bessel_j(1.0, k), -std::cyl_neumann(1.0, k));
    const Complex expected = h1 / (h1 + Complex(0.0, 1.0) * h0);
    EXPECT_LT(std::abs(theodorsen_function(k) - expected), 2e-12) << "k = " << k;
  }
}

TEST(TheodorsenFunction, HasItsKnownLimits) {
  EXPECT_EQ(theodorsen_function(0.0), Complex(1.0));
  EXPECT_NEAR(std::abs(theodorsen_function(1e-12) - 1.0), 0.0, 1e-10);
  EXPECT_NEAR(std::abs(theodorsen_function(1e6) - 0.5), 0.0, 1e-6);
}

// The series serves |s| <= 2 and the continued fraction the rest: they must meet, at every angle.
TEST(GeneralisedTheodorsenFunction, IsContinuousWhereTheTwoExpansionsMeet) {
  for (double angle = -2.8; angle <= 2.8; angle += 0.2) {
    const Complex inside = generalised_theodorsen_function(std::polar(2.0 * (1.0 - 1e-15), angle));
    const Complex outside = generalised_theodorsen_function(std::polar(2.0 * (1.0 + 1e-15), angle));
    EXPECT_LT(std::abs(inside - outside), 1e-13 * std::abs(inside)) << "angle " << angle;
  }
}

TEST(GeneralisedTheodorsenFunction, IsAnalytic) {
  // Cauchy-Riemann by central differences, step h: error of order h^2.
  const double h = 1e-4;
  for (const Complex s : {Complex(0.3, 0.4), Complex(-0.2, 1.5), Complex(2.5, 1.0), Complex(-0.5, 3.0)}) {
    const Complex along = generalised_theodorsen_function(s + h) - generalised_theodorsen_function(s - h);
    const Complex across = generalised_theodorsen_function(s + Complex(0.0, h)) -
                           generalised_theodorsen_function(s - Complex(0.0, h));
    EXPECT_LT(std::abs(along / (2.0 * h) - across / Complex(0.0, 2.0 * h)), 1e-7);
  }
}

TEST(TheodorsenFunction, RefusesArgumentsWhereItIsNotDefined) {
  EXPECT_THROW(theodorsen_function(-0.1), InputError);
  EXPECT_THROW(theodorsen_function(std::numeric_limits<double>::quiet_NaN()), InputError);
  EXPECT_THROW(generalised_theodorsen_function({-1.0, 0.0}), InputError);
}

TEST(TheodorsenMatrix, GivesTheLiftOfASectionPitchingAboutItsQuarterChord) {
  EXPECT_LT(std::abs(-theodorsen_matrix(-0.5, 0.0814)(0, 1) - Complex(5.465229882, -.319397093)), 1e-9);
  EXPECT_LT(std::abs(-theodorsen_matrix(-0.5, 0.202)(0, 1) - Complex(4.736858123, .371240011)), 1e-9);
}

TEST(TheodorsenMatrix, IsTheFlatPlateAtRest) {
  const double a = -0.6;
  const Eigen::MatrixXcd q = theodorsen_matrix(a, 0.0);
  EXPECT_EQ(q.imag().norm(), 0.0);
  EXPECT_EQ(q.col(0).norm(), 0.0);
  EXPECT_NEAR(q(0, 1).real(), -2.0 * std::numbers::pi, 1e-15);
  // Lift at the quarter chord, a + 1/2 semichords ahead of the elastic axis, twice C_m on the chord.
  EXPECT_NEAR(q(1, 1).real(), 2.0 * std::numbers::pi * (a + 0.5), 1e-15);
}

// Moving the elastic axis changes coordinates only: f^T du is invariant, h_a = h_0 + a alpha.
TEST(TheodorsenMatrix, TransformsWithTheElasticAxis) {
  const double a = 0.37;
  Eigen::Matrix2cd shift = Eigen::Matrix2cd::Identity();
  shift(0, 1) = -a;  // plunge of mid-chord, from that of the axis
  const Eigen::MatrixXcd expected = shift.transpose() * theodorsen_matrix(0.0, 0.7) * shift;
  EXPECT_LT((theodorsen_matrix(a, 0.7) - expected).norm(), 1e-13);
}

}  // namespace
}  // namespace wingbeat
