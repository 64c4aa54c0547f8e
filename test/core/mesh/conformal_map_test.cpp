#include "core/mesh/conformal_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/io/error.hpp"
#include "core/mesh/airfoil_file.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

Vec<double, 2> vec(Complex z) { return {{z.real(), z.imag()}}; }

// Karman-Trefftz section: image of a circle through zeta = 1 about `centre`. Its own map to the
// circle is known, by formulas that share nothing with the iteration.
struct KarmanTrefftzSection {
  Complex centre;
  double power;
  double stretch = 0.0, shift = 0.0;  // to unit chord

  double radius() const { return std::abs(1.0 - centre); }
  Complex raw(Complex zeta) const {
    const Complex plus = std::pow((zeta + 1.0) / (zeta - 1.0), power);
    return power * (plus + 1.0) / (plus - 1.0);
  }
  // z on the circle of relative radius r, `angle` clockwise from the trailing edge.
  Complex at(double r, double angle) const {
    const Complex zeta = centre + r * (1.0 - centre) * std::polar(1.0, -angle);
    const Complex z = std::abs(zeta - 1.0) < 1e-14 ? Complex(power) : raw(zeta);
    return stretch * (z - shift);
  }

  KarmanTrefftzSection(Complex c, double n) : centre(c), power(n) {
    double nose = 0.0;
    for (int k = 1; k < 4000; ++k)
      nose = std::min(nose, raw(c + (1.0 - c) * std::polar(1.0, -2 * pi * k / 4000)).real());
    shift = nose;
    stretch = 1.0 / (power - nose);
  }

  Airfoil airfoil() const {
    const auto self = *this;
    return {"Karman-Trefftz", [self](double t) {
              // Off the edge itself, where dz/dt is the limit of 0/0.
              const double inside = std::clamp(t, -1.0 + 1e-12, 1.0 - 1e-12);
              const double angle = 2.0 * std::acos(-inside);
              const double step = 1e-4 * std::sin(0.5 * angle);
              const Complex slope = (self.at(1.0, angle + step) - self.at(1.0, angle - step)) / (2.0 * step);
              return SectionPoint{vec(self.at(1.0, 2.0 * std::acos(-t))),
                                  (2.0 / std::sin(0.5 * angle)) * vec(slope)};
            }};
  }
};

TEST(ConformalMap, FindsTheExactMapOfKarmanTrefftzSections) {
  struct Shape {
    double power;
    Complex centre;
  };
  // Cusped and wedged, symmetric and cambered, thin and thick.
  for (const auto& [power, centre] : {Shape{2.0, {-0.1, 0.0}}, Shape{2.0, {-0.08, 0.07}},
                                      Shape{1.94, {-0.1, 0.0}}, Shape{1.85, {-0.2, 0.1}}}) {
    const KarmanTrefftzSection section(centre, power);
    const ConformalMap map(section.airfoil(), 64);
    EXPECT_NEAR(map.conformal_radius(), section.stretch * section.radius(), 2e-8);
    std::vector<Complex> z(64);
    for (const double r : {1.02, 1.5, 10.0}) {
      map.ring(r, z);
      for (int k = 0; k < 64; ++k)
        EXPECT_NEAR(std::abs(z[k] - section.at(r, 2.0 * pi * k / 64)), 0.0, 2e-7 * r)
            << "centre " << centre << ", power " << power << ", r " << r << ", k " << k;
    }
  }
}

TEST(ConformalMap, TakesACuspFromAFileOfOrdinates) {
  const KarmanTrefftzSection section(Complex(-0.09, 0.05), 2.0);
  for (const int count : {40, 80, 160}) {
    std::ostringstream text;
    text.precision(12);
    for (int k = count; k >= 0; --k) {
      const Complex z = section.at(1.0, 2.0 * pi * k / count);
      text << z.real() << ' ' << z.imag() << '\n';
    }
    std::istringstream input(text.str());
    const Airfoil airfoil = read_airfoil(input, "joukowski.dat");
    // A cusp y ~ (1 - x)^1.5 is no cubic: its angle is of first order in the spacing.
    EXPECT_NEAR(airfoil.trailing_edge_angle(), 0.0, 1.0 / count);
    EXPECT_NEAR(ConformalMap(airfoil, 128).conformal_radius(), section.stretch * section.radius(),
                1.0 / (count * count));
  }
}

TEST(ConformalMap, WallOfTheSeriesIsTheSection) {
  for (const std::string name : {"naca0012", "naca0024", "naca2412", "naca4415", "naca64a010"}) {
    const Airfoil airfoil = make_airfoil(name);
    const ConformalMap map(airfoil, 250);
    std::vector<Complex> z(250);
    map.ring(1.0, z);
    EXPECT_LE(map.last_correction(), 1e-12);
    EXPECT_LE(map.iterations(), 20) << name;
    for (int k = 0; k < 250; ++k) {
      const auto p = airfoil.at(map.wall_parameters()[k]).position;
      EXPECT_NEAR(std::abs(z[k] - Complex(p[0], p[1])), 0.0, 1e-11) << name << " at point " << k;
    }
  }
}

TEST(ConformalMap, DoesNotDependOnThePointsAskedFor) {
  const Airfoil airfoil = make_airfoil("naca4415");
  const ConformalMap few(airfoil, 17), many(airfoil, 17 * 61);
  EXPECT_NEAR(few.conformal_radius(), many.conformal_radius(), 1e-10);
  std::vector<Complex> a(17), b(17 * 61);
  few.ring(1.3, a);
  many.ring(1.3, b);
  for (int k = 0; k < 17; ++k) EXPECT_NEAR(std::abs(a[k] - b[61 * k]), 0.0, 1e-9);
}

TEST(ConformalMap, RefusesASectionThatFolds) {
  // A thin, strongly cambered arc with a bulge at its end, far from any near circle.
  std::ostringstream text;
  const auto camber = [](double x) { return 1.5 * x * (1.0 - x); };
  const auto half = [](double x) {
    return 0.01 * std::sqrt(x) * (1.0 - x) + 0.2 * std::exp(-800.0 * (x - 0.8) * (x - 0.8));
  };
  for (int k = 80; k > 0; --k)
    text << std::pow(k / 80.0, 2) << ' ' << camber(std::pow(k / 80.0, 2)) + half(std::pow(k / 80.0, 2))
         << '\n';
  text << "0 0\n";
  for (int k = 1; k <= 80; ++k)
    text << std::pow(k / 80.0, 2) << ' ' << camber(std::pow(k / 80.0, 2)) - half(std::pow(k / 80.0, 2))
         << '\n';
  std::istringstream input(text.str());
  const Airfoil airfoil = read_airfoil(input, "bulge.dat");
  try {
    const ConformalMap map(airfoil, 64);
    FAIL() << "mapped in " << map.iterations() << " iterations";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bulge.dat"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wingbeat
