#include "core/mesh/cgns_mesh.hpp"

#include <array>
#include <fstream>
#include <vector>

#include "core/mesh/mesh_file.hpp"
#include "test/core/mesh/cgns_example.hpp"
#include "test/core/mesh/example_meshes.hpp"

namespace wingbeat {
namespace {

using namespace example;
namespace fs = std::filesystem;

template <int Dim>
MultiblockMesh<Dim> read_back(const fs::path& path) {
  return std::get<MultiblockMesh<Dim>>(read_mesh(path));
}

template <int Dim>
bool survives(const MultiblockMesh<Dim>& mesh, const fs::path& path) {
  write_cgns(mesh, path);
  return same(read_back<Dim>(path), mesh);
}

TEST(CgnsMesh, RoundTripIsExact) {
  const TemporaryFolder folder;
  EXPECT_TRUE(survives(ring(8, 3), folder / "ring.cgns"));
  EXPECT_TRUE(survives(row_of_blocks<2>(3, {3, 2}), folder / "row2.cgns"));
  EXPECT_TRUE(survives(row_of_blocks<3>(2, {3, 2, 4}), folder / "row3.cgns"));
  EXPECT_EQ(folder.file_count(), 3U);
}

TEST(CgnsMesh, AdfAndHdf5HoldTheSameMesh) {
  const TemporaryFolder folder;
  const MultiblockMesh<3> mesh = row_of_blocks<3>(2, {3, 2, 4});
  write_cgns(mesh, folder / "hdf5.cgns");
  copy_as_adf(folder / "hdf5.cgns", folder / "adf.anything");
  int type = 0;
  ASSERT_EQ(cg_is_cgns((folder / "hdf5.cgns").c_str(), &type), CG_OK);
  EXPECT_EQ(type, CG_FILE_HDF5);
  ASSERT_EQ(cg_is_cgns((folder / "adf.anything").c_str(), &type), CG_OK);
  EXPECT_EQ(type, CG_FILE_ADF);
  EXPECT_TRUE(same(read_back<3>(folder / "adf.anything"), mesh));
}

TEST(CgnsMesh, KeepsInterfacesOfEveryOrientation) {
  const TemporaryFolder folder;
  const auto check = [&]<int Dim>(const MultiblockMesh<Dim>& plain, int zone) {
    for (const Orientation<Dim>& o : all_orientations<Dim>()) {
      const MultiblockMesh<Dim> turned = reoriented(plain, zone, o);
      write_cgns(turned, folder / "turned.cgns");
      EXPECT_TRUE(same(read_back<Dim>(folder / "turned.cgns"), make_right_handed(turned)));
    }
  };
  check(row_of_blocks<2>(3, {3, 2}), 1);
  check(ring(6, 2), 0);
  check(row_of_blocks<3>(3, {1, 3, 2}), 1);
}

TEST(CgnsMesh, KeepsTheOrderOfTwelveZones) {
  const TemporaryFolder folder;
  EXPECT_TRUE(survives(row_of_blocks<2>(12, {2, 2}), folder / "twelve.cgns"));
}

TEST(CgnsMesh, BackwardRangesMeanTheSameInterface) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3);
  write_cgns(mesh, folder / "ring.cgns");
  edit(folder / "ring.cgns", [](int fn) {
    ASSERT_EQ(cg_goto(fn, 1, "Zone_t", 1, "ZoneGridConnectivity_t", 1, "end"), CG_OK);
    ASSERT_EQ(cg_delete_node("cut-low"), CG_OK);
    const std::array<cgsize_t, 4> range{1, 4, 1, 1};
    const std::array<cgsize_t, 4> donor{9, 4, 9, 1};
    const std::array<int, 2> transform{-1, 2};  // the sign of the normal is the other way round, too
    int n = 0;
    ASSERT_EQ(cg_1to1_write(fn, 1, 1, "cut-low", "ring", range.data(), donor.data(), transform.data(), &n),
              CG_OK);
  });
  MultiblockMesh<2> read = read_back<2>(folder / "ring.cgns");
  if (read.zones[0].interfaces[0].name != "cut-low")
    std::swap(read.zones[0].interfaces[0], read.zones[0].interfaces[1]);
  EXPECT_TRUE(same(read, mesh));
}

