// Limit cycles of a typical section with quasi-steady aerodynamics and a cubic-quintic pitch spring
// (He, Jonsson & Martins, Nonlinear Dynamics 2022). Its Hopf point is known exactly, its cycles to
// twelve digits from an independent program, through the solver that finds limit cycles in flow.
#include <gtest/gtest.h>

#include "core/algebra/newton.hpp"
#include "test/verification/quasi_steady_cycle.hpp"

namespace wingbeat {
namespace {

using namespace quasi_steady;

struct Cycle {
  double velocity;
  double frequency;
};

// Solves from the linear mode at the Hopf point.
std::vector<double> solve(LimitCycle& problem, double amplitude) {
  std::vector<double> u = problem.start(hopf_point(), amplitude);
  NewtonOptions options;
  options.forcing_max = 1e-3;
  options.refactor_iterations = 4;
  const NewtonResult result = newton(Comm(), problem, u, options);
  EXPECT_EQ(result.status, SolveStatus::converged) << to_string(result.status);
  EXPECT_LE(result.iterations, 10);
  return u;
}

Cycle limit_cycle(Spring spring, int harmonics, double amplitude_deg) {
  LimitCycle problem(section(spring), harmonics, amplitude_deg * degree);
  const std::vector<double> u = solve(problem, amplitude_deg * degree);
  return {u[u.size() - 1], u[u.size() - 2]};
}

TEST(QuasiSteadyLco, HopfPointIsExact) {
  const FlutterRoot root = hopf_point();
  const double exact = 3.0 / std::sqrt(13.0);
  EXPECT_TRUE(root.is_converged);
  EXPECT_TRUE(root.is_destabilising());
  EXPECT_NEAR(root.reduced_velocity, exact, 1e-12);
  EXPECT_NEAR(root.frequency, exact, 1e-12);
}

TEST(QuasiSteadyLco, JacobianAgreesWithDifferencesOfTheResidual) {
  LimitCycle problem(section({-1.5, 50.0}), 2, 0.3);
  std::vector<double> u = problem.start(hopf_point(), 0.3);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += 0.05 * std::sin(3.0 * static_cast<double>(i) + 1.0);
  problem.linearize(u);
  const Eigen::MatrixXd jacobian = problem.jacobian_matrix();
  // Central differences of a quintic, step h: error h^2 f'''/6 + eps/h, about 1e-9.
  const double step = 1e-5;
  std::vector<double> above(u.size()), below(u.size());
  for (std::size_t j = 0; j < u.size(); ++j) {
    std::vector<double> moved = u;
    moved[j] = u[j] + step;
    problem.residual(moved, above);
    moved[j] = u[j] - step;
    problem.residual(moved, below);
    for (std::size_t i = 0; i < u.size(); ++i)
      EXPECT_NEAR(jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                  (above[i] - below[i]) / (2.0 * step), 1e-8)
          << "row " << i << ", column " << j;
  }
}

TEST(QuasiSteadyLco, NineCyclesAgreeToTenDigits) {
  struct Case {
    Spring spring;
    double amplitude_deg;
    Cycle cycle;
  };
  const std::vector<Case> cases = {
      {{1.5, 0.0}, 1.0, {.832192857830, .832192855070}},
      {{1.5, 0.0}, 5.0, {.835610740820, .835609018385}},
      {{1.5, 0.0}, 9.0, {.843558758490, .843540742384}},
      {{-1.5, 0.0}, 1.0, {.831907718689, .831907715929}},
      {{-1.5, 0.0}, 5.0, {.828482249624, .828480522389}},
      {{-1.5, 0.0}, 9.0, {.820462056318, .820443877774}},
      {{-1.5, 50.0}, 1.0, {.831908925061, .831908922371}},
      {{-1.5, 50.0}, 5.0, {.829236591719, .829235783625}},
      {{-1.5, 50.0}, 9.0, {.828410787463, .828410530393}},
  };
  for (const Case& expected : cases) {
    SCOPED_TRACE(testing::Message() << "k3 " << expected.spring.cubic << ", k5 " << expected.spring.quintic
                                    << ", amplitude " << expected.amplitude_deg << " deg");
    const Cycle cycle = limit_cycle(expected.spring, 7, expected.amplitude_deg);
    EXPECT_NEAR(cycle.velocity, expected.cycle.velocity, 1e-10);
    EXPECT_NEAR(cycle.frequency, expected.cycle.frequency, 1e-10);
  }
}

TEST(QuasiSteadyLco, OneHarmonicUnderpredictsTwoOverpredictThreeAreRight) {
  const std::vector<std::pair<int, double>> expected = {
      {1, .843519383818}, {2, .843590131691}, {3, .843558768733}, {5, .843558758490}};
  for (const auto& [harmonics, velocity] : expected)
    EXPECT_NEAR(limit_cycle({1.5, 0.0}, harmonics, 9.0).velocity, velocity, 1e-11)
        << harmonics << " harmonics";
}

TEST(QuasiSteadyLco, SpeedGradientMatchesTheReference) {
  const std::vector<std::pair<int, Eigen::Vector2d>> expected = {{2, {0.0414618981, 0.0023792272}},
                                                                 {5, {0.0414618254, 0.0023811824}}};
  for (const auto& [harmonics, gradient] : expected) {
    LimitCycle problem(section({-1.5, 50.0}), harmonics, 5.0 * degree);
    const Eigen::Vector2d computed = problem.velocity_gradient(solve(problem, 5.0 * degree));
    EXPECT_NEAR(computed[0], gradient[0], 1e-10) << harmonics << " harmonics";
    EXPECT_NEAR(computed[1], gradient[1], 1e-10) << harmonics << " harmonics";
  }
}

}  // namespace
}  // namespace wingbeat
