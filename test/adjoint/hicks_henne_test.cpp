#include "adjoint/hicks_henne.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "test/adjoint/section_meshes.hpp"

namespace wingbeat {
namespace {

const SectionMesh& section() {
  static const SectionMesh mesh("naca64a010", 250, 8);
  return mesh;
}

TEST(HicksHenne, BumpsAreOneAtTheirPeakAndZeroAtTheTrailingEdge) {
  for (const double width : {1.0, 2.5, 3.0})
    for (const int n : {1, 2, 24, 25, 2400}) {
      const HicksHenne bumps(section().wall, {n, width, false});
      EXPECT_EQ(bumps.variables(), n);
      for (int i = 0; i < n; i += 1 + n / 30) {
        EXPECT_DOUBLE_EQ(bumps.peak(i), (i + 1.0) / (n + 1.0));
        EXPECT_NEAR(bumps.bump(i, bumps.peak(i)), 1.0, 1e-12);
        EXPECT_LT(bumps.bump(i, bumps.peak(i) + 1e-2 * bumps.peak(i) * (1 - bumps.peak(i))), 1.0);
        EXPECT_LT(bumps.bump(i, bumps.peak(i) - 1e-2 * bumps.peak(i) * (1 - bumps.peak(i))), 1.0);
        EXPECT_EQ(bumps.bump(i, 0.0), 0.0);
        EXPECT_EQ(bumps.bump(i, 1.0), 0.0);
      }
    }
}

// eq:hicks-henne written out.
TEST(HicksHenne, BumpsAreThoseOfTheirFormula) {
  const HicksHenne bumps(section().wall, {24, 3.0, false});
  for (int i = 0; i < 24; ++i)
    for (double s = 0.01; s < 1.0; s += 0.01) {
      const double peak = (i + 1.0) / 25.0;
      const double upper_peak = peak >= 0.5 ? peak : 1.0 - peak, upper_s = peak >= 0.5 ? s : 1.0 - s;
      const double formula =
          std::pow(std::sin(std::numbers::pi * std::pow(upper_s, std::log(0.5) / std::log(upper_peak))), 3.0);
      EXPECT_NEAR(bumps.bump(i, s), formula, 1e-13);
    }
}

TEST(HicksHenne, MirroredBumpsAreMirrorImages) {
  for (const int n : {24, 25}) {
    const HicksHenne bumps(section().wall, {n, 3.0, false});
    for (int i = 0; i < n; ++i)
      for (int k = 1; k < 64; ++k)  // 1 - s is exact
        EXPECT_NEAR(bumps.bump(i, k / 64.0), bumps.bump(n - 1 - i, 1.0 - k / 64.0), 1e-15);
    const std::size_t size = section().wall.size();
    for (int i = 0; i < n; ++i) {
      std::vector<double> one(n, 0.0), other(n, 0.0);
      one[i] = other[n - 1 - i] = 0.01;
      const auto below = bumps.displacement(one), above = bumps.displacement(other);
      for (std::size_t w = 1; w < size; ++w) {
        EXPECT_NEAR(below[w][0], above[size - w][0], 1e-13);
        EXPECT_NEAR(below[w][1], -above[size - w][1], 1e-13);
      }
    }
  }
}

TEST(HicksHenne, WallMovesOutwardByTheAmplitudeAndTheTrailingEdgeStays) {
  const HicksHenne bumps(section().wall, {24, 3.0, false});
  for (int i = 0; i < 24; ++i) {
    std::vector<double> amplitudes(24, 0.0);
    amplitudes[i] = 0.01;
    const auto wall = bumps.displacement(amplitudes);
    EXPECT_EQ(norm(wall[0]), 0.0);
    for (std::size_t w = 0; w < wall.size(); ++w) {
      const double outward = dot(wall[w], section().wall.normals[w]);
      EXPECT_NEAR(outward, 0.01 * bumps.bump(i, section().wall.s[w]), 1e-16);
      EXPECT_NEAR(norm(wall[w]), outward, 1e-15);
    }
  }
}

TEST(HicksHenne, GradientIsTheTransposeOfTheDisplacement) {
  for (const bool symmetric : {false, true})
    for (const int n : {1, 24, 25, 300})
      for (const double width : {3.0, 2.2}) {
        const HicksHenne bumps(section().wall, {n, width, symmetric});
        Scatter scatter;
        const auto amplitudes = scatter.numbers(bumps.variables());
        const auto wall = scatter.vectors(section().wall.size());
        const double direct = inner(wall, bumps.displacement(amplitudes));
        const double transposed = inner(amplitudes, bumps.amplitude_gradient(wall));
        EXPECT_NEAR(transposed, direct, 1e-13 * (1.0 + std::abs(direct)));
      }
}

TEST(HicksHenne, SymmetricVariablesDriveMirroredPairs) {
  for (const int n : {24, 25}) {
    const HicksHenne pairs(section().wall, {n, 3.0, true}), single(section().wall, {n, 3.0, false});
    ASSERT_EQ(pairs.variables(), (n + 1) / 2);
    for (int i = 0; i < pairs.variables(); ++i) {
      std::vector<double> one(pairs.variables(), 0.0), both(n, 0.0);
      one[i] = both[i] = both[n - 1 - i] = 0.01;
      EXPECT_EQ(pairs.displacement(one), single.displacement(both));
    }
    const std::vector<double> amplitudes(pairs.variables(), 0.01);
    const auto wall = pairs.displacement(amplitudes);
    for (std::size_t w = 1; w < wall.size(); ++w) EXPECT_NEAR(wall[w][1], -wall[wall.size() - w][1], 1e-13);
  }
}

TEST(HicksHenne, ThousandsOfBumpsAreFast) {
  const HicksHenne bumps(section().wall, {2400, 3.0, false});
  Scatter scatter;
  const auto wall = scatter.vectors(section().wall.size());
  const auto start = std::chrono::steady_clock::now();
  const auto gradient = bumps.amplitude_gradient(wall);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(gradient.size(), 2400U);
  EXPECT_LT(elapsed.count(), 1.0) << "about 0.015 s on an idle machine";
}

TEST(HicksHenne, RefusesWhatDoesNotFit) {
  EXPECT_THROW(HicksHenne(section().wall, {0, 3.0, false}), InternalError);
  const HicksHenne bumps(section().wall, {24, 3.0, true});
  EXPECT_THROW(bumps.displacement(std::vector<double>(24)), InternalError);
  EXPECT_THROW(bumps.amplitude_gradient(std::vector<Vec<double, 2>>(24)), InternalError);
}

}  // namespace
}  // namespace wingbeat
