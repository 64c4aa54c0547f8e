#include "core/mesh/mesh_check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/mesh_quality.hpp"
#include "test/core/mesh/example_meshes.hpp"
#include "test/core/mesh/message.hpp"

namespace wingbeat {
namespace {

using namespace example;

template <int Dim>
std::string faults_of(const MultiblockMesh<Dim>& mesh) {
  return message_of([&] { validate(mesh, "wing.cgns"); });
}

TEST(Validate, AcceptsSoundMeshes) {
  EXPECT_EQ(faults_of(ring(8, 3)), "");
  EXPECT_EQ(faults_of(row_of_blocks<2>(3, {3, 2})), "");
  EXPECT_EQ(faults_of(row_of_blocks<3>(2, {3, 2, 4})), "");
  EXPECT_EQ(faults_of(extruded(ring(8, 3), 2, 1.0)), "");
}

TEST(Validate, AcceptsEveryRenumberingOnceRightHanded) {
  const MultiblockMesh<3> plain = row_of_blocks<3>(3, {2, 3, 4});
  for (const Orientation<3>& o : all_orientations<3>())
    EXPECT_EQ(faults_of(make_right_handed(reoriented(plain, 1, o))), "");
  for (const Orientation<2>& o : all_orientations<2>())
    EXPECT_EQ(faults_of(make_right_handed(reoriented(ring(8, 3), 0, o))), "");
}

TEST(Validate, NamesANodeThatIsNotFinite) {
  MultiblockMesh<2> mesh = ring(8, 3);
  mesh.zones[0].nodes({2, 1})[1] = std::numeric_limits<double>::quiet_NaN();
  expect_contains(faults_of(mesh), "wing.cgns: 1 fault");
  expect_contains(faults_of(mesh), "zone 'ring', node (3, 2): coordinates are not finite");
}

TEST(Validate, NamesAnInvertedCell) {
  MultiblockMesh<3> mesh = row_of_blocks<3>(1, {4, 4, 4});
  mesh.zones[0].nodes({2, 2, 1})[2] += 10.0;
  expect_contains(faults_of(mesh), "zone 'block-1', cell (2, 2, 2): negative volume -");
}

TEST(Validate, NamesACellOfZeroVolume) {
  MultiblockMesh<2> mesh = row_of_blocks<2>(1, {2, 2});
  auto& nodes = mesh.zones[0].nodes;
  nodes({1, 1}) = nodes({0, 0});
  nodes({1, 0}) = nodes({0, 0});
  expect_contains(faults_of(mesh), "zone 'block-1', cell (1, 1): zero volume");
}

// What is not a matter of cells and nodes is left to validate().
TEST(VolumeFaults, AreThoseOfCellsAndNodesAlone) {
  MultiblockMesh<2> mesh = row_of_blocks<2>(2, {4, 4});
  mesh.zones[0].patches.clear();
  EXPECT_TRUE(volume_faults(mesh).empty());
  mesh.zones[1].nodes({2, 1})[1] += 10.0;
  ASSERT_EQ(volume_faults(mesh).size(), 1U);
  expect_contains(volume_faults(mesh).front(), "zone 'block-2', cell (");
  expect_contains(volume_faults(mesh).front(), "negative volume -");
  mesh.zones[0].nodes({2, 1})[1] = std::numeric_limits<double>::infinity();
  ASSERT_EQ(volume_faults(mesh).size(), 2U);
  expect_contains(volume_faults(mesh).front(), "zone 'block-1', node (3, 2): coordinates are not finite");
}

TEST(Validate, TellsALeftHandedBlock) {
  const MultiblockMesh<2> mesh = reoriented(row_of_blocks<2>(2, {3, 2}), 1, {{1, 0}, {1, 1}});
  const std::string message = faults_of(mesh);
  expect_contains(message, "wing.cgns: 1 fault");
  expect_contains(message, "zone 'block-2': every cell has negative volume: the block is left-handed");
}

TEST(Validate, NamesTheNodeAndTheGapOfAnUnmatchedInterface) {
  MultiblockMesh<2> mesh = row_of_blocks<2>(2, {3, 3});
  mesh.zones[1].nodes({0, 2})[0] += 2e-3;
  const std::string message = faults_of(mesh);
  expect_contains(
      message, "zone 'block-1', interface 'next': node (4, 3) is not where zone 'block-2' has node (1, 3)");
  expect_contains(message, "zone 'block-2', interface 'previous'");
  expect_contains(message, "largest distance 0.002");
}

TEST(Validate, ToleratesRoundedCoordinates) {
  MultiblockMesh<2> mesh = row_of_blocks<2>(2, {3, 3});
  mesh.zones[1].nodes({0, 2})[0] += 5e-5;
  EXPECT_EQ(faults_of(mesh), "");
}

TEST(Validate, RefusesAConnectionListedOnOneSideOnly) {
  MultiblockMesh<2> mesh = row_of_blocks<2>(2, {3, 3});
  mesh.zones[1].interfaces.clear();
  const std::string message = faults_of(mesh);
  expect_contains(
      message,
      "zone 'block-1', interface 'next': its donor, zone 'block-2', does not list the reverse connection "
      "on side i-low");
  expect_contains(message,
                  "zone 'block-2', side i-low, cell (1, 1): no boundary condition and no interface (3 cells");
}

TEST(Validate, NamesFacesCoveredTwiceOrNotAtAll) {
  MultiblockMesh<2> mesh = ring(8, 3);
  mesh.zones[0].patches[0].cells.begin[0] = 3;
  mesh.zones[0].patches[1].cells.end[0] = 7;
  add_patch<2>(mesh.zones[0], "outlet", BoundaryType::farfield, {1, 1});
  const std::string message = faults_of(mesh);
  expect_contains(message, "2 faults");
  expect_contains(message,
                  "zone 'ring', side j-low, cell (1, 1): no boundary condition and no interface (3 cells");
  expect_contains(message,
                  "zone 'ring', side j-high, cell (1, 3): covered more than once by 'farfield', 'outlet'");
}

TEST(Validate, RefusesRangesOffTheirSide) {
  MultiblockMesh<2> mesh = row_of_blocks<2>(2, {3, 3});
  mesh.zones[0].patches[0].cells.end[0] = 9;
  mesh.zones[0].interfaces[0].donor_origin = {0, 1};
  const std::string message = faults_of(mesh);
  expect_contains(message, "zone 'block-1', patch 'j0': its range does not lie on a side of the zone");
  expect_contains(message, "zone 'block-1', interface 'next': its donor range does not lie on side i-low");
}

TEST(Validate, ListsTwentyFaultsAndCountsTheRest) {
  MultiblockMesh<2> mesh;
  for (int z = 0; z < 6; ++z) {
    mesh.zones.push_back(row_of_blocks<2>(1, {2, 2}).zones[0]);
    mesh.zones.back().patches.clear();
  }
  const std::string message = faults_of(mesh);
  expect_contains(message, "24 faults");
  expect_contains(message, "... and 4 more");
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 21);
}

TEST(CellVolume, OfWarpedHexahedraAddsUpToThatOfTheirUnion) {
  // The unit cube, its inner nodes displaced: shared bilinear faces leave the total exact.
  const auto position = [](const Index<3>& node) {
    Vec<double, 3> x{{{node[0] / 3.0, node[1] / 3.0, node[2] / 3.0}}};
    bool inner = true;
    for (int d = 0; d < 3; ++d) inner = inner && node[d] > 0 && node[d] < 3;
    if (inner)
      for (int d = 0; d < 3; ++d) x[d] += 0.08 * std::sin(5.0 * node[d] + 3.0 * node[(d + 1) % 3]);
    return x;
  };
  const Zone<3> zone = make_zone<3>("cube", {3, 3, 3}, position);
  double total = 0.0;
  for_each<3>(box_of<3>(zone.cells),
              [&](const Index<3>& cell) { total += cell_volume(cell_corners<3>(zone, cell)); });
  EXPECT_NEAR(total, 1.0, 1e-14);
}

TEST(MeshQuality, MeasuresAShearedStretchedBlock) {
  // Parallelograms of 60 degrees; the second row is three times as high.
  const double height[] = {0.0, 1.0, 4.0};
  Zone<2> zone = make_zone<2>("sheared", {2, 2}, [&](const Index<2>& node) {
    const double y = height[node[1]];
    return Vec<double, 2>{{{node[0] + y / std::sqrt(3.0), y}}};
  });
  const MultiblockMesh<2> mesh{{zone}};
  const MeshQuality<2> quality = measure_quality(mesh);
  EXPECT_EQ(quality.cells, 4U);
  EXPECT_NEAR(quality.total_volume, 8.0, 1e-14);
  EXPECT_NEAR(quality.min_volume.value, 1.0, 1e-14);
  EXPECT_NEAR(quality.max_volume.value, 3.0, 1e-14);
  EXPECT_NEAR(quality.min_angle_deg.value, 60.0, 1e-12);
  EXPECT_NEAR(quality.min_determinant.value, std::sqrt(3.0) / 2.0, 1e-14);
  EXPECT_NEAR(quality.max_aspect_ratio.value, 3.0 * 2.0 / std::sqrt(3.0), 1e-13);
  EXPECT_NEAR(quality.max_volume_ratio.value, 3.0, 1e-13);
  EXPECT_EQ(quality.max_volume.cell, (Index<2>{0, 1}));
  expect_contains(format_quality(mesh, quality), "zone sheared, cell (1, 2)");
}

TEST(MeshQuality, ComparesVolumesAcrossInterfacesAndCountsFaces) {
  const MultiblockMesh<2> mesh = ring(8, 3);
  const MeshQuality<2> quality = measure_quality(mesh);
  EXPECT_EQ(quality.wall_faces, 8U);
  EXPECT_EQ(quality.farfield_faces, 8U);
  EXPECT_EQ(quality.interfaces, 2U);
  EXPECT_NEAR(quality.max_volume_ratio.value, 1.3 * 1.3, 1e-12);
}

}  // namespace
}  // namespace wingbeat
