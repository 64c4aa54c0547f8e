#include <gtest/gtest.h>

#include "test/flow/scheme_checks.hpp"

namespace wingbeat {
namespace {

using namespace testing;

template <int Dim>
void expect_consistent() {
  Sampler sample(1);
  for (int trial = 0; trial < 20; ++trial) {
    const auto w = sample.state<Dim>();
    const auto cells = stencil_of<Dim>({{{w, w, w, w}}});
    const auto face = some_face<Dim>(sample);
    const auto exact = euler_flux<Dim>(w, cells.p[0], face.normal, face.sweep);
    for_every_scheme([&](const auto& scheme) {
      expect_close(dissipation<Dim>(scheme, cells, face), State<Dim, double>{});
      expect_close(numerical_flux<Dim, double>(scheme, cells, face, gamma_air), exact);
    });
  }
}

TEST(Schemes, FluxOfEqualStatesIsTheExactFlux) {
  expect_consistent<2>();
  expect_consistent<3>();
}

TEST(Schemes, DissipationDoesNotKnowTheUniformFlowOfExcessFluxes) {
  Sampler sample(2);
  for (int trial = 0; trial < 10; ++trial) {
    const auto cells = stencil_of<2>(sample.line<2>(0.2));
    const auto face = some_face<2>(sample);
    const UniformFlow<2, double> uniform = Freestream<2, double>{gamma_air, 0.8, 0.9, 0.4}.flow();
    for_every_scheme([&](const auto& scheme) {
      expect_close(dissipation<2>(scheme, cells, face, uniform), dissipation<2>(scheme, cells, face));
    });
  }
}

template <int Dim>
void expect_conservation() {
  Sampler sample(3);
  for (int trial = 0; trial < 20; ++trial) {
    const auto w = sample.line<Dim>(0.3);
    const auto face = some_face<Dim>(sample);
    const auto cells = stencil_of<Dim>(w);
    auto mirrored = stencil_of<Dim>({{{w[3], w[2], w[1], w[0]}}});
    std::swap(mirrored.radius[0], mirrored.radius[1]);
    for_every_scheme([&](const auto& scheme) {
      expect_close(-dissipation<Dim>(scheme, mirrored, {-face.normal, -face.sweep}),
                   dissipation<Dim>(scheme, cells, face));
    });
  }
}

TEST(Schemes, FluxSeenFromTheOtherSideIsTheSame) {
  expect_conservation<2>();
  expect_conservation<3>();
}

template <int Dim>
void expect_rotation_invariance() {
  Sampler sample(4);
  const Rotation<Dim> turn;
  for (int trial = 0; trial < 20; ++trial) {
    const auto w = sample.line<Dim>(0.3);
    const auto face = some_face<Dim>(sample);
    Vec<State<Dim, double>, 4> turned;
    for (int k = 0; k < 4; ++k) turned[k] = turn.of_state(w[k]);
    for_every_scheme([&](const auto& scheme) {
      expect_close(turn.of_state(dissipation<Dim>(scheme, stencil_of<Dim>(w), face)),
                   dissipation<Dim>(scheme, stencil_of<Dim>(turned), {turn(face.normal), face.sweep}));
    });
  }
}

TEST(Schemes, FluxesTurnWithTheFrame) {
  expect_rotation_invariance<2>();
  expect_rotation_invariance<3>();
}

template <int Dim>
void expect_galilean_invariance() {
  Sampler sample(5);
  for (int trial = 0; trial < 20; ++trial) {
    const auto w = sample.line<Dim>(0.3);
    const auto face = some_face<Dim>(sample);
    const auto v = sample.vector<Dim>(2.0);
    Vec<State<Dim, double>, 4> moving;
    for (int k = 0; k < 4; ++k) moving[k] = boosted<Dim>(w[k], v);
    for_every_scheme([&](const auto& scheme) {
      expect_close(
          dissipation<Dim>(scheme, stencil_of<Dim>(moving), {face.normal, face.sweep + dot(v, face.normal)}),
          boosted<Dim>(dissipation<Dim>(scheme, stencil_of<Dim>(w), face), v));
    });
  }
}

TEST(Schemes, MovingObserversSeeTheSameDissipation) {
  expect_galilean_invariance<2>();
  expect_galilean_invariance<3>();
}

TEST(Schemes, PlaneFlowInSpaceGivesTheNumbersOfTheTwoDimensionalKernels) {
  Sampler sample(6);
  for (int trial = 0; trial < 20; ++trial) {
    const auto w = sample.line<2>(0.3);
    const auto face = some_face<2>(sample);
    Vec<State<3, double>, 4> solid;
    for (int k = 0; k < 4; ++k) solid[k] = embedded(w[k]);
    for_every_scheme([&](const auto& scheme) {
      expect_close(embedded(dissipation<2>(scheme, stencil_of<2>(w), face)),
                   dissipation<3>(scheme, stencil_of<3>(solid), {embedded(face.normal), face.sweep}));
    });
  }
}

TEST(Schemes, PackLanesAreTheDoubleResults) {
  constexpr int count = lanes<Pack>;
  Sampler sample(7);
  std::array<FaceStencil<2, double>, count> cells;
  std::array<MovedFace<2, double>, count> faces;
  FaceStencil<2, Pack> packed;
  MovedFace<2, Pack> packed_face;
  for (std::size_t lane = 0; lane < count; ++lane) {
    cells[lane] = stencil_of<2>(sample.line<2>(0.3));
    faces[lane] = some_face<2>(sample);
    for (int k = 0; k < 4; ++k) {
      for (int v = 0; v < 4; ++v) packed.w[k][v][lane] = cells[lane].w[k][v];
      packed.p[k][lane] = cells[lane].p[k];
    }
    for (int k = 0; k < 2; ++k) packed.radius[k][lane] = cells[lane].radius[k];
    for (int d = 0; d < 2; ++d) packed_face.normal[d][lane] = faces[lane].normal[d];
    packed_face.sweep[lane] = faces[lane].sweep;
  }
  for_every_scheme([&](const auto& scheme) {
    const auto d = scheme.dissipation(packed, packed_face, UniformFlow<2, Pack>{}, gamma_air);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto expected = dissipation<2>(scheme, cells[lane], faces[lane]);
      for (int v = 0; v < 4; ++v) EXPECT_NEAR(d[v][lane], expected[v], round_off) << lane << ' ' << v;
    }
  });
}

template <int Dim>
void expect_scheme_gradients() {
  Sampler sample(8);
  for (int trial = 0; trial < 4; ++trial) {
    const auto w = sample.line<Dim>(0.2);
    const auto normals = cell_normals<Dim>(sample, 2.0);
    const auto sweeps = sample.vector<Dim>(0.4);
    for_every_scheme([&](const auto& scheme) {
      expect_gradients(flattened<Dim, 4>(w), [&]<class T, int N>(const Vec<T, N>& x) {
        Vec<State<Dim, T>, 4> cells;
        for (int k = 0; k < 4; ++k) cells[k] = cell_of<Dim>(x, k);
        return flux_of_cells<Dim, T>(cells, normals, sweeps, scheme);
      });
    });
  }
}

TEST(Schemes, DualGradientsMatchCentralDifferences) {
  expect_scheme_gradients<2>();
  expect_scheme_gradients<3>();
}

// d with its gradients with respect to all four cells.
template <class SchemeType>
State<2, Dual<double, 16>> differentiated(const SchemeType& scheme, const Vec<State<2, double>, 4>& w,
                                          const MovedFace<2, double>& face) {
  using D = Dual<double, 16>;
  FaceStencil<2, D> cells;
  for (int k = 0; k < 4; ++k) {
    for (int v = 0; v < 4; ++v) cells.w[k][v] = D::seed(w[k][v], 4 * k + v);
    cells.p[k] = pressure<2, D>(cells.w[k], gamma_air);
  }
  cells.radius = {{{D(1.7), D(2.1)}}};
  MovedFace<2, D> dual_face;
  for (int d = 0; d < 2; ++d) dual_face.normal[d] = D(face.normal[d]);
  dual_face.sweep = D(face.sweep);
  return scheme.dissipation(cells, dual_face, UniformFlow<2, D>{}, gamma_air);
}

// At rest, at sonic speed and where neighbours are equal, moduli and limiters have their kinks and
// their divisions by zero: the derivative must be one of those beside, and so bounded.
TEST(Schemes, GradientsAreBoundedAtStagnationAtSonicSpeedAndInUniformFlow) {
  const MovedFace<2, double> face{{{{0.8, 0.6}}}, 0.0};
  const double c = std::sqrt(gamma_air);
  for (double normal_speed : {0.0, c, -c, 0.3}) {
    const Vec<double, 2> u{{{0.8 * normal_speed, 0.6 * normal_speed}}};
    for (const Vec<double, 4>& density :
         {Vec<double, 4>{{{1.0, 1.0, 1.0, 1.0}}}, Vec<double, 4>{{{1.0, 1.0, 1.5, 1.5}}}}) {
      const auto w = line_of(density, {{{u, u, u, u}}}, {{{1.0, 1.0, 1.0, 1.0}}});
      for_every_scheme([&](const auto& scheme) {
        const auto d = differentiated(scheme, w, face);
        for (int row = 0; row < 4; ++row)
          for (int i = 0; i < 16; ++i) EXPECT_LE(std::abs(d[row].gradient[i]), 20.0) << row << ' ' << i;
      });
    }
  }
}

TEST(Schemes, GasAtRestStaysAtRest) {
  const auto cells = stencil_of<2>(line_of({{{1.2, 1.2, 1.2, 1.2}}}, {}, {{{0.9, 0.9, 0.9, 0.9}}}));
  const MovedFace<2, double> face{{{{0.8, 0.6}}}, 0.0};
  for_every_scheme([&](const auto& scheme) {
    const auto flux = numerical_flux<2, double>(scheme, cells, face, gamma_air);
    expect_close(flux, State<2, double>{{{0.0, 0.8 * 0.9, 0.6 * 0.9, 0.0}}});
  });
}

}  // namespace
}  // namespace wingbeat
