#include "flow/dual_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/io/error.hpp"
#include "flow/forced_flow.hpp"
#include "flow/steady_sequence.hpp"
#include "test/flow/flow_case.hpp"
#include "test/flow/multigrid_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;
using Complex = std::complex<double>;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double kappa = 0.4;
constexpr double period = 2.0 * std::numbers::pi / kappa;

// A transonic section at rest, its steady flow solved.
struct SteadyLevel {
  FlowLevels<2> levels;
  FlowLevel<2>& level() { return *levels.back(); }

  explicit SteadyLevel(const Comm& comm = Comm()) {
    const FlowModel<2, double> model{{1.4, 0.796, 1.0, 0.0}, JstScheme{0.25, 1.0 / 64.0, 1.0}};
    FlowLevelOptions options;
    options.partition.granularity = 8;
    levels.push_back(std::make_unique<FlowLevel<2>>(comm, section_mesh("naca64a010", 64, 16), model,
                                                    Vec<double, 2>{{{0.25, 0.0}}}, options));
    PseudoTransientOptions steady;
    steady.tolerance = 1e-11;
    EXPECT_EQ(solve_steady<2>(levels, {}, steady).status, SolveStatus::converged);
  }
};

ForcedMotion pitching(double amplitude_deg) {
  return {.mean_pitch = 0.0, .pitch = {Complex(0.0, -amplitude_deg * degree)}, .plunge = {}};
}
MotionState motion_at(const ForcedMotion& motion, double phase) {
  const ForcedPosition at = position_at(motion, phase);
  return {at.pitch, kappa * at.pitch_slope, kappa * at.plunge_slope};
}

// Marches over the phases (first, last] counted in steps; calls visit(step) after each.
template <class Visit>
void march(DualTime<2>& flow, const ForcedMotion& motion, int steps_per_period, int first, int last,
           const Visit& visit) {
  for (int step = first + 1; step <= last; ++step) {
    const MotionState at = motion_at(motion, 2.0 * std::numbers::pi * step / steps_per_period);
    flow.begin(period / steps_per_period);
    const DualTimeResult result = flow.solve(at);
    EXPECT_EQ(result.status, SolveStatus::converged) << "step " << step << ", " << result.residual;
    flow.accept();
    visit(step, at, result);
  }
}

TEST(DualTime, ShiftIsInResidualJacobianAndItsTranspose) {
  FlowCase<2> c(bent_box<2>({12, 8}), 0.6, 30.0);
  FlowEquations<2> flow(c.domain, c.model, TimeSpectral(1));
  const std::vector<MotionState> motions{{0.1, 0.2, 0.0}, {0.0, -0.1, 0.1}, {-0.1, 0.0, 0.2}};
  const auto w = disturbed_state(c, flow, 0.05, 1);
  const auto x = noise_field(c, 3, 2), y = noise_field(c, 3, 3);
  constexpr double shift = 3.0;
  std::vector<double> plain(w.size()), shifted(w.size()), ax(w.size()), aty(w.size());
  flow.residual(w, motions, 0.7, plain);
  flow.residual(w, motions, {0.7, shift}, shifted);
  const std::size_t count = c.domain.state_count();
  for (std::size_t i = 0; i < w.size(); ++i)
    EXPECT_NEAR(shifted[i] - plain[i], shift * c.domain.volumes()[i % count / 4] * w[i], 1e-14);
  flow.linearize_state(w, motions, 0.7);
  flow.apply(x, plain);
  flow.linearize_state(w, motions, {0.7, shift});
  flow.apply(x, ax);
  for (std::size_t i = 0; i < w.size(); ++i)
    EXPECT_NEAR(ax[i] - plain[i], shift * c.domain.volumes()[i % count / 4] * x[i], 1e-13);
  flow.apply_transpose(y, aty);
  EXPECT_NEAR(global_dot(c.comm, ax, y), global_dot(c.comm, x, aty),
              1e-12 * global_norm(c.comm, ax) * global_norm(c.comm, y));
}

TEST(DualTime, SteadyFlowIsAFixedPoint) {
  SteadyLevel steady;
  for (bool by_cycles : {false, true})
    for (int order : {1, 3}) {
      DualTime<2> flow(steady.level(), {.order = order, .by_cycles = by_cycles});
      flow.start({steady.level().w});
      march(flow, {}, 64, 0, 6, [](int, const MotionState&, const DualTimeResult&) {});
      // What was left of the steady residual, 1e-11 of uniform flow's.
      EXPECT_LE(largest_difference(steady.level().comm(), flow.w(), steady.level().w), 1e-9);
    }
}

