#include "core/mesh/plot3d.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/io/file.hpp"
#include "core/mesh/mesh_check.hpp"
#include "core/mesh/mesh_file.hpp"
#include "test/core/mesh/example_meshes.hpp"
#include "test/core/mesh/message.hpp"
#include "test/core/mesh/temporary_folder.hpp"

namespace wingbeat {
namespace {

using namespace example;

MultiblockMesh<2> read_plane(const std::filesystem::path& path) {
  return std::get<MultiblockMesh<2>>(read_mesh(path));
}

int count_faces(const MultiblockMesh<2>& mesh, BoundaryType type) {
  std::size_t faces = 0;
  for (const Zone<2>& zone : mesh.zones)
    for (const BoundaryPatch<2>& patch : zone.patches)
      if (patch.type == type) faces += patch.cells.size();
  return static_cast<int>(faces);
}

std::string refusal(const TemporaryFolder& folder, const std::string& text) {
  write_file(folder / "mesh.x", text);
  return message_of([&] { read_mesh(folder / "mesh.x"); });
}

TEST(Plot3d, ReadsTheReferenceMesh) {
  const MultiblockMesh<2> mesh = read_plane(WINGBEAT_TEST_DATA "/naca0012_128x32.x");
  ASSERT_EQ(mesh.zones.size(), 1U);
  const Zone<2>& zone = mesh.zones[0];
  EXPECT_EQ(zone.cells, (Index<2>{128, 32}));
  ASSERT_EQ(zone.interfaces.size(), 2U);
  EXPECT_EQ(zone.interfaces[0].side, (Side{0, 0}));
  EXPECT_EQ(zone.interfaces[0].donor_side, (Side{0, 1}));
  EXPECT_EQ(zone.interfaces[0].nodes, (Box<2>{{0, 0}, {1, 33}}));
  ASSERT_EQ(zone.patches.size(), 2U);
  EXPECT_EQ(zone.patches[0].type, BoundaryType::slip_wall);
  EXPECT_EQ(zone.patches[0].side, (Side{1, 0}));
  EXPECT_EQ(zone.patches[1].type, BoundaryType::farfield);
  EXPECT_EQ(zone.patches[1].side, (Side{1, 1}));
  // The trailing edge, and the first point of the file beside it, on one end or the other.
  const int first = std::abs(zone.nodes({1, 0})[0] - 0.99910464123285514) < 1e-16 ? 1 : 127;
  EXPECT_EQ(zone.nodes({first, 0})[0], 0.99910464123285514);
}

TEST(Plot3d, RoundTripKeepsNodesToTheBit) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3, "block-1");
  write_plot3d(mesh, folder / "ring.x");
  const MultiblockMesh<2> read = read_plane(folder / "ring.x");
  for_each<2>(mesh.zones[0].nodes.interior(),
              [&](const Index<2>& node) { EXPECT_EQ(read.zones[0].nodes(node), mesh.zones[0].nodes(node)); });
}

TEST(Plot3d, ReadsFilesWithAndWithoutACountOfBlocks) {
  const TemporaryFolder folder;
  write_plot3d(ring(8, 3), folder / "ring.x");
  const std::string text = read_file(folder / "ring.x");
  write_file(folder / "bare.x", text.substr(text.find('\n') + 1));
  EXPECT_TRUE(same(read_plane(folder / "bare.x"), read_plane(folder / "ring.x")));
}

TEST(Plot3d, ReadsFortranNumbers) {
  const TemporaryFolder folder;
  // A square ring: 4 x 1 cells around the unit square.
  write_file(folder / "ring.x",
             "5 2\n 1.D0 -1 -1. +1d+0 1.0E0   2.0 -2 -2, 2*2.0\r\n  1 1 -1 -1 1  2 2 -2 -2.000D+00 2\n");
  const MultiblockMesh<2> mesh = read_plane(folder / "ring.x");
  EXPECT_EQ(mesh.cell_count(), 4U);
  EXPECT_EQ(count_faces(mesh, BoundaryType::slip_wall), 4);
  EXPECT_EQ(count_faces(mesh, BoundaryType::farfield), 4);
}

TEST(Plot3d, FindsConnectionsOfEveryOrientationAndPartOfASide) {
  const TemporaryFolder folder;
  // An O-mesh cut unevenly into an inner ring and two outer pieces, each renumbered.
  const MultiblockMesh<2> whole = ring(12, 4);
  MultiblockMesh<2> pieces;
  for (const Box<2>& cells : {Box<2>{{0, 0}, {12, 2}}, Box<2>{{0, 2}, {5, 4}}, Box<2>{{5, 2}, {12, 4}}})
    pieces.zones.push_back(
        make_zone<2>("piece", {cells.extent(0), cells.extent(1)}, [&](const Index<2>& node) {
          return whole.zones[0].nodes({node[0] + cells.begin[0], node[1] + cells.begin[1]});
        }));
  for (const Orientation<2>& o : all_orientations<2>()) {
    write_plot3d(reoriented(reoriented(pieces, 1, o), 0, o), folder / "pieces.x");
    const MultiblockMesh<2> mesh = read_plane(folder / "pieces.x");
    EXPECT_EQ(mesh.zones.size(), 3U);
    EXPECT_EQ(count_faces(mesh, BoundaryType::slip_wall), 12);
    EXPECT_EQ(count_faces(mesh, BoundaryType::farfield), 12);
    EXPECT_EQ(mesh.zones[0].interfaces.size(), 4U);
  }
}

