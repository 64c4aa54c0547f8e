#include <gtest/gtest.h>

#include "test/flow/kernel_checks.hpp"
#include "test/flow/kernel_states.hpp"

namespace wingbeat {
namespace {

using namespace testing;

const JstScheme smooth{0.25, 1.0 / 64.0, 1.0};
const JstScheme classical{0.25, 1.0 / 64.0, 0.0};

template <int Dim>
State<Dim, double> exact_flux(const State<Dim, double>& w, const Vec<double, Dim>& normal, double sweep) {
  return euler_flux<Dim, double, double>(w, pressure<Dim, double>(w, gamma_air), normal, sweep);
}

template <int Dim>
void expect_consistent() {
  Sampler sample(1);
  for (int trial = 0; trial < 20; ++trial) {
    const auto w = sample.state<Dim>();
    const auto normals = cell_normals<Dim>(sample, 5.0);
    const auto sweeps = sample.vector<Dim>(0.4);
    const auto exact = exact_flux<Dim>(w, normals[0], sweeps[0]);
    for (const auto& jst : {smooth, classical})
      expect_close(flux_of_cells<Dim, double>({{{w, w, w, w}}}, normals, sweeps, jst), exact);
    expect_close(farfield_flux<Dim, double, double>(w, w, normals[0], sweeps[0], gamma_air), exact);
  }
}

TEST(FlowKernels, FluxOfEqualStatesIsTheExactFlux) {
  expect_consistent<2>();
  expect_consistent<3>();
}

TEST(FlowKernels, PressureOfStagnantGasActsAlongTheNormalAlone) {
  const auto w = conservative<3, double>(1.3, {}, 0.8, gamma_air);
  const Vec<double, 3> normal{{{0.3, -0.5, 0.2}}};
  const State<3, double> push{{{0.0, 0.8 * 0.3, -0.8 * 0.5, 0.8 * 0.2, 0.0}}};
  expect_close(exact_flux<3>(w, normal, 0.0), push);
  expect_close(wall_flux<3, double, double>(0.8, normal, 0.0), push);
  expect_close(farfield_flux<3, double, double>(w, w, normal, 0.0, gamma_air), push);
}

template <int Dim>
void expect_rotation_invariance() {
  Sampler sample(2);
  const Rotation<Dim> turn;
  for (int trial = 0; trial < 20; ++trial) {
    const auto w = sample.line<Dim>(0.2);
    const auto normals = cell_normals<Dim>(sample, 4.0);
    const auto sweeps = sample.vector<Dim>(0.4);
    Vec<State<Dim, double>, 4> turned;
    for (int k = 0; k < 4; ++k) turned[k] = turn.of_state(w[k]);
    Vec<Vec<double, Dim>, Dim> turned_normals;
    for (int d = 0; d < Dim; ++d) turned_normals[d] = turn(normals[d]);
    const auto& n = normals[0];
    const auto& m = turned_normals[0];
    const double sweep = sweeps[0];

    expect_close(turn.of_state(exact_flux<Dim>(w[0], n, sweep)), exact_flux<Dim>(turned[0], m, sweep));
    expect_close(turn.of_state(wall_flux<Dim, double, double>(1.2, n, sweep)),
                 wall_flux<Dim, double, double>(1.2, m, sweep));
    expect_close(turn.of_state(farfield_flux<Dim, double, double>(w[0], w[1], n, sweep, gamma_air)),
                 farfield_flux<Dim, double, double>(turned[0], turned[1], m, sweep, gamma_air));
    for (const auto& jst : {smooth, classical})
      expect_close(turn.of_state(flux_of_cells<Dim, double>(w, normals, sweeps, jst)),
                   flux_of_cells<Dim, double>(turned, turned_normals, sweeps, jst));
  }
}

TEST(FlowKernels, FluxesTurnWithTheFrame) {
  expect_rotation_invariance<2>();
  expect_rotation_invariance<3>();
}

TEST(FlowKernels, PlaneFlowInSpaceGivesTheNumbersOfTheTwoDimensionalKernels) {
  Sampler sample(3);
  for (int trial = 0; trial < 20; ++trial) {
    const auto w = sample.line<2>(0.2);
    const auto normal = sample.vector<2>(1.0);
    const double sweep = sample.between(-0.3, 0.3);
    expect_close(embedded(exact_flux<2>(w[0], normal, sweep)),
                 exact_flux<3>(embedded(w[0]), embedded(normal), sweep));
    expect_close(embedded(wall_flux<2, double, double>(0.9, normal, sweep)),
                 wall_flux<3, double, double>(0.9, embedded(normal), sweep));
    expect_close(
        embedded(farfield_flux<2, double, double>(w[0], w[1], normal, sweep, gamma_air)),
        farfield_flux<3, double, double>(embedded(w[0]), embedded(w[1]), embedded(normal), sweep, gamma_air));

    FaceStencil<2, double> flat;
    FaceStencil<3, double> solid;
    for (int k = 0; k < 4; ++k) {
      flat.w[k] = w[k];
      solid.w[k] = embedded(w[k]);
      flat.p[k] = pressure<2, double>(flat.w[k], gamma_air);
      solid.p[k] = pressure<3, double>(solid.w[k], gamma_air);
    }
    flat.radius = solid.radius = Vec<double, 2>{{{1.7, 2.1}}};
    expect_close(embedded(numerical_flux<2, double>(smooth, flat, {normal, sweep}, gamma_air)),
                 numerical_flux<3, double>(smooth, solid, {embedded(normal), sweep}, gamma_air));
  }
}

TEST(FlowKernels, ScaledRadiiForgetADirectionWithoutWaves) {
  const auto plane = scaled_radii<2, double>({{{2.0, 0.3}}});
  const auto space = scaled_radii<3, double>({{{2.0, 0.3, 1e-30}}});
  EXPECT_NEAR(space[0], plane[0], round_off);
  EXPECT_NEAR(space[1], plane[1], round_off);
  EXPECT_NEAR(plane[0], 2.0 * (1.0 + std::pow(0.15, 2.0 / 3.0)), round_off);
  EXPECT_NEAR(plane[1], 0.3 * (1.0 + std::pow(1.0 / 0.15, 2.0 / 3.0)), round_off);
}

TEST(FlowKernels, PackLanesAreTheDoubleResults) {
  constexpr int count = lanes<Pack>;
  Sampler sample(4);
  std::array<Vec<State<2, double>, 4>, count> lines;
  Vec<State<2, Pack>, 4> packed;
  for (int lane = 0; lane < count; ++lane) {
    lines[lane] = sample.line<2>(0.3);
    for (int k = 0; k < 4; ++k)
      for (int v = 0; v < 4; ++v) packed[k][v][lane] = lines[lane][k][v];
  }
  const auto normals = cell_normals<2>(sample, 4.0);
  const auto sweeps = sample.vector<2>(0.3);
  Vec<Pack, 2> normal;
  for (int d = 0; d < 2; ++d) normal[d] = Pack(normals[0][d]);
  const Pack sweep(sweeps[0]);
  for (const auto& jst : {smooth, classical}) {
    const auto jst_pack = flux_of_cells<2, Pack>(packed, normals, sweeps, jst);
    for (int lane = 0; lane < count; ++lane) {
      const auto jst_double = flux_of_cells<2, double>(lines[lane], normals, sweeps, jst);
      for (int v = 0; v < 4; ++v)
        EXPECT_NEAR(jst_pack[v][lane], jst_double[v], round_off) << lane << ' ' << v;
    }
  }
  const auto euler_pack =
      euler_flux<2, Pack, Pack>(packed[0], pressure<2, Pack>(packed[0], gamma_air), normal, sweep);
  const Pack p_wall =
      wall_pressure<Pack>(pressure<2, Pack>(packed[1], gamma_air), pressure<2, Pack>(packed[2], gamma_air));
  for (int lane = 0; lane < count; ++lane) {
    const auto& w = lines[lane];
    const auto euler = exact_flux<2>(w[0], normals[0], sweeps[0]);
    for (int v = 0; v < 4; ++v) EXPECT_NEAR(euler_pack[v][lane], euler[v], round_off);
    EXPECT_NEAR(p_wall[lane],
                wall_pressure(pressure<2, double>(w[1], gamma_air), pressure<2, double>(w[2], gamma_air)),
                round_off);
  }
}

template <int Dim>
void expect_kernel_gradients() {
  Sampler sample(5);
  for (int trial = 0; trial < 4; ++trial) {
    const auto w = sample.line<Dim>(0.2);
    const auto normals = cell_normals<Dim>(sample, 4.0);
    const auto sweeps = sample.vector<Dim>(0.4);
    expect_gradients(flattened<Dim, 1>(w), [&]<class T, int N>(const Vec<T, N>& x) {
      const auto cell = cell_of<Dim>(x, 0);
      return euler_flux<Dim, T, double>(cell, pressure<Dim, T>(cell, gamma_air), normals[0], sweeps[0]);
    });
    expect_gradients(flattened<Dim, 2>(w), [&]<class T, int N>(const Vec<T, N>& x) {
      return wall_flux<Dim, T, double>(wall_pressure<T>(pressure<Dim, T>(cell_of<Dim>(x, 0), gamma_air),
                                                        pressure<Dim, T>(cell_of<Dim>(x, 1), gamma_air)),
                                       normals[0], sweeps[0]);
    });
    expect_gradients(flattened<Dim, 2>(w), [&]<class T, int N>(const Vec<T, N>& x) {
      return farfield_flux<Dim, T, double>(cell_of<Dim>(x, 0), cell_of<Dim>(x, 1), normals[0], sweeps[0],
                                           gamma_air);
    });
    // The classical switches are differentiable, too, away from their kinks.
    for (const auto& jst : {smooth, classical})
      expect_gradients(flattened<Dim, 4>(w), [&]<class T, int N>(const Vec<T, N>& x) {
        Vec<State<Dim, T>, 4> cells;
        for (int k = 0; k < 4; ++k) cells[k] = cell_of<Dim>(x, k);
        return flux_of_cells<Dim, T>(cells, normals, sweeps, jst);
      });
  }
}

TEST(FlowKernels, DualGradientsMatchCentralDifferences) {
  expect_kernel_gradients<2>();
  expect_kernel_gradients<3>();
}

// sqrt(x^2 + w^2) - w lies within w of |x|: each switch is within its width of the classical one.
TEST(JstSwitches, TendToTheClassicalOnesAsTheSmoothingFalls) {
  for (double sigma : {1e-1, 1e-3, 1e-6, 0.0}) {
    const JstScheme jst{0.25, 1.0 / 64.0, sigma};
    const double width = sigma * jst.threshold();
    double largest = 0.0;
    for (double p : {0.7, 0.95, 1.0, 1.02, 1.4}) {
      const double gap =
          std::abs(pressure_sensor(1.0, p, 1.1, jst) - pressure_sensor(1.0, p, 1.1, classical));
      EXPECT_LE(gap, width * (1.0 + 1e-9) + round_off);
      largest = std::max(largest, gap);
    }
    EXPECT_GE(largest, 0.5 * width) << "the bound is attained, or the smoothing does nothing";
    for (double e : {0.0, 0.01, 0.05, 0.2}) {
      EXPECT_LE(std::abs(rounded_max(e, 0.04, jst) - std::max(e, 0.04)), 0.5 * width + round_off);
      EXPECT_LE(std::abs(fourth_difference_coefficient(0.25 * e, jst) - std::max(0.0, jst.k4 - 0.25 * e)),
                0.5 * sigma * jst.k4 + round_off);
    }
  }
}

TEST(JstSwitches, LeaveNoFloorInSmoothFlow) {
  EXPECT_EQ(pressure_sensor(1.3, 1.3, 1.3, smooth), 0.0);
  EXPECT_EQ(rounded_max(0.0, 0.0, smooth), 0.0);
  // A second difference of h^2 gives a sensor of h^4, where the classical one gives h^2.
  const double coarse = pressure_sensor(1.0, 1.0 + 1e-3, 1.0, smooth);
  const double fine = pressure_sensor(1.0, 1.0 + 0.25e-3, 1.0, smooth);
  EXPECT_NEAR(coarse / fine, 16.0, 0.1);
}

TEST(JstDissipation, SecondAndFourthDifferencesActOnTotalEnthalpy) {
  Sampler sample(6);
  FaceStencil<2, double> cells;
  cells.w = sample.line<2>(0.2);
  for (int k = 0; k < 4; ++k) cells.p[k] = pressure<2, double>(cells.w[k], gamma_air);
  const auto d = jst_dissipation<2, double, double>(cells, {0.3, 0.02});
  for (int v = 0; v < 4; ++v) {
    double expected = 0.0;
    for (int k = 0; k < 4; ++k) {
      const double entry = cells.w[k][v] + (v == 3 ? cells.p[k] : 0.0);
      expected += (0.3 * first_difference[static_cast<std::size_t>(k)] -
                   0.02 * third_difference[static_cast<std::size_t>(k)]) *
                  entry;
    }
    EXPECT_NEAR(d[v], expected, round_off);
  }
}

TEST(Farfield, SupersonicFacesTakeBothInvariantsFromOneSide) {
  const Vec<double, 2> normal{{{0.6, 0.8}}};
  const auto fast = [&](double q, double density, double p) {
    return conservative<2, double>(density, {{{0.6 * q + 0.08, 0.8 * q - 0.06}}}, p, gamma_air);
  };
  for (double sweep : {0.0, -0.3, 0.3}) {
    for (double q : {2.4, -2.4}) {
      const auto inside = fast(q, 1.1, 1.2), outside = fast(0.9 * q, 0.9, 0.8);
      expect_close(farfield_flux<2, double, double>(inside, outside, normal, sweep, gamma_air),
                   exact_flux<2>(q > 0.0 ? inside : outside, normal, sweep));
    }
  }
  // Still gas is left behind by a face that moves faster than sound, and met by one that comes.
  const auto still = conservative<2, double>(1.2, {}, 1.0, gamma_air);
  const auto outside = conservative<2, double>(0.9, {}, 0.9, gamma_air);
  expect_close(farfield_flux<2, double, double>(still, outside, normal, -2.0, gamma_air),
               exact_flux<2>(still, normal, -2.0));
  expect_close(farfield_flux<2, double, double>(still, outside, normal, 2.0, gamma_air),
               exact_flux<2>(outside, normal, 2.0));
}

// Entropy p/rho^gamma and tangential velocity come from upwind.
TEST(Farfield, SubsonicFacesTakeEntropyAndTangentialVelocityFromUpwind) {
  const Vec<double, 2> normal{{{1.0, 0.0}}};
  const auto inside = [](double u) { return conservative<2, double>(1.2, {{{u, 0.25}}}, 1.05, gamma_air); };
  const auto outside = [](double u) { return conservative<2, double>(1.0, {{{u, -0.1}}}, 1.0, gamma_air); };
  for (double u : {0.5, -0.5}) {
    const auto flux = farfield_flux<2, double, double>(inside(u), outside(u), normal, 0.0, gamma_air);
    const double mass = flux[0], v = flux[2] / mass;
    EXPECT_NEAR(v, u > 0 ? 0.25 : -0.1, round_off);
    // The face state follows from mass, momentum and energy flux of a given entropy.
    const double enthalpy = flux[3] / mass;
    const double entropy = u > 0 ? 1.05 / std::pow(1.2, gamma_air) : 1.0;
    const double c_in = std::sqrt(gamma_air * 1.05 / 1.2), c_out = std::sqrt(gamma_air);
    const double q = u + 2.5 * (c_in - c_out), c = 0.1 * (5.0 * (c_in + c_out));
    EXPECT_NEAR(c, 0.5 * (c_in + c_out), round_off);
    const double density = std::pow(c * c / (gamma_air * entropy), 2.5);
    EXPECT_NEAR(mass, density * q, round_off);
    EXPECT_NEAR(enthalpy, c * c / 0.4 + 0.5 * (q * q + v * v), 4 * round_off);
  }
}

TEST(PowerTwoThirds, IsAccurateToRoundOff) {
  double largest = 0.0;
  for (double exponent = -40.0; exponent <= 40.0; exponent += 0.0137) {
    const double x = std::pow(10.0, exponent), root = std::cbrt(x);
    largest = std::max(largest, std::abs(power_two_thirds(x) / (root * root) - 1.0));
  }
  EXPECT_LE(largest, 8 * std::numeric_limits<double>::epsilon());
  EXPECT_EQ(power_two_thirds(1.0), 1.0);
}

}  // namespace
}  // namespace wingbeat
