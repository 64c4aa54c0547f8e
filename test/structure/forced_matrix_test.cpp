#include "structure/forced_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "test/structure/resting_section.hpp"

namespace wingbeat {
namespace {

using namespace testing;

constexpr double k = 0.2;
constexpr double degree = std::numbers::pi / 180.0;

// The same section in forced motion and by the linearized equations.
struct MovedSection : RestingSection {
  using RestingSection::RestingSection;

  Eigen::Matrix2cd forced(int harmonics, double amplitude_deg) {
    ForcedMatrixOptions options;
    options.amplitude = amplitude_deg * degree;
    options.flow.tolerance = 1e-11;
    return forced_aerodynamic_matrix<2>(*levels.back(), TimeSpectral(harmonics), kinematics, k, options);
  }
  Eigen::Matrix2cd linearized() {
    return LinearizedSection<2>(*levels.back(), kinematics, rest(), 1e-11).aerodynamic_matrix(k);
  }
};

// Forced motion, nonlinear and by differences, against the linearized equations: two ways to Q(k) that
// share no linearization. What is left must fall with the square of the amplitude.
TEST(ForcedMatrix, TendsToTheLinearizedMatrixWithTheSquareOfTheAmplitude) {
  MovedSection symmetric(0.0);
  const Eigen::Matrix2cd linear = symmetric.linearized();
  std::vector<Eigen::Matrix2d> differences;
  for (double degrees : {0.4, 0.2, 0.1})
    differences.push_back((symmetric.forced(1, degrees) - linear).cwiseAbs());
  for (std::size_t i = 0; i + 1 < differences.size(); ++i) {
    EXPECT_NEAR(std::log2(differences[i].norm() / differences[i + 1].norm()), 2.0, 0.1);
    for (Eigen::Index e = 0; e < 4; ++e)
      EXPECT_NEAR(std::log2(differences[i](e) / differences[i + 1](e)), 2.0, 0.1) << "entry " << e;
  }
  EXPECT_LE(differences.back().norm(), 0.01 * linear.norm());
}

// Three instances take the second harmonic, of the square of the amplitude, for the first.
TEST(ForcedMatrix, OfALiftingSectionNeedsTwoHarmonics) {
  MovedSection lifting(1.0);
  const Eigen::Matrix2cd linear = lifting.linearized();
  const auto order = [&](int harmonics) {
    return std::log2((lifting.forced(harmonics, 0.1) - linear).norm() /
                     (lifting.forced(harmonics, 0.05) - linear).norm());
  };
  EXPECT_NEAR(order(2), 2.0, 0.1);
  EXPECT_NEAR(order(1), 1.0, 0.1);
}

}  // namespace
}  // namespace wingbeat