// Every cell of `expected` has a cell of `mesh` at the same place, with as many patches and interfaces.
void expect_same_shape(const MultiblockMesh<2>& mesh, const MultiblockMesh<2>& expected) {
  ASSERT_EQ(mesh.zones.size(), expected.zones.size());
  for (std::size_t z = 0; z < mesh.zones.size(); ++z) {
    const int number = static_cast<int>(z);
    EXPECT_EQ(mesh.zones[z].patches.size(), expected.zones[z].patches.size());
    EXPECT_EQ(mesh.zones[z].interfaces.size(), expected.zones[z].interfaces.size());
    for_each<2>(box_of<2>(expected.zones[z].cells), [&](const Index<2>& cell) {
      double nearest = 1.0;
      for_each<2>(box_of<2>(mesh.zones[z].cells), [&](const Index<2>& other) {
        nearest =
            std::min(nearest, distance<2>(centre<2>(mesh, number, other), centre<2>(expected, number, cell)));
      });
      ASSERT_LT(nearest, 1e-14);
    });
  }
}

TEST(CgnsMesh, CollapsesOneCellBetweenSymmetryPlanesHoweverItLies) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> plane = row_of_blocks<2>(2, {3, 2});
  const MultiblockMesh<3> thick = extruded(plane, 2, 0.25);
  for (const Orientation<3>& o : all_orientations<3>()) {
    write_cgns(reoriented(thick, 0, o), folder / "thick.cgns");
    expect_same_shape(read_back<2>(folder / "thick.cgns"), plane);
  }
  for (int span : {0, 1, 2}) {
    write_cgns(extruded(ring(8, 3), span, 0.25), folder / "thick.cgns");
    EXPECT_TRUE(same(read_back<2>(folder / "thick.cgns"), ring(8, 3)));
  }
}

TEST(CgnsMesh, RefusesATaperedSpan) {
  const TemporaryFolder folder;
  MultiblockMesh<3> thick = extruded(ring(8, 3), 2, 0.25);
  thick.zones[0].nodes({3, 1, 1})[0] += 0.01;
  write_cgns(thick, folder / "wing.cgns");
  const std::string message = message_of([&] { read_mesh(folder / "wing.cgns"); });
  expect_contains(message, "wing.cgns: zone 'ring', node (4, 2, 1): the mesh is one cell thick");
}

TEST(CgnsMesh, StaysThreeDimensionalWithoutSymmetryPlanes) {
  const TemporaryFolder folder;
  MultiblockMesh<3> thick = extruded(ring(8, 3), 2, 0.25);
  for (auto& patch : thick.zones[0].patches)
    if (patch.type == BoundaryType::symmetry) patch.type = BoundaryType::farfield;
  EXPECT_TRUE(survives(thick, folder / "thick.cgns"));
}

TEST(CgnsMesh, ReadsSinglePrecisionAndEveryWallType) {
  const TemporaryFolder folder;
  for (BCType_t wall :
       {BCWall, BCWallInviscid, BCWallViscous, BCWallViscousHeatFlux, BCWallViscousIsothermal}) {
    RawFile raw = raw_square();
    raw.patches[2].type = wall;
    raw.write(folder / "raw.cgns");
    const MultiblockMesh<2> mesh = read_back<2>(folder / "raw.cgns");
    EXPECT_EQ(mesh.zones[0].patches[2].type, BoundaryType::slip_wall);
    EXPECT_EQ(mesh.zones[0].patches[3].type, BoundaryType::farfield);
    EXPECT_EQ(mesh.zones[0].nodes({1, 2}), (Vec<double, 2>{{{0.5, 1.0}}}));
  }
}

TEST(CgnsMesh, DropsAConstantThirdCoordinate) {
  const TemporaryFolder folder;
  RawFile raw = raw_square();
  raw.physical_dim = 3;
  raw.coordinates.push_back({"CoordinateZ", std::vector<float>(9, 7.0F)});
  raw.write(folder / "raw.cgns");
  EXPECT_EQ(read_back<2>(folder / "raw.cgns").zones[0].nodes({2, 1}), (Vec<double, 2>{{{1.0, 0.5}}}));
  raw.coordinates[0].second[0] = -0.25F;
  raw.coordinates[2].second[4] = 8.0F;
  expect_contains(refusal(raw, folder), "zone 'raw': is a surface (CellDim 2) in space");
}