// The volumes that faces sweep at the new level close around each cell however the mesh moves.
TEST(DualTime, UniformFlowStaysUniformOnAPitchingAndPlungingMesh) {
  const FlowModel<2, double> model{{1.4, 0.8, 0.8, 0.6}, JstScheme{}};
  FlowLevel<2> level(Comm(), bent_box<2>({24, 16}), model, {{{0.25, 0.0}}}, {});
  const ForcedMotion motion{.mean_pitch = 0.1, .pitch = {Complex(0.0, -0.4)}, .plunge = {Complex(0.5, 0.2)}};
  for (bool by_cycles : {false, true}) {
    DualTime<2> flow(level, {.order = 3, .by_cycles = by_cycles});
    const auto uniform = level.steady.uniform_state();
    flow.start({uniform});
    march(flow, motion, 32, 0, 64, [&](int step, const MotionState&, const DualTimeResult&) {
      EXPECT_LE(largest_difference(level.comm(), flow.w(), uniform), 1e-12) << step;
    });
  }
}

struct Marched {
  std::vector<double> lift;
  std::vector<double> w;
  int factorizations = 0;
  int iterations = 0;
};

Marched march_from_rest(FlowLevel<2>& level, const DualTimeOptions& options, double amplitude_deg,
                        int steps) {
  DualTime<2> flow(level, options);
  flow.start({level.w});
  Marched marched;
  march(flow, pitching(amplitude_deg), 64, 0, steps,
        [&](int, const MotionState& at, const DualTimeResult& result) {
          marched.lift.push_back(flow.loads(at).force_y);
          marched.factorizations += result.factorizations;
          marched.iterations += result.iterations;
        });
  marched.w.assign(flow.w().begin(), flow.w().end());
  return marched;
}

// Steps solved a thousand times closer than usual agree in the digits that leaves.
TEST(DualTime, NewtonAndCyclesTakeTheSameSteps) {
  SteadyLevel steady;
  const auto newton = march_from_rest(steady.level(), {.tolerance = 1e-7}, 2.0, 8);
  const auto cycles = march_from_rest(steady.level(), {.tolerance = 1e-7, .by_cycles = true}, 2.0, 8);
  for (std::size_t k = 0; k < newton.lift.size(); ++k)
    EXPECT_NEAR(newton.lift[k], cycles.lift[k], 1e-6 * newton.lift.back());
  EXPECT_LE(largest_difference(steady.level().comm(), newton.w, cycles.w), 1e-6);
}

TEST(DualTime, KeepsFactorsFromStepToStep) {
  SteadyLevel steady;
  const auto marched = march_from_rest(steady.level(), {.order = 2}, 0.5, 24);
  EXPECT_LE(marched.factorizations, 3) << "of the first step, of the second order, and one in reserve";
  EXPECT_LE(marched.iterations, 3 * 24);
}

TEST(DualTime, IsTheSameOnAnyRanks) {
  SteadyLevel alone(Comm(MPI_COMM_SELF)), together;
  for (bool by_cycles : {false, true}) {
    const DualTimeOptions options{.tolerance = 1e-8, .by_cycles = by_cycles};
    const auto one = march_from_rest(alone.level(), options, 1.0, 5);
    const auto all = march_from_rest(together.level(), options, 1.0, 5);
    for (std::size_t k = 0; k < one.lift.size(); ++k)
      EXPECT_NEAR(all.lift[k], one.lift[k], 1e-7 * one.lift.back()) << k;
  }
}

// The levels kept are all that a step depends on.
TEST(DualTime, GoesOnFromItsHistoryAsIfNothingHadHappened) {
  SteadyLevel steady;
  for (int order : {2, 3}) {
    const DualTimeOptions options{.order = order, .tolerance = 1e-9};
    const ForcedMotion motion = pitching(1.0);
    const auto ignore = [](int, const MotionState&, const DualTimeResult&) {};
    DualTime<2> through(steady.level(), options);
    through.start({steady.level().w});
    march(through, motion, 64, 0, 6, ignore);
    const auto kept = through.history();
    EXPECT_EQ(kept.size(), static_cast<std::size_t>(order) + 1);
    march(through, motion, 64, 6, 9, ignore);
    DualTime<2> resumed(steady.level(), options);
    resumed.start(kept);
    march(resumed, motion, 64, 6, 9, ignore);
    EXPECT_LE(largest_difference(steady.level().comm(), through.w(), resumed.w()), 1e-8);
  }
}