TEST(Plot3d, FindsTheWakeCutOfACMesh) {
  const TemporaryFolder folder;
  write_plot3d(bare_c_mesh(4, 8, 2), folder / "c.x");
  const MultiblockMesh<2> mesh = read_plane(folder / "c.x");
  EXPECT_EQ(count_faces(mesh, BoundaryType::slip_wall), 8);
  EXPECT_EQ(count_faces(mesh, BoundaryType::farfield), 16 + 2 + 2);
  ASSERT_EQ(mesh.zones[0].interfaces.size(), 2U);
  EXPECT_EQ(mesh.zones[0].interfaces[0].nodes.extent(0), 5);
}

TEST(Plot3d, CollapsesAMeshOneCellThick) {
  const TemporaryFolder folder;
  for (int span : {0, 1, 2}) {
    write_plot3d(extruded(ring(8, 3), span, 0.25), folder / "thick.x");
    write_plot3d(ring(8, 3), folder / "flat.x");
    EXPECT_TRUE(same(read_plane(folder / "thick.x"), read_plane(folder / "flat.x")));
  }
}

TEST(Plot3d, ReadsAPlaneOfNodesInSpace) {
  const TemporaryFolder folder;
  write_file(folder / "ring.x", "5 2 1  1 -1 -1 1 1 2 -2 -2 2 2  1 1 -1 -1 1 2 2 -2 -2 2  10*0.5");
  EXPECT_EQ(read_plane(folder / "ring.x").cell_count(), 4U);
  expect_contains(refusal(folder, "5 2 1  1 -1 -1 1 1 2 -2 -2 2 2  1 1 -1 -1 1 2 2 -2 -2 2  9*0.5 0.7"),
                  "zone 'block-1': has one node in direction k, but its z is not constant");
}

TEST(Plot3d, FindsInterfacesOfThreeDimensionalBlocks) {
  const TemporaryFolder folder;
  // A shell around a sphere-like hole: the six blocks of a hollow cube, some renumbered.
  MultiblockMesh<3> shell;
  for (int face = 0; face < 6; ++face)
    shell.zones.push_back(make_zone<3>("face", {3, 3, 2}, [&](const Index<3>& node) {
      const double u = node[0] / 1.5 - 1.0;
      const double v = node[1] / 1.5 - 1.0;
      const double scale = 1.0 + 0.5 * node[2];
      const double sign = face % 2 == 0 ? 1.0 : -1.0;
      Vec<double, 3> x{};
      x[face / 2] = sign * scale;
      x[(face / 2 + 1) % 3] = u * scale;
      x[(face / 2 + 2) % 3] = v * scale;
      return x;
    }));
  const auto orientations = all_orientations<3>();
  for (std::size_t z = 0; z < 6; ++z) shell = reoriented(shell, static_cast<int>(z), orientations[7 * z + 3]);
  write_plot3d(shell, folder / "shell.x");
  const auto mesh = std::get<MultiblockMesh<3>>(read_mesh(folder / "shell.x"));
  for (const Zone<3>& zone : mesh.zones) {
    EXPECT_EQ(zone.interfaces.size(), 4U);
    ASSERT_EQ(zone.patches.size(), 2U);
    EXPECT_NE(zone.patches[0].type, zone.patches[1].type);
  }
}

TEST(Plot3d, RefusesWhatIsNotANumberNamingTheLine) {
  const TemporaryFolder folder;
  expect_contains(refusal(folder, "5 2\n1 2 3\n4 five 6\n"), "mesh.x:3: 'five' is not a number");
  expect_contains(refusal(folder, "wing 3 3\n"), "mesh.x:1: 'wing' is not a number");
}

TEST(Plot3d, RefusesTheWrongNumberOfValues) {
  const TemporaryFolder folder;
  const std::string message = refusal(folder, "1\n2 2\n0 1 0 1 0 0 1\n");
  expect_contains(message, "mesh.x: holds 10 values, which fits no formatted Plot3D mesh without IBLANK");
  expect_contains(message, "as 2-D with a count of blocks: 11 values");
  expect_contains(refusal(folder, ""), "it does not begin with counts of nodes");
}

TEST(Plot3d, RefusesNodesThatAreNotFinite) {
  const TemporaryFolder folder;
  expect_contains(refusal(folder, "5 2\n 1 -1 -1 1 1 2 -2 nan 2 2  1 1 -1 -1 1 2 2 -2 -2 2"),
                  "zone 'block-1', node (3, 2): coordinates are not finite");
}

TEST(Plot3d, RefusesASingleBoundarySurface) {
  const TemporaryFolder folder;
  expect_contains(refusal(folder, "2 2\n0 1 0 1\n0 0 1 1\n"), "the mesh has a single boundary surface");
}

TEST(Plot3d, RefusesSidesWithoutExtent) {
  const TemporaryFolder folder;
  expect_contains(refusal(folder, "2 3\n0 0 0 1 0 2\n0 0 1 1 2 2\n"),
                  "zone 'block-1', side j-low, cell (1, 1): the side collapses");
}

TEST(MeshFile, TellsCompressedAndMissingFiles) {
  const TemporaryFolder folder;
  write_file(folder / "mesh.x.gz", "\x1f\x8b\x08 compressed");
  expect_contains(message_of([&] { read_mesh(folder / "mesh.x.gz"); }), "decompress it first: gunzip ");
  expect_contains(message_of([&] { read_mesh(folder / "none.x"); }),
                  "none.x: cannot read the file: No such file");
}

}  // namespace
}  // namespace wingbeat