TEST(CgnsMesh, ReadsRangesOfEdgeCentres) {
  const TemporaryFolder folder;
  RawFile raw = raw_square();
  const std::vector<std::vector<cgsize_t>> ranges{{1, 1, 1, 2}, {3, 1, 3, 2}, {1, 1, 2, 1}, {1, 3, 2, 3}};
  for (std::size_t p = 0; p < 4; ++p) raw.patches[p].range = ranges[p], raw.patches[p].location = EdgeCenter;
  raw.write(folder / "raw.cgns");
  const MultiblockMesh<2> mesh = read_back<2>(folder / "raw.cgns");
  for (int p = 0; p < 4; ++p) EXPECT_EQ(mesh.zones[0].patches[p].side, (Side{p / 2, p % 2}));
}

TEST(CgnsMesh, ReadsRangesOfFaceCentres) {
  const TemporaryFolder folder;
  const auto with_wall = [&](std::array<cgsize_t, 6> range, GridLocation_t location, PointSetType_t points) {
    write_cgns(extruded(ring(8, 3), 2, 0.25), folder / "ring.cgns");
    edit(folder / "ring.cgns", [&](int fn) {
      ASSERT_EQ(cg_goto(fn, 1, "Zone_t", 1, "ZoneBC_t", 1, "end"), CG_OK);
      ASSERT_EQ(cg_delete_node("wall"), CG_OK);
      int n = 0;
      ASSERT_EQ(cg_boco_write(fn, 1, 1, "body", BCWall, points, 2, range.data(), &n), CG_OK);
      if (location != Vertex) {
        ASSERT_EQ(cg_boco_gridlocation_write(fn, 1, 1, n, location), CG_OK);
      }
    });
    return message_of([&] { read_mesh(folder / "ring.cgns"); });
  };
  EXPECT_EQ(with_wall({1, 1, 1, 8, 1, 1}, FaceCenter, PointRange), "");
  EXPECT_EQ(with_wall({1, 1, 1, 8, 1, 1}, JFaceCenter, PointRange), "");
  EXPECT_EQ(with_wall({1, 1, 1, 8, 1, 1}, Vertex, ElementRange), "");
  expect_contains(
      with_wall({1, 1, 1, 4, 1, 1}, FaceCenter, PointRange),
      "zone 'ring', patch 'body': its range (1, 1, 1) to (4, 1, 1) of faces may lie on more than one side");
  expect_contains(with_wall({1, 1, 1, 8, 1, 1}, KFaceCenter, PointRange),
                  "zone 'ring', side j-low, cell (1, 1, 1): no boundary condition");
}

TEST(CgnsMesh, ResolvesFamilies) {
  const TemporaryFolder folder;
  RawFile raw = raw_square();
  raw.patches[2].type = FamilySpecified;
  raw.write(folder / "raw.cgns");
  expect_contains(message_of([&] { read_mesh(folder / "raw.cgns"); }),
                  "zone 'raw', patch 'south': its type is FamilySpecified, but the file has no family ''");
  edit(folder / "raw.cgns", [](int fn) {
    ASSERT_EQ(cg_goto(fn, 1, "Zone_t", 1, "ZoneBC_t", 1, "BC_t", 3, "end"), CG_OK);
    ASSERT_EQ(cg_famname_write("Section"), CG_OK);
    int family = 0;
    ASSERT_EQ(cg_family_write(fn, 1, "Section", &family), CG_OK);
  });
  expect_contains(message_of([&] { read_mesh(folder / "raw.cgns"); }), "family 'Section' has no FamilyBC");
  edit(folder / "raw.cgns", [](int fn) {
    int n = 0;
    ASSERT_EQ(cg_fambc_write(fn, 1, 1, "FamBC", BCSymmetryPlane, &n), CG_OK);
  });
  const MultiblockMesh<2> mesh = read_back<2>(folder / "raw.cgns");
  EXPECT_EQ(mesh.zones[0].patches[2].type, BoundaryType::symmetry);
  EXPECT_EQ(mesh.zones[0].patches[2].family, "Section");
}

// A family of another base is given by a path.
TEST(CgnsMesh, ReadsFamiliesGivenByAPath) {
  const TemporaryFolder folder;
  raw_square().write(folder / "raw.cgns");
  edit(folder / "raw.cgns", [](int fn) {
    ASSERT_EQ(cg_goto(fn, 1, "Zone_t", 1, "ZoneBC_t", 1, "BC_t", 3, "end"), CG_OK);
    ASSERT_EQ(cg_famname_write("OtherBase/Section"), CG_OK) << cg_get_error();
  });
  EXPECT_EQ(read_back<2>(folder / "raw.cgns").zones[0].patches[2].family, "Section");
}

}  // namespace
}  // namespace wingbeat