// With what is kept over steps, too, to round-off of the factors' pivots by Newton's method, and bit for bit
// by cycles; without it, to the tolerance.
TEST(DualTime, GoesOnFromItsMemoryAsIfNothingHadHappened) {
  SteadyLevel steady;
  for (const bool by_cycles : {false, true}) {
    const DualTimeOptions options{.tolerance = 1e-3, .by_cycles = by_cycles};
    const ForcedMotion motion = pitching(1.0);
    const auto ignore = [](int, const MotionState&, const DualTimeResult&) {};
    DualTime<2> through(steady.level(), options);
    through.start({steady.level().w});
    march(through, motion, 64, 0, 6, ignore);
    const auto kept = through.history();
    const DualTimeMemory memory = through.memory();
    march(through, motion, 64, 6, 12, ignore);
    const auto difference = [&](bool with_memory) {
      DualTime<2> resumed(steady.level(), options);
      resumed.start(kept);
      if (with_memory) resumed.resume(memory);
      march(resumed, motion, 64, 6, 12, ignore);
      return largest_difference(steady.level().comm(), through.w(), resumed.w());
    };
    if (by_cycles) {
      EXPECT_EQ(difference(true), 0.0);
    } else {
      EXPECT_LE(difference(true), 1e-12);
      EXPECT_GE(difference(false), 1e-9) << "there was nothing to remember";
    }
  }
}

// A motion no gas can follow: a status, and the flow that was.
TEST(DualTime, ReportsFailureAndKeepsAFlow) {
  SteadyLevel steady;
  for (bool by_cycles : {false, true}) {
    DualTimeOptions options{.by_cycles = by_cycles};
    options.max_cycles = 40;
    DualTime<2> flow(steady.level(), options);
    flow.start({steady.level().w});
    flow.begin(period / 64);
    EXPECT_NE(flow.solve({0.0, 0.0, 50.0}).status, SolveStatus::converged);
    EXPECT_TRUE(is_physical<2>(flow.w(), 1.4));
    EXPECT_EQ(flow.solve({std::nan(""), 0.0, 0.0}).status, SolveStatus::diverged);
    EXPECT_TRUE(is_physical<2>(flow.w(), 1.4));
  }
}

TEST(DualTime, RefusesCallsOutOfTurn) {
  SteadyLevel steady;
  DualTime<2> flow(steady.level(), {});
  EXPECT_THROW(flow.begin(0.1), InternalError);
  EXPECT_THROW(flow.start({}), InternalError);
  EXPECT_THROW(flow.start({{1.0}}), InternalError);
  flow.start({steady.level().w});
  EXPECT_THROW(flow.solve({}), InternalError);
  EXPECT_THROW(flow.accept(), InternalError);
  flow.begin(0.1);
  flow.accept();
  EXPECT_THROW(flow.begin(0.2), InternalError);
}

// First harmonic of the last `steps` values, the last of which has phase 0.
Complex first_harmonic(const std::vector<double>& values, int steps) {
  Complex sum = 0.0;
  for (int k = 0; k < steps; ++k)
    sum += values[values.size() - 1 - static_cast<std::size_t>(k)] *
           std::polar(2.0 / steps, 2.0 * std::numbers::pi * k / steps);
  return sum;
}

// Marched to periodicity, a small pitch tends to the periodic solution that the time-spectral method has
// without any error in time but that of its harmonics, here of the order of the amplitude squared.
TEST(DualTime, PeriodicPitchTendsToTheTimeSpectralOneAtItsOrder) {
  constexpr double amplitude_deg = 0.01;
  SteadyLevel steady;
  FlowLevel<2>& level = steady.level();
  const ForcedMotion motion = pitching(amplitude_deg);
  const TimeSpectral time(1);
  FlowEquations<2> spectral(level.domain, level.steady.model(), time);
  ForcedFlowStart solution = linear_start<2>(level, time, motion, kappa);
  const auto motions = motions_of(motion, time, kappa);
  solve_forced_flow<2>(spectral, solution.factors, motions, kappa, solution.w, {.tolerance = 1e-12});
  std::vector<double> lifts;
  for (const auto& loads : spectral.loads(solution.w, motions)) lifts.push_back(loads.force_y);
  const Complex exact = time.harmonics_of(lifts)[1];
  const auto harmonics = time.harmonics_of(solution.w);
  const auto periodic_level = [&](double phase) {
    const std::size_t count = level.steady.state_count();
    std::vector<double> w(count);
    for (std::size_t i = 0; i < count; ++i)
      w[i] = harmonics[i].real() + (harmonics[count + i] * std::polar(1.0, phase)).real();
    return w;
  };

  for (int order : {2, 3}) {
    std::vector<double> errors;
    for (int steps : {24, 48}) {
      DualTime<2> flow(level, {.order = order, .tolerance = 1e-5});
      std::vector<std::vector<double>> history;
      for (int k = 0; k <= order; ++k) history.push_back(periodic_level(-2.0 * std::numbers::pi * k / steps));
      flow.start(history);
      std::vector<double> marched;
      march(flow, motion, steps, 0, 2 * steps, [&](int, const MotionState& at, const DualTimeResult&) {
        marched.push_back(flow.loads(at).force_y);
      });
      errors.push_back(std::abs(first_harmonic(marched, steps) - exact) / std::abs(exact));
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, 0.3) << errors[0] << " to " << errors[1];
    EXPECT_LE(errors[1], order == 2 ? 1e-2 : 1e-3);
  }
}

}  // namespace
}  // namespace wingbeat
