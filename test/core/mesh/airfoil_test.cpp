#include "core/mesh/airfoil.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

using Point = Vec<double, 2>;

double norm(const Point& a) { return std::hypot(a[0], a[1]); }

double naca00_half_thickness(double thickness, double x) {
  return 5.0 * thickness *
         (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
}

const std::vector<std::string>& sections() {
  static const std::vector<std::string> names = {"naca0012", "naca0024", "naca2412", "naca4415",
                                                 "naca64a010"};
  return names;
}

TEST(Airfoil, Naca0012FollowsItsFormulaOnBothSurfaces) {
  const Airfoil airfoil = make_airfoil("naca0012");
  for (double t = 0.0; t <= 1.0; t += 0.01) {
    const Point upper = airfoil.at(t).position, lower = airfoil.at(-t).position;
    EXPECT_NEAR(upper[1], naca00_half_thickness(0.12, upper[0]), 1e-16);
    EXPECT_EQ(upper[0], lower[0]);
    EXPECT_EQ(upper[1], -lower[1]);
  }
  const double slope = 0.6 * (0.2969 / 2 - 0.1260 - 2 * 0.3516 + 3 * 0.2843 - 4 * 0.1036);
  EXPECT_NEAR(airfoil.trailing_edge_angle(), -2.0 * std::atan(slope), 1e-14);
  EXPECT_NEAR(airfoil.nose_radius(), 0.5 * 0.6 * 0.6 * 0.2969 * 0.2969,
              1e-5);  // differences across a jump in t
}

TEST(Airfoil, Naca4415HasItsCamberAndThickness) {
  const Airfoil airfoil = make_airfoil("naca4415");
  const double t = std::sqrt(0.4);  // at the maximum of the camber line thickness is vertical
  const Point upper = airfoil.at(t).position, lower = airfoil.at(-t).position;
  EXPECT_NEAR(upper[0], 0.4, 1e-15);
  EXPECT_NEAR(0.5 * (upper[1] + lower[1]), 0.04, 1e-15);
  EXPECT_NEAR(0.5 * (upper[1] - lower[1]), naca00_half_thickness(0.15, 0.4), 1e-15);
  // Elsewhere the two surfaces are equally far from the camber line, along its normal.
  for (const double x : {0.1, 0.7}) {
    const double height = x < 0.4 ? 0.04 / 0.16 * (0.8 * x - x * x) : 0.04 / 0.36 * (0.2 + 0.8 * x - x * x);
    const double slope = x < 0.4 ? 0.04 / 0.16 * (0.8 - 2 * x) : 0.04 / 0.36 * (0.8 - 2 * x);
    const Point up = airfoil.at(std::sqrt(x)).position - Point{{x, height}};
    const Point down = airfoil.at(-std::sqrt(x)).position - Point{{x, height}};
    EXPECT_NEAR(norm(up + down), 0.0, 1e-15);
    EXPECT_NEAR(norm(up), naca00_half_thickness(0.15, x), 1e-15);
    EXPECT_NEAR(up[0] + slope * up[1], 0.0, 1e-15);
  }
}

TEST(Airfoil, Naca64A010PassesThroughItsClosedOrdinates) {
  const Airfoil airfoil = make_airfoil("naca64a010");
  // x and y in % chord; y as tabulated, before the closure by 0.00021 x.
  for (const auto& [x, y] :
       {std::pair{0.5, 0.804}, {2.5, 1.688}, {40.0, 4.995}, {75.0, 2.623}, {95.0, 0.541}}) {
    const double t = std::sqrt(0.01 * x), expected = 0.01 * y - 0.00021 * 0.01 * x;
    EXPECT_NEAR(airfoil.at(t).position[1], expected, 1e-16);
    EXPECT_NEAR(airfoil.at(-t).position[1], -expected, 1e-16);
  }
  EXPECT_EQ(airfoil.at(1.0).position, (Point{{1.0, 0.0}}));
  EXPECT_NEAR(airfoil.at(0.0).tangent[1], std::sqrt(2.0 * 0.00687), 1e-15);
}

TEST(Airfoil, TangentIsTheDerivativeOfThePosition) {
  constexpr double step = 1e-5;
  for (const auto& name : sections()) {
    const Airfoil airfoil = make_airfoil(name);
    for (double t = -0.985; t < 1.0; t += 0.03) {
      const Point difference = (0.5 / step) * (airfoil.at(t + step).position - airfoil.at(t - step).position);
      EXPECT_NEAR(norm(difference - airfoil.at(t).tangent), 0.0, 1e-8) << name << " at t = " << t;
    }
  }
}

TEST(Airfoil, ArcParameterMeasuresTheCurve) {
  for (const auto& name : sections()) {
    const Airfoil airfoil = make_airfoil(name);
    double length = 0.0;
    constexpr int chords = 20000;  // each shorter than its arc by about h^3/(24 radius^2)
    for (int k = 0; k < chords; ++k)
      length += norm(airfoil.point((k + 1.0) / chords) - airfoil.point(static_cast<double>(k) / chords));
    EXPECT_NEAR(length, airfoil.lower_arc_length() + airfoil.upper_arc_length(), 1e-6) << name;
    EXPECT_EQ(airfoil.curve_parameter(0.5), 0.0);
    for (const double s : {0.0, 0.123, 0.499, 0.5, 0.501, 0.87, 1.0})
      EXPECT_NEAR(airfoil.arc_parameter(airfoil.curve_parameter(s)), s, 1e-14) << name;
    // Equal steps in s are equal steps along a surface.
    const double first = norm(airfoil.point(0.2001) - airfoil.point(0.2));
    const double second = norm(airfoil.point(0.3501) - airfoil.point(0.35));
    EXPECT_NEAR(first / second, 1.0, 1e-5) << name;
  }
}

TEST(Airfoil, NormalIsUnitAndPointsOut) {
  for (const auto& name : sections()) {
    const Airfoil airfoil = make_airfoil(name);
    for (double s = 0.01; s < 1.0; s += 0.02) {
      const Point normal = airfoil.outward_normal(s);
      const Point along = airfoil.point(s + 1e-6) - airfoil.point(s - 1e-6);
      EXPECT_NEAR(norm(normal), 1.0, 1e-15);
      EXPECT_NEAR(dot(normal, along) / norm(along), 0.0, 1e-4);
      EXPECT_EQ(normal[1] > 0.0, airfoil.point(s)[1] > airfoil.point(1.0 - s)[1]) << name << " at s = " << s;
    }
  }
}

TEST(Airfoil, SymmetricSectionsHaveMirrorSymmetricArcs) {
  for (const std::string name : {"naca0012", "naca64a010"}) {
    const Airfoil airfoil = make_airfoil(name);
    for (const double s : {0.04, 0.3, 0.48}) {
      EXPECT_NEAR(airfoil.point(s)[0], airfoil.point(1.0 - s)[0], 1e-14);
      EXPECT_NEAR(airfoil.outward_normal(s)[1], -airfoil.outward_normal(1.0 - s)[1], 1e-13);
    }
  }
}

TEST(Airfoil, RefusesUnknownNamesSayingWhatIsAllowed) {
  const auto message = [](const std::string& name) -> std::string {
    try {
      make_airfoil(name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(message("naca64a012").find("\"naca64a012\" is neither"), std::string::npos)
      << message("naca64a012");
  EXPECT_NE(message("no-such-file.dat").find("naca64a010"), std::string::npos);
  EXPECT_NE(message("naca0000").find("thickness"), std::string::npos) << message("naca0000");
  EXPECT_NE(message("naca2012").find("camber"), std::string::npos) << message("naca2012");
  EXPECT_NE(message("naca0412").find("camber"), std::string::npos) << message("naca0412");
}

}  // namespace
}  // namespace wingbeat
