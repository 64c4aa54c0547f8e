#include "optimize/section_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "adjoint/hicks_henne.hpp"
#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "test/adjoint/section_meshes.hpp"

namespace wingbeat {
namespace {

using Point = Vec<double, 2>;
using Points = std::vector<Point>;
using Member = SectionMeasure SectionMeasures::*;

struct Named {
  const char* name;
  Member member;
  double degree;  // of homogeneity
};
constexpr Named all_measures[] = {{"area", &SectionMeasures::area, 2.0},
                                  {"thickness", &SectionMeasures::thickness, 1.0},
                                  {"radius", &SectionMeasures::leading_edge_radius, 1.0}};

Points still(const SectionWall& wall) { return Points(wall.size()); }

Points times(double factor, Points points) {
  for (Point& p : points) p *= factor;
  return points;
}
Points sum(Points a, const Points& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

// A displacement of the size of a design's.
Points by_bumps(const SectionWall& wall) {
  return times(0.003, HicksHenne(wall, {24, 3.0, false}).displacement(Scatter().numbers(24)));
}

// Half-thickness of NACA 0012 and its integral from 0 to 1.
double half_thickness(double x) {
  return 0.6 * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))));
}
constexpr double half_area =
    0.6 * (0.2969 * 2.0 / 3.0 - 0.1260 / 2.0 - 0.3516 / 3.0 + 0.2843 / 4.0 - 0.1036 / 5.0);

// To leading order, what an inscribed polygon lacks: l^2 theta/12 a node, theta the angle by which it turns.
double polygon_deficit(const SectionWall& wall) {
  double deficit = 0.0;
  for (std::size_t w = 1; w < wall.size(); ++w) {
    const Point before = wall.positions[w] - wall.positions[w - 1];
    const Point after = wall.positions[(w + 1) % wall.size()] - wall.positions[w];
    const double turn = std::atan2(after[0] * before[1] - after[1] * before[0], dot(before, after));
    deficit += turn * 0.5 * (dot(before, before) + dot(after, after)) / 12.0;
  }
  return deficit;
}

TEST(SectionGeometry, AreaIsThatOfTheThicknessLawLessWhatThePolygonCutsOff) {
  for (const int around : {64, 129, 256}) {
    const SectionWall wall = SectionMesh("naca0012", around, 8).wall;
    const double deficit = polygon_deficit(wall);
    EXPECT_NEAR(measure_section(wall, still(wall)).area.value, 2.0 * half_area - deficit, 0.1 * deficit);
  }
}

TEST(SectionGeometry, ThicknessIsTheGreatestOfItsLaw) {
  double exact = 0.0;
  for (double x = 0.29; x < 0.31; x += 1e-6) exact = std::max(exact, 2.0 * half_thickness(x));
  EXPECT_NEAR(exact, 0.12, 1e-4);
  for (const int around : {32, 64, 129, 256}) {
    const SectionWall wall = SectionMesh("naca0012", around, 8).wall;
    const SectionMeasure thickness = measure_section(wall, still(wall)).thickness;
    // Slopes are wrong by h^2 f'''/6, the cubic by no more than a quarter h of that; f''' of both surfaces is
    // below 8 behind x = 0.25.
    double h = 0.0;
    for (std::size_t w = 0; w < wall.size(); ++w) {
      const double x = wall.positions[w][0];
      if (norm(thickness.by_wall[w]) == 0.0) continue;
      EXPECT_NEAR(x, 0.3, 16.0 / around) << "only nodes about the greatest thickness count";
      h = std::max(h, std::abs(x - wall.positions[w - 1][0]));
    }
    EXPECT_NEAR(thickness.value, exact, h * h * h * 8.0 / 24.0);
  }
}

