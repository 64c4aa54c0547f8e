#include "flow/runge_kutta.hpp"

#include <gtest/gtest.h>

#include <array>
#include <complex>

#include "flow/spectral_radius.hpp"
#include "test/flow/multigrid_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;
using Complex = std::complex<double>;

constexpr std::array<double, 5> alpha{1.0 / 4.0, 1.0 / 6.0, 3.0 / 8.0, 1.0 / 2.0, 1.0};
constexpr double beta = 0.5;

// What a step of dw/dtau = z w, without dissipation, multiplies w by.
Complex amplification(Complex z) {
  Complex g = 1.0;
  for (double a : alpha) g = 1.0 + a * z * g;
  return g;
}

// Largest |g| of dw/dtau = -i (Z + A) w held back by `limit` over spatial symbols |Z| <= reach and time
// symbols A = h kappa dtau of either sign.
template <class Limit>
double largest_amplification(double reach, const Limit& limit) {
  double largest = 0.0;
  for (double time = 1e-3; time < 1e6; time *= 1.05)
    for (double sign : {-1.0, 1.0})
      for (int k = -200; k <= 200; ++k) {
        const double a = sign * time, z = reach * k / 200.0;
        largest = std::max(largest, std::abs(amplification(-limit(a) * Complex(0.0, z + a))));
      }
  return largest;
}
Complex by_modulus(double a) { return 1.0 / std::sqrt(1.0 + beta * a * beta * a); }
Complex by_inverse(double a) { return 1.0 / Complex(1.0, beta * a); }

// |Z + A| / sqrt(1 + beta^2 A^2) is at most sqrt(Z^2 + 1/beta^2), and the stages are stable up to 4 on
// the imaginary axis: smoothed residuals (CFL 6 over 2) leave Z <= 3.
TEST(RungeKuttaSymbol, ModulusKeepsEveryHarmonicStableAtEveryStep) {
  EXPECT_LE(largest_amplification(std::sqrt(16.0 - 1.0 / (beta * beta)), by_modulus), 1.0 + 1e-12);
  EXPECT_GT(largest_amplification(3.6, by_modulus), 1.0);
  const RungeKuttaOptions options;
  EXPECT_LE(std::hypot(options.cfl / options.smoothing, 1.0 / beta), 4.0);
}

// Its inverse turns waves that run against the harmonic towards growth.
TEST(RungeKuttaSymbol, PlainInverseAmplifiesWavesAgainstTheHarmonic) {
  EXPECT_GT(largest_amplification(3.0, by_inverse), 1.02);
  EXPECT_GT(std::abs(amplification(-by_inverse(1.0) * Complex(0.0, -2.5 + 1.0))), 1.02);
}

struct BoxCase {
  Comm comm;
  MultiblockMesh<2> mesh;
  LocalMesh<2> local;
  FlowDomain<2> domain;
  FlowModel<2, double> model{{1.4, 0.6, 0.8, 0.6}, JstScheme{}};

  BoxCase(int across, int up, double bend = 0.03)
      : mesh(bent_box<2>({{across, up}}, bend)),
        local(build_local_mesh<2>(mesh, partition_mesh<2>(mesh, comm.size(), {}), comm.rank())),
        domain(comm, local, {{{0.25, 0.0}}}) {}
};

std::vector<double> noisy(const FlowEquations<2>& flow, const LocalMesh<2>& local, double size) {
  std::vector<double> w = flow.uniform_state();
  std::size_t at = 0;
  for (std::size_t i = 0; i < flow.instance_count(); ++i)
    for (long cell : local.global_cell)
      for (int v = 0; v < 4; ++v) w[at++] += size * noise(cell, v, static_cast<int>(i));
  return w;
}

