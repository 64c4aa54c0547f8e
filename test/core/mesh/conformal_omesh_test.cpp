#include "core/mesh/conformal_omesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/io/error.hpp"
#include "core/mesh/mesh_check.hpp"

namespace wingbeat {
namespace {

using Point = Vec<double, 2>;
using Nodes = BlockArray<Point, 2>;

double norm(const Point& a) { return std::hypot(a[0], a[1]); }
double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }

double smallest_area(const Zone<2>& zone) {
  double smallest = 1e300;
  for_each(box_of<2>(zone.cells), [&](const Index<2>& c) {
    const auto [i, j] = c;
    const Point up = zone.nodes({i + 1, j + 1}) - zone.nodes({i, j});
    const Point down = zone.nodes({i, j + 1}) - zone.nodes({i + 1, j});
    smallest = std::min(smallest, 0.5 * cross(up, down));
  });
  return smallest;
}

Nodes omesh(const std::string& airfoil, const OmeshOptions& options) {
  return conformal_omesh(make_airfoil(airfoil), options).zones.front().nodes;
}

struct Reference {
  std::string airfoil;
  int around, normal;
};

class ReferenceMesh : public ::testing::TestWithParam<Reference> {};

TEST_P(ReferenceMesh, IsReproduced) {
  const auto& [airfoil, around, normal] = GetParam();
  const std::string size = std::to_string(around) + "x" + std::to_string(normal);
  std::ifstream file(std::string(WINGBEAT_TEST_DATA) + "/omesh_" + airfoil + "_" + size + ".txt");
  ASSERT_TRUE(file);
  const Nodes nodes = omesh(airfoil, {.around = around, .normal = normal});
  int compared = 0;
  double wall = 0.0, field = 0.0;  // the latter relative to the distance from the origin
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    int i = 0, j = 0;
    Point expected;
    words >> i >> j >> expected[0] >> expected[1];
    const double error = norm(nodes({i, j}) - expected);
    if (j == 0) wall = std::max(wall, error);
    field = std::max(field, error / std::max(1.0, norm(expected)));
    ++compared;
  }
  EXPECT_EQ(compared, 4 * around);
  // Both generators iterate to round-off, which the square root at the trailing edge amplifies.
  EXPECT_LT(wall, 1e-10);
  EXPECT_LT(field, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(ConformalOmesh, ReferenceMesh,
                         ::testing::Values(Reference{"naca0012", 128, 32}, Reference{"naca64a010", 128, 32},
                                           Reference{"naca64a010", 250, 50}));

TEST(ConformalOmesh, WallLiesOnTheSectionFromLowerToUpperTrailingEdge) {
  const Nodes nodes = omesh("naca0012", {.around = 100, .normal = 20});
  EXPECT_NEAR(norm(nodes({0, 0}) - Point{{1.0, 0.0}}), 0.0, 1e-15);
  for (int i = 0; i <= 100; ++i) {
    const double x = nodes({i, 0})[0], y = nodes({i, 0})[1];
    const double half = 0.6 * (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x -
                               0.1036 * x * x * x * x);
    EXPECT_NEAR(y, i < 50 ? -half : half, 1e-15 + 1e-8 * (i == 50));  // sqrt of round-off at the nose
  }
}

TEST(ConformalOmesh, FirstAndLastColumnCoincide) {
  const Nodes nodes = omesh("naca4415", {.around = 33, .normal = 9});
  for (int j = 0; j <= 9; ++j) EXPECT_EQ(nodes({0, j}), nodes({33, j}));
}

TEST(ConformalOmesh, IsValidForManySectionsAndSizes) {
  for (const std::string airfoil : {"naca0006", "naca0024", "naca4415", "naca64a010"})
    for (const auto& [around, normal] : {std::pair{16, 4}, {17, 5}, {33, 40}, {250, 50}}) {
      const auto mesh = conformal_omesh(make_airfoil(airfoil), {.around = around, .normal = normal});
      EXPECT_GT(smallest_area(mesh.zones.front()), 0.0) << airfoil << ' ' << around << " x " << normal;
      EXPECT_EQ(mesh_faults(mesh), std::vector<std::string>{}) << airfoil << ' ' << around << " x " << normal;
    }
}

TEST(ConformalOmesh, VeryFineMeshesAreValid) {
  const auto mesh = conformal_omesh(make_airfoil("naca0012"), {.around = 1024, .normal = 256});
  EXPECT_GT(smallest_area(mesh.zones.front()), 0.0);
}

// Greatest cosine between central differences along the two families of lines, where the logarithm
// of the radius is equidistant; off the wall, where the map has the section's own breaks.
double greatest_skewness(int around) {
  const int normal = around / 4;
  const Nodes nodes = omesh("naca4415", {.around = around, .normal = normal, .stretching = 1.0});
  double worst = 0.0;
  for (int i = 1; i < around; ++i)
    for (int j = normal / 16; j < normal; ++j) {
      const Point along = nodes({i + 1, j}) - nodes({i - 1, j}), out = nodes({i, j + 1}) - nodes({i, j - 1});
      worst = std::max(worst, std::abs(dot(along, out)) / (norm(along) * norm(out)));
    }
  return worst;
}

TEST(ConformalOmesh, LinesAreOrthogonalToSecondOrder) {
  const double coarse = greatest_skewness(256), fine = greatest_skewness(512);
  EXPECT_LT(fine, 1e-2);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

TEST(ConformalOmesh, WallCellsAreSquareAndTheFarFieldIsWhereAsked) {
  const int around = 256, normal = 64;
  const Nodes nodes = omesh("naca0012", {.around = around, .normal = normal, .farfield_chords = 100.0});
  Point centre{};
  for (int i = 0; i < around; ++i) centre += (1.0 / around) * nodes({i, normal});
  for (int i = 0; i < around; ++i) {
    EXPECT_NEAR(norm(nodes({i, normal}) - centre), 100.0, 2e-3);  // the map's 1/r: 0.22/(2.75 100)
    if (i < around / 8 || i >= around - around / 8) continue;
    const double along = norm(nodes({i + 1, 0}) - nodes({i, 0})), out = norm(nodes({i, 1}) - nodes({i, 0}));
    EXPECT_NEAR(out / along, 1.0, 0.1);
  }
}

TEST(ConformalOmesh, RadiiAreAGeometricSeriesOfSteps) {
  const double farfield = std::log(200.0);
  const auto ratios_of = [](const std::vector<double>& radii) {
    std::vector<double> ratios;
    for (std::size_t j = 2; j < radii.size(); ++j)
      ratios.push_back((radii[j] - radii[j - 1]) / (radii[j - 1] - radii[j - 2]));
    return ratios;
  };
  const auto square = logarithmic_radii(farfield, {.around = 128, .normal = 32});
  EXPECT_EQ(square.front(), 0.0);
  EXPECT_EQ(square.back(), farfield);
  EXPECT_NEAR(square[1], 2.0 * std::numbers::pi / 128, 1e-14);
  for (const double ratio : ratios_of(square)) EXPECT_NEAR(ratio, ratios_of(square).front(), 1e-11);
  for (const double ratio :
       ratios_of(logarithmic_radii(farfield, {.around = 128, .normal = 32, .stretching = 1.2})))
    EXPECT_NEAR(ratio, 1.2, 1e-11);
  // More layers than square cells would take: thinner ones, never shrinking outwards.
  for (const double ratio : ratios_of(logarithmic_radii(farfield, {.around = 16, .normal = 100})))
    EXPECT_NEAR(ratio, 1.0, 1e-11);
}

TEST(ConformalOmesh, RefusesOptionsOutOfRange) {
  const Airfoil airfoil = make_airfoil("naca0012");
  const auto message = [&](const OmeshOptions& options) -> std::string {
    try {
      conformal_omesh(airfoil, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(message({.around = 15}).find("is 15; it must be at least 16"), std::string::npos);
  EXPECT_NE(message({.normal = 3}).find("is 3; it must be at least 4"), std::string::npos);
  EXPECT_NE(message({.farfield_chords = 0.5}).find("more than 1 chord"), std::string::npos);
  EXPECT_NE(message({.farfield_chords = NAN}).find("more than 1 chord"), std::string::npos);
  EXPECT_NE(message({.stretching = 0.0}).find("positive"), std::string::npos);
  EXPECT_NE(message({.blocks = 0}).find("at least 1"), std::string::npos);
  EXPECT_NE(message({.around = 16, .normal = 4, .blocks = 65}).find("64 at most"), std::string::npos);
}

}  // namespace
}  // namespace wingbeat