TEST(SectionGeometry, LeadingEdgeRadiusTendsToThatOfTheFamily) {
  const double exact = 1.1019 * 0.12 * 0.12;
  double coarser = 0.0;
  for (const int around : {64, 128, 256, 512}) {
    const SectionWall wall = SectionMesh("naca0012", around, 8).wall;
    const SectionMeasure radius = measure_section(wall, still(wall)).leading_edge_radius;
    double farthest = 0.0;
    int used = 0;
    for (std::size_t w = 0; w < wall.size(); ++w)
      if (norm(radius.by_wall[w]) > 0.0)
        ++used, farthest = std::max(farthest, std::abs(wall.positions[w][1]));
    EXPECT_EQ(used, 5);
    // x = y^2/(2R) (1 + 4.77 |y| + ...): |y|^3 on y^2 projects with a coefficient of about the farthest |y|.
    const double error = 1.0 - radius.value / exact;
    EXPECT_NEAR(error, 4.77 * farthest, 0.3 * 4.77 * farthest);
    if (coarser > 0.0) {
      EXPECT_NEAR(coarser / error, 2.0, 0.25);
    }
    coarser = error;
  }
}

TEST(SectionGeometry, ALeadingEdgeBetweenNodesIsFittedSymmetrically) {
  const SectionWall wall = SectionMesh("naca0012", 129, 8).wall;
  const SectionMeasure radius = measure_section(wall, still(wall)).leading_edge_radius;
  EXPECT_NEAR(radius.value, 1.1019 * 0.12 * 0.12, 1.3 * 4.77 * 0.0098 * 0.0159);
  for (std::size_t w = 1; w < wall.size(); ++w) {
    EXPECT_NEAR(radius.by_wall[w][0], radius.by_wall[wall.size() - w][0], 1e-8);
    EXPECT_NEAR(radius.by_wall[w][1], -radius.by_wall[wall.size() - w][1], 1e-8);
  }
}

// A parabola is its own best fit, wherever it lies.
TEST(SectionGeometry, RadiusOfAParabolaIsExact) {
  const SectionWall wall = SectionMesh("naca0012", 128, 8).wall;
  Points displacement = still(wall);
  for (std::size_t w = 0; w < wall.size(); ++w) {
    const double y = wall.positions[w][1];
    displacement[w] = {{0.3 + 0.05 * y + y * y / (2.0 * 0.0123) - wall.positions[w][0], 0.0}};
  }
  EXPECT_NEAR(measure_section(wall, displacement).leading_edge_radius.value, 0.0123, 1e-13);
}

// Euler's theorem: independent of the position, homogeneous in the size.
TEST(SectionGeometry, DerivativesObeyTranslationAndScaling) {
  for (const char* section : {"naca0012", "naca2412"}) {
    const SectionWall wall = SectionMesh(section, 128, 8).wall;
    for (const Points& displacement : {still(wall), by_bumps(wall)}) {
      const SectionMeasures measures = measure_section(wall, displacement);
      const Points positions = sum(wall.positions, displacement);
      for (const Named& m : all_measures) {
        const SectionMeasure& measure = measures.*m.member;
        Point total{};
        double size = 0.0;
        for (const Point& p : measure.by_wall) total += p, size += norm(p);
        EXPECT_LT(norm(total), 1e-11 * size) << m.name;
        EXPECT_NEAR(inner(measure.by_wall, positions), m.degree * measure.value, 1e-12 * size) << m.name;
      }
    }
  }
}

// The error of a central difference with half the step is a third of what halving changed, to leading order.
// `unit`: the size that a change of the numbers' last digit gets in the measure.
void expect_derivative(double derivative, const std::function<double(double)>& measure, double step,
                       double unit, const std::string& what) {
  const auto difference = [&](double h) { return (measure(h) - measure(-h)) / (2.0 * h); };
  const double once = difference(step), half = difference(0.5 * step);
  EXPECT_NEAR(derivative, half, 0.5 * std::abs(once - half) + unit / step) << what;
  EXPECT_LT(std::abs(once - half), 1e-3 * std::abs(half) + unit / step) << what << ": step too long";
}

