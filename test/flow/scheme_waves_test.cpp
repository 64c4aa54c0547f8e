#include <gtest/gtest.h>

#include "test/flow/scheme_checks.hpp"

// What each scheme does to contacts, shocks and smooth flow.
namespace wingbeat {
namespace {

using namespace testing;

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

// A jump in the slower wave of (rho, rho u, rho H), small enough to be linear. Fast flow takes its
// whole flux from downstream, whence it comes, slow flow is upwinded by convection: the values of
// the two coefficients.
TEST(CuspScheme, UpwindsTheSlowWaveWhereTheFlowIsFast) {
  const double density = 1.2, p = 0.9, c = std::sqrt(gamma_air * p / density), small = 1e-5;
  const MovedFace<2, double> face{{{{1.0, 0.0}}}, 0.0};
  for (double mach : {0.8, 0.6, 0.2}) {
    const double u = mach * c, g = (gamma_air - 1.0) / gamma_air;
    const double enthalpy = c * c / (gamma_air - 1.0) + 0.5 * u * u;
    const double half = 0.5 * (gamma_air + 1.0) / gamma_air * u;
    const double wave = half - std::sqrt(0.25 * g * g * u * u + c * c / gamma_air);
    const double density_after = density + small, u_after = (density * u + wave * small) / density_after;
    const double p_after = g * density_after * (enthalpy - 0.5 * u_after * u_after);
    const Vec<double, 2> before{{{u, 0.0}}}, after{{{u_after, 0.0}}};
    const auto cells =
        stencil_of<2>(line_of({{{density, density, density_after, density_after}}},
                              {{{before, before, after, after}}}, {{{p, p, p_after, p_after}}}));
    State<2, double> jump{{{small, wave * small, 0.0, enthalpy * small}}};
    const auto flux = euler_flux<2>(cells.w[2], cells.p[2], face.normal, face.sweep) -
                      euler_flux<2>(cells.w[1], cells.p[1], face.normal, face.sweep);
    const auto d = dissipation<2>(CuspScheme{}, cells, face);
    const auto expected = mach > 0.5 ? -0.5 * flux : 0.5 * u * jump;
    for (int v = 0; v < 4; ++v) {
      EXPECT_NEAR(flux[v], wave * jump[v], 20 * small * small) << "not the wave's flux";
      EXPECT_NEAR(d[v], expected[v], 20 * small * small) << "at Mach " << mach;
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
