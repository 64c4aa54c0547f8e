#include <gtest/gtest.h>

#include <array>
#include <complex>

#include "flow/runge_kutta.hpp"
#include "flow/spectral_radius.hpp"
#include "test/flow/multigrid_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;
using Complex = std::complex<double>;

struct Stage {
  double alpha;
  double renewed;
};
constexpr std::array<Stage, 5> stages{
    {{1.0 / 4.0, 1.0}, {1.0 / 6.0, 0.0}, {3.0 / 8.0, 0.56}, {1.0 / 2.0, 0.0}, {1.0, 0.44}}};

// What a step multiplies an error of symbol i Z + D by (eq:dual-time-stage): `shift` times dtau on its
// diagonal, changes smoothed by S.
double gain(double z, double dissipation, double shift, double smoothed) {
  Complex g = 1.0, d = 0.0;
  for (const Stage& stage : stages) {
    d = stage.renewed * dissipation * g + (1.0 - stage.renewed) * d;
    g = 1.0 - smoothed * stage.alpha / (1.0 + stage.alpha * shift) * (Complex(0.0, z) * g + d + shift);
  }
  return std::abs(g);
}

// Of a wave with the angle `theta` a cell, with fourth differences for dissipation.
double gain_of_wave(double theta, double shift, const RungeKuttaOptions& options, bool is_faded) {
  const double ratio = is_faded ? std::max(1.0, options.smoothing / (1.0 + shift)) : options.smoothing;
  const double share = ratio / options.smoothing, cfl = share * options.cfl;
  const double smoothed = 1.0 / (1.0 + 0.5 * (ratio * ratio - 1.0) * (1.0 - std::cos(theta)));
  const double dissipation = cfl * 16.0 / 32.0 * std::pow(std::sin(0.5 * theta), 4);
  return gain(cfl * std::sin(theta), dissipation, share * shift, smoothed);
}

template <class Visit>
void for_each_shift(const Visit& visit) {
  visit(0.0);
  for (double shift = 1e-3; shift < 1e6; shift *= 1.3) visit(shift);
}

// Where smoothing leaves S Z within the limit of the stages, no shift leads out of it.
TEST(RungeKuttaSymbol, NoShiftTakesStabilityAway) {
  double largest = 0.0, beyond = 0.0;
  for (double smoothed = 0.05; smoothed <= 1.0001; smoothed += 0.05)
    for_each_shift([&](double shift) {
      for (int k = 0; k <= 100; ++k)
        largest = std::max(largest, gain(0.04 * k / smoothed, 0.0, shift, smoothed));
      beyond = std::max(beyond, gain(4.1 / smoothed, 0.0, shift, smoothed));
    });
  EXPECT_LE(largest, 1.0 + 1e-12);
  EXPECT_GT(beyond, 1.1);
}

// Rough errors, which multigrid leaves to the stages: faded smoothing damps them at every shift as it
// does without, smoothing kept as it was would not.
TEST(RungeKuttaSymbol, FadedSmoothingDampsRoughErrorsAtEveryShift) {
  const RungeKuttaOptions options;
  const auto largest = [&](double shift, bool is_faded) {
    double result = 0.0;
    for (int k = 90; k <= 180; ++k)
      result = std::max(result, gain_of_wave(k * std::numbers::pi / 180.0, shift, options, is_faded));
    return result;
  };
  const double unshifted = largest(0.0, true);
  EXPECT_LE(unshifted, 0.72);
  for_each_shift([&](double shift) { EXPECT_LE(largest(shift, true), unshifted + 1e-12) << shift; });
  EXPECT_GE(largest(1e5, false), 0.74);
}

