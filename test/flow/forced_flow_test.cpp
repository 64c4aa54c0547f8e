#include "flow/forced_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flow/forced_flow_problem.hpp"
#include "flow/frequency_response.hpp"
#include "flow/steady_sequence.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;
using Complex = std::complex<double>;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double kappa = 0.4;

// A transonic section at rest, its steady flow solved.
struct SteadyLevel {
  FlowLevels<2> levels;
  FlowLevel<2>& level() { return *levels.back(); }

  explicit SteadyLevel(const Comm& comm = Comm()) {
    const FlowModel<2, double> model{{1.4, 0.796, 1.0, 0.0}, JstScheme{0.25, 1.0 / 64.0, 1.0}};
    levels.push_back(std::make_unique<FlowLevel<2>>(comm, section_mesh("naca64a010", 64, 16), model,
                                                    Vec<double, 2>{{{0.25, 0.0}}}, FlowLevelOptions{}));
    PseudoTransientOptions options;
    options.tolerance = 1e-11;
    EXPECT_EQ(solve_steady<2>(levels, {}, options).status, SolveStatus::converged);
  }
};

ForcedMotion pitching(double amplitude_deg) {
  return {.mean_pitch = 0.0, .pitch = {Complex(0.0, -amplitude_deg * degree)}, .plunge = {}};
}

struct Solution {
  ForcedFlowResult result;
  std::vector<double> w;
  std::vector<Complex> loads;  // harmonics [h] of (force_x, force_y, moment)
};

Solution solve(FlowLevel<2>& level, int harmonics, const ForcedMotion& motion, bool from_linear = true) {
  const TimeSpectral time(harmonics);
  FlowEquations<2> flow(level.domain, level.steady.model(), time);
  ForcedFlowStart start =
      from_linear ? linear_start<2>(level, time, motion, kappa) : steady_start<2>(level, time);
  const auto motions = motions_of(motion, time, kappa);
  Solution solution;
  solution.result = solve_forced_flow<2>(flow, start.factors, motions, kappa, start.w, ForcedFlowOptions{});
  std::vector<double> f;
  for (const Loads<double>& loads : flow.loads(start.w, motions))
    f.insert(f.end(), {loads.force_x, loads.force_y, loads.moment});
  solution.loads = time.harmonics_of(f);
  solution.w = std::move(start.w);
  return solution;
}

TEST(ForcedFlow, ConvergesToTheSameSolutionFromEitherStart) {
  SteadyLevel steady;
  const ForcedMotion motion = pitching(1.0);
  const auto linear = solve(steady.level(), 2, motion), rest = solve(steady.level(), 2, motion, false);
  for (const Solution* solution : {&linear, &rest}) {
    EXPECT_EQ(solution->result.status, SolveStatus::converged);
    EXPECT_LE(solution->result.residual, 1e-10);
    EXPECT_LE(solution->result.iterations, 10);
  }
  for (std::size_t i = 0; i < linear.loads.size(); ++i)
    EXPECT_LE(std::abs(linear.loads[i] - rest.loads[i]), 1e-8);
}

// The reported residual is that of the equations themselves, taken anew.
TEST(ForcedFlow, SolvesTheTimeSpectralEquations) {
  SteadyLevel steady;
  const ForcedMotion motion = pitching(1.0);
  const Solution solution = solve(steady.level(), 1, motion);
  FlowEquations<2> flow(steady.level().domain, steady.level().steady.model(), TimeSpectral(1));
  std::vector<double> r(flow.state_count());
  flow.residual(solution.w, motions_of(motion, flow.time(), kappa), kappa, r);
  EXPECT_LE(global_norm(steady.level().comm(), r), 1.0001e-10 * flow.uniform_residual());
}

// Half a period later the flow is its own mirror image: lift has odd harmonics only, drag even ones. Five
// instances add the fifth of lift to its mean, the third to its second and the fourth of drag to its first.
TEST(ForcedFlow, SymmetricMotionOfASymmetricSectionHasOddLiftAndEvenDrag) {
  SteadyLevel steady;
  const auto loads = solve(steady.level(), 2, pitching(1.0)).loads;
  const auto size = [&](std::size_t harmonic, std::size_t load) {
    return std::abs(loads[3 * harmonic + load]);
  };
  constexpr std::size_t drag = 0, lift = 1;
  EXPECT_LE(size(0, lift), 1e-4 * size(1, lift));
  EXPECT_LE(size(2, lift), 1e-2 * size(1, lift));
  EXPECT_LE(size(1, drag), 0.2 * size(2, drag));
}

TEST(ForcedFlow, IsTheSameOnAnyRanks) {
  SteadyLevel alone(Comm(MPI_COMM_SELF)), together;
  const ForcedMotion motion = pitching(1.0);
  const auto one = solve(alone.level(), 1, motion), all = solve(together.level(), 1, motion);
  EXPECT_EQ(all.result.status, SolveStatus::converged);
  for (std::size_t i = 0; i < one.loads.size(); ++i)
    EXPECT_LE(std::abs(one.loads[i] - all.loads[i]), 1e-8) << i;
}

// The quadratic part of the loads falls with the square of the amplitude.
TEST(ForcedFlow, LoadsTendToTheLinearResponseWithTheSquareOfTheAmplitude) {
  SteadyLevel steady;
  FlowLevel<2>& level = steady.level();
  const auto relative_difference = [&](double amplitude_deg) {
    const ForcedMotion motion = pitching(amplitude_deg);
    const auto loads = solve(level, 1, motion).loads;
    const MotionState rest;
    level.steady.linearize(level.w, {&rest, 1}, 0.0);
    FrequencyResponse<2> response(level.steady, unfactored(level.comm(), level.subdomain, 4, 1).harmonics[0],
                                  1e-11);
    const auto linear = response.at(kappa).loads.pitch;
    return std::abs(loads[4] / motion.pitch_harmonic(1) - linear[0]);
  };
  const double coarse = relative_difference(0.2), fine = relative_difference(0.1);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

// The start's own residual is of second order in the motion.
TEST(ForcedFlow, LinearStartIsCloserToTheSolutionThanTheSteadyOne) {
  SteadyLevel steady;
  const auto first_residual = [&](double amplitude_deg, bool from_linear) {
    const ForcedMotion motion = pitching(amplitude_deg);
    const TimeSpectral time(1);
    FlowEquations<2> flow(steady.level().domain, steady.level().steady.model(), time);
    ForcedFlowStart start = from_linear ? linear_start<2>(steady.level(), time, motion, kappa)
                                        : steady_start<2>(steady.level(), time);
    double residual = 0.0;
    solve_forced_flow<2>(flow, start.factors, motions_of(motion, time, kappa), kappa, start.w,
                         ForcedFlowOptions{}, [&](const ForcedFlowIteration& i) {
                           residual = i.residual;
                           return false;
                         });
    return residual;
  };
  EXPECT_LE(first_residual(0.1, true), 0.05 * first_residual(0.1, false));
}

}  // namespace
}  // namespace wingbeat
