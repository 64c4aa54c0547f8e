#include <gtest/gtest.h>

#include <algorithm>

#include "test/flow/every_scheme.hpp"
#include "test/flow/kernel_checks.hpp"
#include "test/flow/kernel_states.hpp"

namespace wingbeat {
namespace {

using namespace testing;

// Calls test(scheme) for the schemes whose name passes, the scheme as the type that it is.
template <class Test>
void for_schemes(const std::vector<std::string>& names, const Test& test) {
  for (const auto& [name, scheme] : every_scheme()) {
    const std::string family = name.substr(0, name.find(','));
    if (!names.empty() && std::ranges::find(names, family) == names.end()) continue;
    SCOPED_TRACE(name);
    std::visit(test, scheme);
  }
}
template <class Test>
void for_every_scheme(const Test& test) {
  for_schemes({}, test);
}

template <int Dim>
FaceStencil<Dim, double> stencil_of(const Vec<State<Dim, double>, 4>& w) {
  FaceStencil<Dim, double> cells;
  cells.w = w;
  for (int k = 0; k < 4; ++k) cells.p[k] = pressure<Dim, double>(w[k], gamma_air);
  cells.radius = {{{1.7, 2.1}}};
  return cells;
}

// Face with the area vector's components up to 2, moving at up to half the speed of sound.
template <int Dim>
MovedFace<Dim, double> some_face(Sampler& sample) {
  MovedFace<Dim, double> face;
  face.normal = sample.vector<Dim>(2.0);
  face.sweep = sample.between(-0.6, 0.6) * std::sqrt(dot(face.normal, face.normal));
  return face;
}

template <int Dim, class SchemeType>
State<Dim, double> dissipation(const SchemeType& scheme, const FaceStencil<Dim, double>& cells,
                               const MovedFace<Dim, double>& face,
                               const UniformFlow<Dim, double>& uniform = {}) {
  return scheme.dissipation(cells, face, uniform, gamma_air);
}

// Four cells given by density, velocity and pressure.
Vec<State<2, double>, 4> line_of(const Vec<double, 4>& density, const Vec<Vec<double, 2>, 4>& u,
                                 const Vec<double, 4>& p) {
  Vec<State<2, double>, 4> w;
  for (int k = 0; k < 4; ++k) w[k] = conservative<2, double>(density[k], u[k], p[k], gamma_air);
  return w;
}

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

// What a velocity v added to gas and faces makes of a flux.
template <int Dim>
State<Dim, double> boosted(State<Dim, double> d, const Vec<double, Dim>& v) {
  double work = 0.5 * dot(v, v) * d[0];
  for (int i = 0; i < Dim; ++i) work += v[i] * d[1 + i];
  d[Dim + 1] += work;
  for (int i = 0; i < Dim; ++i) d[1 + i] += v[i] * d[0];
  return d;
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

// A jump of density, the same velocity and pressure on both sides, carried past by a face of the
// same normal speed.
struct Contact {
  Vec<double, 2> u{{{0.4, -0.7}}};
  MovedFace<2, double> face{{{{1.2, 0.9}}}, 0.4 * 1.2 - 0.7 * 0.9};
  Vec<double, 4> density{{{1.0, 1.0, 2.5, 2.5}}};
  FaceStencil<2, double> cells = stencil_of<2>(line_of(density, {{{u, u, u, u}}}, {{{1.1, 1.1, 1.1, 1.1}}}));
};

TEST(Schemes, RoeAndCuspLeaveAContactOnTheFaceAsItIs) {
  const Contact contact;
  for_schemes({"roe", "cusp"}, [&](const auto& scheme) {
    expect_close(dissipation<2>(scheme, contact.cells, contact.face), State<2, double>{});
  });
}

// Density there diffuses at the least speed of entropy waves, by the third difference alone.
TEST(MatrixScheme, DampsAContactOnTheFaceByItsFloor) {
  const Contact contact;
  MatrixScheme matrix;
  matrix.smoothing = 0.0;
  const double c = std::sqrt(gamma_air * 1.1 / 1.75), third = -3.0 * 1.5 + 1.5;
  const double mass = -1.5 * matrix.k4 * matrix.linear_floor * c * third;
  expect_close(dissipation<2>(matrix, contact.cells, contact.face), boosted<2>({{{mass}}}, contact.u));
}

// Its two split mass fluxes, rho c / 4 each way, do not know that nothing moves.
TEST(VanLeerScheme, SpreadsAContactOnTheFace) {
  const Contact contact;
  const auto states = face_states(contact.cells, Limiter::van_albada, gamma_air);
  const double area = 1.5;
  const auto d = dissipation<2>(VanLeerScheme{}, contact.cells, contact.face);
  const auto rho_c = [&](const GasState<2, double>& gas) {
    return gas.density * std::sqrt(gamma_air * gas.p / gas.density);
  };
  EXPECT_NEAR(d[0], 0.25 * area * (rho_c(states.right) - rho_c(states.left)), round_off);
  EXPECT_GT(d[0], 0.1);
}

// A contact that crosses the face takes its density with it; velocity and pressure, the same on
// both sides, remain so.
TEST(Schemes, CrossingContactsCarryDensityAlone) {
  Contact contact;
  for (double relative : {-3.0, -0.5, 0.2, 1.0, 2.5}) {
    MovedFace<2, double> face = contact.face;
    face.sweep -= relative;
    for_schemes({"jst", "matrix", "cusp", "roe"}, [&](const auto& scheme) {
      const auto d = dissipation<2>(scheme, contact.cells, face);
      expect_close(d, boosted<2>({{{d[0]}}}, contact.u));
    });
  }
}

TEST(Schemes, JstAndCuspKeepUniformTotalEnthalpy) {
  Sampler sample(9);
  for (int trial = 0; trial < 20; ++trial) {
    const double enthalpy = 4.2;
    Vec<State<2, double>, 4> w;
    for (int k = 0; k < 4; ++k) {
      const double density = sample.between(0.7, 1.4);
      const auto u = sample.vector<2>(1.2);
      w[k] = conservative<2, double>(density, u, density / 3.5 * (enthalpy - 0.5 * dot(u, u)), gamma_air);
    }
    MovedFace<2, double> face = some_face<2>(sample);
    face.sweep = 0.0;
    for_schemes({"jst", "cusp"}, [&](const auto& scheme) {
      const auto d = dissipation<2>(scheme, stencil_of<2>(w), face);
      EXPECT_NEAR(d[3], enthalpy * d[0], round_off);
    });
  }
}

TEST(Schemes, SupersonicFacesTakeTheUpwindFlux) {
  Sampler sample(10);
  for (int trial = 0; trial < 20; ++trial) {
    const auto cells = stencil_of<2>(sample.line<2>(0.1));
    for (double side : {1.0, -1.0}) {
      const MovedFace<2, double> face{{{{0.8, -0.6}}}, side * -4.5};
      for_schemes({"roe", "van leer"}, [&](const auto& scheme) {
        if constexpr (requires { scheme.limiter; }) {
          const auto states = face_states(cells, scheme.limiter, gamma_air);
          const auto& upwind = side > 0 ? states.left : states.right;
          expect_close(numerical_flux<2, double>(scheme, cells, face, gamma_air),
                       euler_flux<2>(upwind.state(gamma_air), upwind.p, face.normal, face.sweep));
        }
      });
    }
  }
}

// With the waves' speeds in place of their moduli, the product is the Jacobian's: at Roe's average
// it takes the jump of states to the jump of fluxes.
template <int Dim>
void expect_roe_average() {
  Sampler sample(11);
  for (int trial = 0; trial < 20; ++trial) {
    const auto gas = [&]() -> GasState<Dim, double> {
      return {sample.between(0.5, 2.0), sample.vector<Dim>(1.5), sample.between(0.5, 2.0)};
    };
    const auto left = gas(), right = gas();
    const auto face = some_face<Dim>(sample);
    const auto unit = unit_face(face);
    const auto mean = roe_average(left, right, gamma_air);
    const double c = std::sqrt(mean.sound_speed_squared), through = dot(mean.u, unit.normal) - unit.speed;
    const auto jump =
        absolute_jacobian<Dim, double>(mean, c, unit.normal, {through, through - c, through + c},
                                       right.state(gamma_air) - left.state(gamma_air), gamma_air);
    const auto flux = [&](const GasState<Dim, double>& side) {
      return euler_flux<Dim>(side.state(gamma_air), side.p, face.normal, face.sweep);
    };
    expect_close(unit.area * jump, flux(right) - flux(left));
  }
}

TEST(RoeAverage, TakesTheJumpOfStatesToThatOfFluxes) {
  expect_roe_average<2>();
  expect_roe_average<3>();
}

// F+ and F- follow from their sum and difference. Van Leer's conditions: one-way mass fluxes
// rho c (1 +- M)^2 / 4, all or nothing beyond sonic speed, continuous derivatives there.
TEST(VanLeerScheme, SplitsTheFluxByTheMachNumberRelativeToTheFace) {
  using D = Dual<double, 1>;
  const double c = std::sqrt(gamma_air * 0.8 / 1.3);
  const GasState<2, D> gas{1.3, {{{D(0.9), D(-0.4)}}}, 0.8};
  const auto split = [&](double mach, double sign) {
    MovedFace<2, D> face{{{{D(0.6), D(0.8)}}}, D::seed(0.9 * 0.6 - 0.4 * 0.8 - mach * c, 0)};
    const auto flux = euler_flux<2>(gas.state(gamma_air), gas.p, face.normal, face.sweep);
    return 0.5 * (flux + sign * split_flux_difference(gas, unit_face(face), gamma_air));
  };
  for (double mach : {-0.99, -0.4, 0.0, 0.3, 0.9}) {
    EXPECT_NEAR(split(mach, +1)[0].value, 1.3 * c / 4 * (1 + mach) * (1 + mach), round_off);
    EXPECT_NEAR(split(mach, -1)[0].value, -1.3 * c / 4 * (1 - mach) * (1 - mach), round_off);
  }
  for (int v = 0; v < 4; ++v) {
    EXPECT_NEAR(split(1.7, -1)[v].value, 0.0, round_off);
    EXPECT_NEAR(split(-1.7, +1)[v].value, 0.0, round_off);
    for (double sonic : {1.0, -1.0}) {
      const D inside = split(sonic * (1 - 1e-9), -sonic)[v], outside = split(sonic * (1 + 1e-9), -sonic)[v];
      EXPECT_NEAR(inside.value, outside.value, 1e-8);
      EXPECT_NEAR(inside.gradient[0], outside.gradient[0], 1e-8);
    }
  }
}

Vec<double, 1> number(double x) { return {{{x}}}; }

constexpr Limiter limiters[] = {Limiter::van_albada, Limiter::venkatakrishnan};

TEST(Limiter, KeepsLinearVariationAndSmoothDifferences) {
  for (Limiter limiter : limiters) {
    EXPECT_NEAR(limited_increment(limiter, number(0.7), number(0.7), 1e-4)[0], 0.35, round_off);
    EXPECT_EQ(limited_increment(limiter, number(0.0), number(0.0), 1e-4)[0], 0.0);
    // Differences of a hundredth of what counts as smooth: the unlimited scheme, to that squared.
    const double unlimited = limiter == Limiter::van_albada ? 0.5 * (1e-4 - 2e-4) / 2 : (1e-4 - 4e-4) / 6;
    EXPECT_NEAR(limited_increment(limiter, number(1e-4), number(-2e-4), 1e-4)[0] / unlimited, 1.0, 1e-3);
  }
}

// Venkatakrishnan's function reaches 1.094 at most.
TEST(Limiter, DoesNotReachBeyondNeighboursAcrossJumps) {
  for (Limiter limiter : limiters)
    for (double behind : {0.0, 0.05, 0.3, 1.0, 4.0, 100.0})
      for (double across : {0.0, 0.05, 0.3, 1.0, 4.0, 100.0}) {
        const double increment = limited_increment(limiter, number(behind), number(across), 1e-20)[0];
        EXPECT_GE(increment, 0.0);
        EXPECT_LE(increment, 1.095 * std::min(behind, across) + 1e-12) << behind << ' ' << across;
      }
}

}  // namespace
}  // namespace wingbeat