constexpr double last_digits = 1e-14;  // of a measure, which sums and divides some hundred numbers

TEST(SectionGeometry, DerivativesAreThoseOfDifferences) {
  for (const char* section : {"naca0012", "naca2412"}) {
    const SectionWall wall = SectionMesh(section, 96, 8).wall;
    Scatter scatter;
    for (const Points& displacement : {still(wall), by_bumps(wall)})
      for (int trial = 0; trial < 4; ++trial) {
        const Points direction = scatter.vectors(wall.size());
        const SectionMeasures at = measure_section(wall, displacement);
        for (const Named& m : all_measures)
          expect_derivative(
              inner((at.*m.member).by_wall, direction),
              [&](double h) {
                return (measure_section(wall, sum(displacement, times(h, direction))).*m.member).value;
              },
              1e-6, last_digits, m.name);  // a small part of the distance of nodes, squared
      }
  }
}

TEST(SectionGeometry, DerivativesByBumpsAreThoseOfDifferences) {
  for (const bool symmetric : {false, true}) {
    const SectionWall wall = SectionMesh("naca0012", 128, 8).wall;
    const HicksHenne bumps(wall, {24, 3.0, symmetric});
    std::vector<double> design = Scatter().numbers(bumps.variables());
    for (const double size : {0.0, 0.003}) {
      for (double& a : design) a *= size;
      const SectionMeasures at = measure_section(wall, bumps.displacement(design));
      for (const Named& m : all_measures) {
        const std::vector<double> gradient = bumps.amplitude_gradient((at.*m.member).by_wall);
        for (std::size_t v = 0; v < gradient.size(); ++v)
          expect_derivative(
              gradient[v],
              [&](double h) {
                std::vector<double> moved = design;
                moved[v] += h;
                return (measure_section(wall, bumps.displacement(moved)).*m.member).value;
              },
              1e-4, last_digits, m.name + std::string(" by bump ") + std::to_string(v));
      }
      design = Scatter().numbers(bumps.variables());
    }
  }
}

// On a symmetric section the nodes of both surfaces stand above each other, where an interpolation with kinks
// has two derivatives.
TEST(SectionGeometry, ThicknessHasOneDerivativeOnASymmetricSection) {
  const SectionWall wall = SectionMesh("naca0012", 96, 8).wall;
  const SectionMeasure at = measure_section(wall, still(wall)).thickness;
  Scatter scatter;
  for (int trial = 0; trial < 8; ++trial) {
    const Points direction = scatter.vectors(wall.size());
    for (const double h : {1e-8, -1e-8}) {
      const double moved = measure_section(wall, times(h, direction)).thickness.value;
      // Second derivatives are of the order of one over the squared distance of nodes, 1e3.
      EXPECT_NEAR((moved - at.value) / h, inner(at.by_wall, direction), 1e-4);
    }
  }
}

TEST(SectionGeometry, ThicknessIsContinuousWhereTheGreatestPassesANode) {
  const SectionWall wall = SectionMesh("naca0012", 64, 8).wall;
  const HicksHenne bumps(wall, {24, 3.0, false});
  std::vector<double> design(24, 0.0);
  double last = 0.0;
  for (int i = 0; i <= 400; ++i) {
    design[16] = 5e-5 * i - 0.01;  // moves the greatest thickness over several nodes
    const double value = measure_section(wall, bumps.displacement(design)).thickness.value;
    if (i > 0) {
      EXPECT_LT(std::abs(value - last), 2.0 * 5e-5);
    }
    last = value;
  }
}

TEST(SectionGeometry, RefusesADisplacementOfAnotherWall) {
  const SectionWall wall = SectionMesh("naca0012", 64, 8).wall;
  EXPECT_THROW(measure_section(wall, Points(63)), InternalError);
}

}  // namespace
}  // namespace wingbeat
