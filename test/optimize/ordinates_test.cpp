#include "optimize/ordinates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "adjoint/hicks_henne.hpp"
#include "core/io/file.hpp"
#include "core/mesh/airfoil_file.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/parallel/comm.hpp"
#include "test/adjoint/section_meshes.hpp"

namespace wingbeat {
namespace {

using Point = Vec<double, 2>;

// Each rank has its own: the test program also runs on several.
std::filesystem::path scratch_file() {
  return std::filesystem::path(testing::TempDir()) /
         ("wingbeat_ordinates_" + std::to_string(Comm().rank()) + ".dat");
}

std::vector<Point> displaced(const SectionWall& wall, double amplitude) {
  const HicksHenne bumps(wall, {24, 3.0, false});
  std::vector<double> amplitudes = Scatter().numbers(24);
  for (double& a : amplitudes) a *= amplitude;
  const auto change = bumps.displacement(amplitudes);
  std::vector<Point> moved = wall.positions;
  for (std::size_t w = 0; w < moved.size(); ++w) moved[w] += change[w];
  return moved;
}

std::vector<Point> points_of(const std::filesystem::path& file) {
  std::istringstream lines(read_file(file));
  std::string line;
  std::getline(lines, line);
  std::vector<Point> points;
  for (Point p; lines >> p[0] >> p[1];) points.push_back(p);
  return points;
}

// Distance of the section from the point, from a start near its foot.
double distance(const Airfoil& airfoil, const Point& point, double t) {
  for (int step = 0; step < 60; ++step) {
    const SectionPoint at = airfoil.at(t);
    t = std::clamp(t + dot(point - at.position, at.tangent) / dot(at.tangent, at.tangent), -1.0, 1.0);
  }
  return norm(point - airfoil.at(t).position);
}

void expect_same_polygon(const std::vector<Point>& wall, const std::string& title) {
  const std::size_t n = wall.size();
  const auto file = scratch_file();
  write_ordinates(file, title, wall);

  const std::vector<Point> written = points_of(file);
  ASSERT_EQ(written.size(), n + 1);
  for (std::size_t i = 0; i <= n; ++i) EXPECT_EQ(written[i], wall[(n - i) % n]) << "to the last bit";

  const Airfoil airfoil = read_airfoil(file);
  EXPECT_LT(norm(airfoil.at(1.0).position - airfoil.at(-1.0).position), 1e-15) << "closed";
  const double nose = std::ranges::min(wall, {}, [](const Point& p) { return p[0]; })[0];
  for (std::size_t w = 0; w < n; ++w) {
    const Point& p = wall[w];
    const double t = std::sqrt((p[0] - nose) / (wall[0][0] - nose));
    const double away = std::min(distance(airfoil, p, t), distance(airfoil, p, -t));
    EXPECT_LT(away, 1e-14) << "point " << w;
  }
  std::filesystem::remove(file);
}

TEST(Ordinates, ReadBackAreThePolygonOfASymmetricSection) {
  for (const int around : {64, 129, 256})
    expect_same_polygon(SectionMesh("naca0012", around, 8).wall.positions, "optimum");
}

TEST(Ordinates, ReadBackAreThePolygonOfADisplacedSection) {
  for (const double amplitude : {0.001, 0.003, 0.01})
    expect_same_polygon(displaced(SectionMesh("naca0012", 128, 8).wall, amplitude), "optimum");
}

TEST(Ordinates, AnyTitleIsRead) {
  const auto wall = SectionMesh("naca0012", 64, 8).wall.positions;
  for (const char* title : {"", "0012 thinned", "two\nlines", "# a comment", "0.5 0.5"})
    expect_same_polygon(wall, title);
}

TEST(Ordinates, MeshOfTheFileHasTheSection) {
  const SectionMesh before("naca0012", 128, 16);
  const std::vector<Point> wall = displaced(before.wall, 0.002);
  const auto file = scratch_file();
  write_ordinates(file, "displaced", wall);
  const SectionMesh after(file.string(), 128, 16);
  const Airfoil airfoil = read_airfoil(file);
  for (const Point& p : after.wall.positions) {
    const double t = std::copysign(std::sqrt(std::max(p[0], 0.0)), p[1]);
    EXPECT_LT(std::min(distance(airfoil, p, t), distance(airfoil, p, -t)), 1e-9);
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace wingbeat