// No wave reaches the middle of the box from its sides in a step of five stages, and without
// smoothing nothing else does: a cell there is the scalar model.
TEST(RungeKutta, AmplifiesHarmonicsThatAreUniformInSpaceByTheSymbol) {
  constexpr int cells = 32, reach = 11, harmonics = 2;
  BoxCase c(cells, cells, 0.0);
  const TimeSpectral time(harmonics);
  FlowEquations<2> flow(c.domain, c.model, time);
  RungeKutta<2> runge_kutta(flow);
  const std::vector<MotionState> at_rest(flow.instance_count());
  const RungeKuttaOptions options{.cfl = 3.0, .smoothing = 0.0};
  constexpr double size = 1e-7;
  for (double kappa : {1.0, 100.0, 1e4, 1e6})
    for (int h = 1; h <= harmonics; ++h) {
      auto w = flow.uniform_state();
      const std::size_t count = c.domain.state_count();
      for (std::size_t i = 0; i < w.size(); ++i)
        w[i] += size * std::cos(h * time.phase(static_cast<int>(i / count)));
      const auto start = w;
      const auto sums = spectral_radius_sums<2>(c.domain, {start.data(), count}, {}, 1.4);
      runge_kutta.step(w, at_rest, kappa, {}, options);
      const auto coefficients = time.harmonics_of(w);
      std::size_t cell = 0;
      for (const auto& block : c.local.blocks)
        for_each(block.zone_cells, [&](const Index<2>& index) {
          bool is_inner = true;
          for (int d = 0; d < 2; ++d) is_inner = is_inner && index[d] >= reach && index[d] < cells - reach;
          if (is_inner) {
            const double a = h * kappa * options.cfl / sums[cell] * c.domain.volumes()[cell];
            const Complex expected = amplification(-by_modulus(a) * Complex(0.0, a));
            const auto got = coefficients[static_cast<std::size_t>(h) * count + cell * 4] / size;
            // Round-off of density over the disturbance; the step that is the shortest of all
            // instances differs from that of the first by the disturbance itself.
            EXPECT_LE(std::abs(got - expected), 5e-6) << "kappa " << kappa << ", harmonic " << h;
          }
          ++cell;
        });
    }
}

// Any state is a fixed point of the source that it is the solution for, and of no other.
TEST(RungeKutta, FixedPointsAreSolutionsForTheSource) {
  BoxCase c(24, 16);
  for (int harmonics : {0, 2})
    for (double smoothing : {0.0, 2.0}) {
      FlowEquations<2> flow(c.domain, c.model, TimeSpectral(harmonics));
      const double kappa = harmonics > 0 ? 0.7 : 0.0;
      const auto motions = motions_of({0.01, {{0.0, -0.02}}, {}}, flow.time(), kappa);
      auto w = noisy(flow, c.local, 0.05);
      const auto start = w;
      std::vector<double> source(w.size());
      flow.residual(w, motions, kappa, source);
      RungeKutta<2> runge_kutta(flow);
      const RungeKuttaOptions options{.cfl = 3.0, .smoothing = smoothing};
      const double at_rest = c.comm.sum(runge_kutta.step(w, motions, kappa, source, options));
      EXPECT_LE(at_rest, 1e-24);
      EXPECT_LE(largest_difference(c.comm, w, start), 1e-12);

      for (double& value : source) value += 1e-3;
      const double moved = c.comm.sum(runge_kutta.step(w, motions, kappa, source, options));
      const double cells = 24.0 * 16.0 * 4.0 * static_cast<double>(flow.instance_count());
      EXPECT_NEAR(moved, 1e-6 * cells, 1e-9 * cells) << "sum of squares of R - source before the step";
      EXPECT_GE(largest_difference(c.comm, w, start), 1e-4);
    }
}

TEST(RungeKutta, LeavesUniformFlowAloneHoweverTheMeshMoves) {
  BoxCase c(24, 16);
  FlowEquations<2> flow(c.domain, c.model, TimeSpectral(1));
  constexpr double kappa = 0.7;
  const auto motions = motions_of({0.1, {{0.0, -0.3}}, {{0.2, 0.1}}}, flow.time(), kappa);
  auto w = flow.uniform_state();
  const auto start = w;
  RungeKutta<2> runge_kutta(flow);
  for (int k = 0; k < 10; ++k) runge_kutta.step(w, motions, kappa, {}, {});
  EXPECT_LE(largest_difference(c.comm, w, start), 1e-13);
}

// Each cell goes its own way: neither steps nor harmonics depend on how the mesh is cut. Smoothing
// does, by what its truncation leaves out.
TEST(RungeKutta, StepsAreTheSameOnAnyRanks) {
  const auto sums_of = [](const Comm& ranks) {
    MultigridCase c(section_mesh("naca0012", 64, 16), 0.8, 1.25, TimeSpectral(1), 0.2, 1.0, ranks);
    auto w = noisy(c.flow, c.local, 0.02);
    RungeKutta<2> runge_kutta(c.flow);
    for (int k = 0; k < 3; ++k) runge_kutta.step(w, c.motions, c.kappa, {}, {.cfl = 2.0, .smoothing = 0.0});
    std::array<double, 2> sums{};
    std::size_t at = 0;
    for (int i = 0; i < 3; ++i)
      for (long cell : c.local.global_cell)
        for (int v = 0; v < 4; ++v, ++at) {
          sums[0] += w[at] * noise(cell, v, 100 + i);
          sums[1] += w[at] * w[at];
        }
    for (double& sum : sums) sum = c.comm.sum(sum);
    return sums;
  };
  const auto alone = sums_of(Comm(MPI_COMM_SELF)), together = sums_of(Comm());
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(together[k], alone[k], 1e-11 * alone[1]);
}

}  // namespace
}  // namespace wingbeat
