#include "optimize/wall_limits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/cell_geometry.hpp"
#include "test/adjoint/section_meshes.hpp"

namespace wingbeat {
namespace {

double value(const LinearLimit& limit, const std::vector<double>& design) {
  return inner(limit.coefficients, design);
}

// The part of its length that the face which suffers most keeps along where it lay.
double least_part(const SectionWall& wall, const HicksHenne& bumps, const std::vector<double>& design) {
  const auto change = bumps.displacement(design);
  double least = 1.0;
  for (std::size_t w = 0; w < wall.size(); ++w) {
    const std::size_t next = (w + 1) % wall.size();
    const Vec<double, 2> face = wall.positions[next] - wall.positions[w];
    least = std::min(least, dot(face + change[next] - change[w], face) / dot(face, face));
  }
  return least;
}

TEST(WallLimits, ADesignViolatesSomeLimitExactlyWhereAFaceShrinksBelowIt) {
  const SectionWall wall = SectionMesh("naca0012", 128, 8).wall;
  for (const bool symmetric : {false, true}) {
    const HicksHenne bumps(wall, {24, 3.0, symmetric});
    const double bound = 0.02, least = 0.3;
    const auto limits = wall_limits(wall, bumps, bound, least);
    Scatter scatter;
    int folding = 0, standing = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      std::vector<double> design = scatter.numbers(bumps.variables());
      for (double& a : design) a *= bound;
      const double part = least_part(wall, bumps, design);
      const bool violates = std::ranges::any_of(
          limits, [&](const LinearLimit& limit) { return value(limit, design) < limit.lower; });
      if (std::abs(part - least) < 1e-12) continue;
      EXPECT_EQ(violates, part < least);
      ++(part < least ? folding : standing);
    }
    EXPECT_GT(folding, 20) << "else nothing is shown";
    EXPECT_GT(standing, 20);
  }
}

TEST(WallLimits, TheUndeformedWallViolatesNone) {
  const SectionWall wall = SectionMesh("naca2412", 96, 8).wall;
  const HicksHenne bumps(wall, {24, 3.0, false});
  const std::vector<double> still(24, 0.0);
  for (const double least : {0.01, 0.5, 0.99}) {
    const auto limits = wall_limits(wall, bumps, 0.05, least);
    EXPECT_FALSE(limits.empty());
    for (const LinearLimit& limit : limits) EXPECT_GT(value(limit, still), limit.lower);
  }
}

TEST(WallLimits, ThoseLeftCanBeViolatedWithinTheBox) {
  const SectionWall wall = SectionMesh("naca0012", 128, 8).wall;
  const HicksHenne bumps(wall, {24, 3.0, false});
  std::size_t more = wall.size();
  for (const double bound : {0.03, 0.01, 0.003}) {
    const auto limits = wall_limits(wall, bumps, bound, 0.3);
    EXPECT_LT(limits.size(), more) << "a smaller box needs fewer";
    more = std::max<std::size_t>(limits.size(), 1);
    for (const LinearLimit& limit : limits) {
      std::vector<double> corner;
      for (const double c : limit.coefficients) corner.push_back(c > 0.0 ? -bound : bound);
      EXPECT_LT(value(limit, corner), limit.lower);
      EXPECT_LT(least_part(wall, bumps, corner), 0.3);
    }
  }
}

TEST(WallLimits, ABoxThatCannotFoldTheWallNeedsNone) {
  const SectionWall wall = SectionMesh("naca0012", 128, 8).wall;
  EXPECT_TRUE(wall_limits(wall, HicksHenne(wall, {24, 3.0, false}), 1e-5, 0.3).empty());
}

}  // namespace
}  // namespace wingbeat
