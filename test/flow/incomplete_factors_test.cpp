// Flow solved with block ILU in place of LU: the same solution, by other factors.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flow/forced_flow.hpp"
#include "flow/frequency_response.hpp"
#include "flow/shifted_jacobian.hpp"
#include "flow/steady_sequence.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;
using Complex = std::complex<double>;

constexpr double kappa = 0.4;

// A transonic section with incidence, its steady flow solved.
struct SteadyLevel {
  FlowLevels<2> levels;
  PseudoTransientResult result;
  FlowLevel<2>& level() { return *levels.back(); }

  explicit SteadyLevel(SubdomainMethod method) {
    const double angle = std::numbers::pi / 180.0;
    const FlowModel<2, double> model{{1.4, 0.8, std::cos(angle), std::sin(angle)},
                                     JstScheme{0.25, 1.0 / 64.0, 1.0}};
    levels.push_back(std::make_unique<FlowLevel<2>>(
        Comm(), section_mesh("naca0012", 64, 16), model, Vec<double, 2>{{{0.25, 0.0}}},
        FlowLevelOptions{.partition = {}, .subdomain = {.method = method}}));
    PseudoTransientOptions options;
    options.tolerance = 1e-11;
    result = solve_steady<2>(levels, {}, options);
    EXPECT_EQ(result.status, SolveStatus::converged);
    const MotionState rest;
    level().steady.linearize(level().w, {&rest, 1}, 0.0);
  }
};

// Forces and moment of the steady flow, then of its response to pitch.
std::vector<Complex> steady_and_linear_loads(SteadyLevel& steady) {
  FlowLevel<2>& level = steady.level();
  const MotionState rest;
  const Loads<double> loads = level.steady.loads(level.w, {&rest, 1})[0];
  FrequencyResponse<2> response(level.steady, unfactored(level.comm(), level.subdomain, 4, 1).harmonics[0]);
  const auto linear = response.at(kappa).loads.pitch;
  return {loads.force_x, loads.force_y, loads.moment, linear[0], linear[1]};
}

TEST(IncompleteFactors, GiveTheSteadyFlowAndItsResponseOfExactOnes) {
  SteadyLevel exact(SubdomainMethod::lu);
  const auto expected = steady_and_linear_loads(exact);
  SteadyLevel incomplete(SubdomainMethod::ilu);
  EXPECT_LE(incomplete.result.iterations, 2 * exact.result.iterations);
  EXPECT_LT(incomplete.level().solver->factor_bytes(), exact.level().solver->factor_bytes());
  const auto found = steady_and_linear_loads(incomplete);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LE(std::abs(found[i] - expected[i]), 1e-8) << "load " << i;
}

TEST(IncompleteFactors, GiveTheForcedFlowOfExactOnes) {
  const TimeSpectral time(1);
  const double degree = std::numbers::pi / 180.0;
  const ForcedMotion motion{.mean_pitch = 0.0, .pitch = {Complex(0.0, -0.5 * degree)}, .plunge = {}};
  const auto motions = motions_of(motion, time, kappa);
  const auto solve = [&](SubdomainMethod method) {
    SteadyLevel steady(method);
    FlowEquations<2> flow(steady.level().domain, steady.level().steady.model(), time);
    ForcedFlowStart start = linear_start<2>(steady.level(), time, motion, kappa);
    const auto result =
        solve_forced_flow<2>(flow, start.factors, motions, kappa, start.w, ForcedFlowOptions{});
    EXPECT_EQ(result.status, SolveStatus::converged);
    EXPECT_GT(factor_bytes(start.factors), 0.0);
    return flow.loads(start.w, motions);
  };
  const auto expected = solve(SubdomainMethod::lu), found = solve(SubdomainMethod::ilu);
  for (std::size_t n = 0; n < expected.size(); ++n) {
    EXPECT_NEAR(found[n].force_y, expected[n].force_y, 1e-8) << n;
    EXPECT_NEAR(found[n].moment, expected[n].moment, 1e-8) << n;
  }
}

// What an adjoint solve does.
TEST(IncompleteFactors, SolveTheTransposedSteadyJacobian) {
  SteadyLevel steady(SubdomainMethod::ilu);
  FlowLevel<2>& level = steady.level();
  const std::vector<double> no_shift(level.domain.volumes().size(), 0.0);
  level.solver->factor<4>(level.steady.jacobians()[0], {});
  const ShiftedJacobian<2> jacobian(level.steady, no_shift);
  const std::vector<double> rhs(level.w.size(), 1.0);
  std::vector<double> x(rhs.size()), residual(rhs.size());
  const auto result =
      gmres<double>(level.comm(), TransposedOperator<double>(jacobian),
                    TransposedOperator<double>(*level.solver), rhs, x, {.relative_tolerance = 1e-9});
  EXPECT_EQ(result.status, GmresStatus::converged);
  EXPECT_LE(result.iterations, 150);
  jacobian.apply_transpose(x, residual);
  double squares = 0.0;
  for (std::size_t i = 0; i < rhs.size(); ++i) squares += (residual[i] - rhs[i]) * (residual[i] - rhs[i]);
  EXPECT_LE(level.comm().sum(squares), 1e-18 * level.comm().sum(static_cast<double>(rhs.size())));
}

}  // namespace
}  // namespace wingbeat
