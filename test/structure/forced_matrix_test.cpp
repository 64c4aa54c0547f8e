#include "structure/forced_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flow/steady_sequence.hpp"
#include "structure/linear_flutter.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;

// Forced motion, nonlinear and by differences, against the linearized equations: two ways to Q(k) that
// share no linearization. What is left must fall with the square of the amplitude.
TEST(ForcedMatrix, TendsToTheLinearizedMatrixWithTheSquareOfTheAmplitude) {
  const FlowModel<2, double> model{{1.4, 0.796, 1.0, 0.0}, JstScheme{0.25, 1.0 / 64.0, 1.0}};
  const SectionKinematics kinematics{.flow_speed = model.freestream.speed()};
  FlowLevels<2> levels;
  levels.push_back(std::make_unique<FlowLevel<2>>(Comm(), section_mesh("naca64a010", 64, 16), model,
                                                  Vec<double, 2>{{{0.25, 0.0}}}, FlowLevelOptions{}));
  FlowLevel<2>& level = *levels.back();
  PseudoTransientOptions steady;
  steady.tolerance = 5e-12;
  ASSERT_EQ(solve_steady<2>(levels, {}, steady).status, SolveStatus::converged);

  constexpr double k = 0.2;
  LinearizedSection<2> section(level, kinematics, {level.w, std::vector<double>(4, 0.0), 0.0, 1.0}, 1e-11);
  const Eigen::Matrix2cd linear = section.aerodynamic_matrix(k);
  std::vector<Eigen::Matrix2d> differences;
  for (double degrees : {0.4, 0.2, 0.1}) {
    ForcedMatrixOptions options;
    options.amplitude = degrees * std::numbers::pi / 180.0;
    options.flow.tolerance = 1e-11;
    differences.push_back(
        (forced_aerodynamic_matrix<2>(level, TimeSpectral(1), kinematics, k, options) - linear).cwiseAbs());
  }
  for (std::size_t i = 0; i + 1 < differences.size(); ++i) {
    EXPECT_NEAR(std::log2(differences[i].norm() / differences[i + 1].norm()), 2.0, 0.1);
    for (Eigen::Index e = 0; e < 4; ++e)
      EXPECT_NEAR(std::log2(differences[i](e) / differences[i + 1](e)), 2.0, 0.1) << "entry " << e;
  }
  EXPECT_LE(differences.back().norm(), 0.01 * linear.norm());
}

}  // namespace
}  // namespace wingbeat
