#include <gtest/gtest.h>

#include "adjoint/hicks_henne.hpp"
#include "adjoint/mesh_deformation.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/mesh_check.hpp"
#include "core/mesh/mesh_quality.hpp"
#include "test/adjoint/section_meshes.hpp"
#include "test/core/mesh/message.hpp"

// What is left of the cells' quality at the bounds of the default bumps, +-1 % of chord.
namespace wingbeat {
namespace {

using Vectors = std::vector<Vec<double, 2>>;

struct DeformedSection {
  SectionMesh section;
  HicksHenne bumps{section.wall, {}};
  MeshDeformation lines{section.mesh, section.numbers, section.wall, DeformationMethod::grid_lines};
  MeshDeformation distance{section.mesh, section.numbers, section.wall, DeformationMethod::inverse_distance};

  explicit DeformedSection(const std::string& name) : section(name, 250, 50) {}

  MultiblockMesh<2> with(const std::vector<double>& amplitudes, const MeshDeformation& deformation) const {
    return deformed(Comm(MPI_COMM_SELF), section.mesh, section.numbers, deformation,
                    bumps.displacement(amplitudes));
  }
  std::vector<double> single(int i, double amplitude) const {
    std::vector<double> amplitudes(24, 0.0);
    amplitudes[i] = amplitude;
    return amplitudes;
  }
  // Faces of the wall that a displacement turns round: no mesh can follow it.
  int turned_faces(const std::vector<double>& amplitudes) const {
    const Vectors wall = bumps.displacement(amplitudes);
    const Vectors& x = section.wall.positions;
    int turned = 0;
    for (std::size_t w = 0; w < x.size(); ++w) {
      const std::size_t next = (w + 1) % x.size();
      const auto before = x[next] - x[w];
      turned += dot(before, before + wall[next] - wall[w]) <= 0.0 ? 1 : 0;
    }
    return turned;
  }
};

// Not worse than 1 % below the undeformed mesh's worst cell, which lies at the trailing edge.
void expect_quality_kept(const DeformedSection& s, const std::vector<double>& amplitudes,
                         const MeshDeformation& deformation, const std::string& what) {
  const MultiblockMesh<2> mesh = s.with(amplitudes, deformation);
  const MeshQuality<2> before = measure_quality(s.section.mesh), after = measure_quality(mesh);
  EXPECT_TRUE(volume_faults(mesh).empty()) << what << ": " << volume_faults(mesh).front();
  EXPECT_GT(after.min_determinant.value, 0.99 * before.min_determinant.value) << what;
  EXPECT_LT(after.max_volume_ratio.value, 1.01 * before.max_volume_ratio.value) << what;
  EXPECT_LT(after.max_aspect_ratio.value, 1.2 * before.max_aspect_ratio.value) << what;
}

TEST(DeformedQuality, EachBumpAtItsBoundsKeepsTheCellsOfARoundNose) {
  const DeformedSection s("naca0012");
  for (int i = 0; i < 24; ++i)
    for (const double amplitude : {0.01, -0.01})
      for (const MeshDeformation* deformation : {&s.lines, &s.distance})
        expect_quality_kept(s, s.single(i, amplitude), *deformation, "bump " + std::to_string(i));
}

// The nose of the NACA 64A010 has a radius of 0.7 %: moved inward by 1 % along its normals it would
// turn inside out.
TEST(DeformedQuality, ASharperNoseBearsEachBumpButTheInwardOnesAcrossIt) {
  const DeformedSection s("naca64a010");
  for (int i = 0; i < 24; ++i)
    for (const double amplitude : {0.01, -0.01}) {
      const auto amplitudes = s.single(i, amplitude);
      const bool across_the_nose = amplitude < 0.0 && i >= 9 && i <= 14;
      EXPECT_EQ(s.turned_faces(amplitudes) > 0, across_the_nose) << "bump " << i << " at " << amplitude;
      for (const MeshDeformation* deformation : {&s.lines, &s.distance})
        if (across_the_nose)
          EXPECT_FALSE(volume_faults(s.with(amplitudes, *deformation)).empty()) << "bump " << i;
        else
          expect_quality_kept(s, amplitudes, *deformation, "bump " + std::to_string(i));
    }
}

TEST(DeformedQuality, AllBumpsAtOnceOutwardAndByTurnsKeepTheCellsWithGridLines) {
  const DeformedSection s("naca64a010");
  std::vector<double> outward(24, 0.01), by_turns, cambered;
  for (int i = 0; i < 24; ++i) {
    by_turns.push_back(i % 2 == 0 ? 0.01 : -0.01);
    cambered.push_back(i < 12 ? -0.01 : 0.01);
  }
  expect_quality_kept(s, outward, s.lines, "all outward");
  for (const MeshDeformation* deformation : {&s.lines, &s.distance}) {
    expect_quality_kept(s, by_turns, *deformation, "by turns");
    expect_quality_kept(s, cambered, *deformation, "cambered");
  }
}

TEST(DeformedQuality, FoldedCellsAreNamed) {
  const DeformedSection s("naca64a010");
  const auto faults = volume_faults(s.with(std::vector<double>(24, -0.01), s.lines));
  ASSERT_FALSE(faults.empty());
  example::expect_contains(faults.front(), "zone 'block-1', cell (");
  example::expect_contains(faults.front(), "negative volume");
}

}  // namespace
}  // namespace wingbeat