// Errors that are uniform in space feel the shift alone: a step divides them by 1 + shift dtau, in the
// middle of a box that no wave from its sides reaches in five stages.
TEST(RungeKutta, DividesUniformErrorsByTheShift) {
  constexpr int cells = 32, reach = 11;
  constexpr double size = 1e-7;
  const Comm comm;
  const auto mesh = bent_box<2>({{cells, cells}}, 0.0);
  const auto local = build_local_mesh<2>(mesh, partition_mesh<2>(mesh, comm.size(), {}), comm.rank());
  const FlowDomain<2> domain(comm, local, {{{0.25, 0.0}}});
  FlowEquations<2> flow(domain, {{1.4, 0.6, 0.8, 0.6}, JstScheme{}}, TimeSpectral(0));
  RungeKutta<2> runge_kutta(flow);
  const MotionState at_rest;
  const RungeKuttaOptions options{.cfl = 3.0, .smoothing = 0.0};
  const auto solution = flow.uniform_state();
  const auto sums = spectral_radius_sums<2>(domain, solution, {}, 1.4);
  for (double shift : {0.1, 10.0, 1e3, 1e6}) {
    std::vector<double> source(solution.size()), w = solution;
    flow.residual(solution, {&at_rest, 1}, {0.0, shift}, source);
    for (double& value : w) value += size;
    runge_kutta.step(w, {&at_rest, 1}, {0.0, shift}, source, options);
    std::size_t cell = 0;
    for (const auto& block : local.blocks)
      for_each(block.zone_cells, [&](const Index<2>& index) {
        bool is_inner = true;
        for (int d = 0; d < 2; ++d) is_inner = is_inner && index[d] >= reach && index[d] < cells - reach;
        // Steps are those at the disturbed state.
        const double expected = 1.0 / (1.0 + shift * options.cfl / sums[cell] * domain.volumes()[cell]);
        if (is_inner) {
          EXPECT_NEAR((w[4 * cell] - solution[4 * cell]) / size, expected, 5e-6) << shift;
        }
        ++cell;
      });
  }
}

// Where the shift outweighs the fluxes a step leaves 1 - S of an error. Faded out, S is 1 in square cells
// and, with the scaled radii of long ones, at least 0.81 in each direction.
TEST(RungeKutta, RemovesRoughErrorsWhereTheShiftIsLarge) {
  FlowCase<2> c(bent_box<2>({24, 16}), 0.6, 30.0);
  FlowEquations<2> flow(c.domain, c.model, TimeSpectral(0));
  const MotionState at_rest;
  const TimeTerm term(0.0, 1e6);
  const auto solution = flow.uniform_state();
  auto w = disturbed_state(c, flow, 0.01, 5);
  std::vector<double> source(w.size());
  flow.residual(solution, {&at_rest, 1}, term, source);
  RungeKutta<2> runge_kutta(flow);
  runge_kutta.step(w, {&at_rest, 1}, term, source, {});
  EXPECT_LE(largest_difference(c.comm, w, solution), (1.0 - 0.81 * 0.81) * 0.01);
}

TEST(RungeKutta, FixedPointsWithAShiftAreSolutionsForTheSource) {
  FlowCase<2> c(bent_box<2>({24, 16}), 0.6, 30.0);
  FlowEquations<2> flow(c.domain, c.model, TimeSpectral(0));
  const MotionState motion{0.05, 0.1, -0.1};
  const TimeTerm term(0.0, 7.0);
  auto w = disturbed_state(c, flow, 0.05, 3);
  const auto start = w;
  std::vector<double> source(w.size());
  flow.residual(w, {&motion, 1}, term, source);
  RungeKutta<2> runge_kutta(flow);
  EXPECT_LE(c.comm.sum(runge_kutta.step(w, {&motion, 1}, term, source, {})), 1e-24);
  EXPECT_LE(largest_difference(c.comm, w, start), 1e-12);
  for (double& value : source) value += 1e-3;
  const double moved = c.comm.sum(runge_kutta.step(w, {&motion, 1}, term, source, {}));
  EXPECT_NEAR(moved, 1e-6 * 24 * 16 * 4, 1e-9 * 24 * 16 * 4);
  EXPECT_GE(largest_difference(c.comm, w, start), 1e-5);
}

}  // namespace
}  // namespace wingbeat
