#include <array>
#include <fstream>
#include <vector>

#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/mesh_file.hpp"
#include "test/core/mesh/cgns_example.hpp"
#include "test/core/mesh/example_meshes.hpp"

namespace wingbeat {
namespace {

using namespace example;
namespace fs = std::filesystem;

TEST(CgnsRefusal, RefusesUnknownBoundaryTypes) {
  const TemporaryFolder folder;
  RawFile raw = raw_square();
  raw.patches[1].type = BCOutflow;
  const std::string message = refusal(raw, folder);
  expect_contains(
      message, "raw.cgns: zone 'raw', patch 'east': boundary type BCOutflow is not supported; allowed are");
  expect_contains(message, "BCSymmetryPlane and BCFarfield");
}

TEST(CgnsRefusal, RefusesAMissingBoundary) {
  const TemporaryFolder folder;
  RawFile raw = raw_square();
  raw.patches.pop_back();
  expect_contains(refusal(raw, folder),
                  "raw.cgns: 1 fault in the mesh (indices count from 1):\n  zone 'raw', side "
                  "j-high, cell (1, 2): no boundary condition and no interface (2 cells in all)");
}

TEST(CgnsRefusal, RefusesDegenerateAndInnerPatches) {
  const TemporaryFolder folder;
  RawFile raw = raw_square();
  raw.patches[0].range = {1, 1, 1, 1};
  expect_contains(refusal(raw, folder),
                  "zone 'raw', patch 'west': its range (1, 1) to (1, 1) is not a face on a side");
  raw.patches[0].range = {2, 1, 2, 3};
  expect_contains(refusal(raw, folder),
                  "zone 'raw', patch 'west': its range (2, 1) to (2, 3) is not a face on a side");
}

TEST(CgnsRefusal, RefusesListsOfPoints) {
  const TemporaryFolder folder;
  RawFile raw = raw_square();
  raw.patches[0].points = PointList;
  raw.patches[0].range = {1, 1, 1, 2, 1, 3};
  expect_contains(refusal(raw, folder), "zone 'raw', patch 'west': its points are given as PointList");
}

TEST(CgnsRefusal, RefusesUnstructuredZones) {
  const TemporaryFolder folder;
  RawFile raw;
  raw.type = Unstructured;
  raw.size = {9, 4, 0};
  expect_contains(refusal(raw, folder),
                  "raw.cgns: zone 'raw': is Unstructured; only structured zones are supported");
}

TEST(CgnsRefusal, RefusesZonesWithoutCoordinates) {
  const TemporaryFolder folder;
  RawFile raw = raw_square();
  raw.coordinates.pop_back();
  expect_contains(refusal(raw, folder), "raw.cgns: zone 'raw': has no CoordinateY; it has CoordinateX");
  raw.coordinates.clear();
  expect_contains(refusal(raw, folder), "raw.cgns: zone 'raw': has no coordinates");
}

// Lest memory is asked for that no file of that length can fill.
TEST(CgnsRefusal, RefusesMoreNodesThanTheFileCanHold) {
  const TemporaryFolder folder;
  RawFile raw;
  raw.size = {100000, 100000, 99999, 99999, 0, 0};
  expect_contains(refusal(raw, folder), "raw.cgns: zone 'raw': tells of 1e+10 values in a file of ");
}

TEST(CgnsRefusal, RefusesAConnectionListedOnOneSideOnly) {
  const TemporaryFolder folder;
  MultiblockMesh<2> mesh = row_of_blocks<2>(2, {3, 3});
  mesh.zones[1].interfaces.clear();
  add_patch<2>(mesh.zones[1], "hole", BoundaryType::farfield, {0, 0});
  write_cgns(mesh, folder / "mesh.cgns");
  expect_contains(
      message_of([&] { read_mesh(folder / "mesh.cgns"); }),
      "zone 'block-1', interface 'next': its donor, zone 'block-2', does not list the reverse connection");
}

TEST(CgnsRefusal, RefusesContradictingConnections) {
  const TemporaryFolder folder;
  const auto refuse_connection = [&](std::array<cgsize_t, 4> range, std::array<cgsize_t, 4> donor,
                                     std::array<int, 2> transform, const std::string& donor_name) {
    raw_square().write(folder / "raw.cgns");
    edit(folder / "raw.cgns", [&](int fn) {
      int n = 0;
      ASSERT_EQ(cg_1to1_write(fn, 1, 1, "link", donor_name.c_str(), range.data(), donor.data(),
                              transform.data(), &n),
                CG_OK)
          << cg_get_error();
    });
    return message_of([&] { read_mesh(folder / "raw.cgns"); });
  };
  expect_contains(refuse_connection({1, 1, 1, 3}, {3, 1, 3, 3}, {1, 2}, "tail"),
                  "zone 'raw', interface 'link': there is no donor zone 'tail'");
  // A donor in another base is given by a path, of twice 32 characters at the most.
  const std::string base(32, 'B'), zone(32, 'Z');
  expect_contains(refuse_connection({1, 1, 1, 3}, {3, 1, 3, 3}, {1, 2}, base + "/" + zone),
                  "zone 'raw', interface 'link': there is no donor zone '" + zone + "'");
  expect_contains(refuse_connection({1, 1, 1, 3}, {3, 1, 3, 3}, {1, -2}, "raw"),
                  "interface 'link': its Transform does not carry PointRange to PointRangeDonor");
  expect_contains(refuse_connection({1, 1, 1, 1}, {3, 1, 3, 1}, {1, 2}, "raw"),
                  "interface 'link': its PointRange (1, 1) to (1, 1) is not a face on a side");
}

TEST(CgnsRefusal, RefusesPeriodicAndGeneralConnections) {
  const TemporaryFolder folder;
  write_cgns(ring(8, 3), folder / "ring.cgns");
  edit(folder / "ring.cgns", [](int fn) {
    const std::array<float, 3> centre{}, angle{}, shift{1.0F, 0.0F, 0.0F};
    ASSERT_EQ(cg_1to1_periodic_write(fn, 1, 1, 1, centre.data(), angle.data(), shift.data()), CG_OK)
        << cg_get_error();
  });
  expect_contains(message_of([&] { read_mesh(folder / "ring.cgns"); }),
                  "periodic connections are not supported");

  raw_square().write(folder / "raw.cgns");
  edit(folder / "raw.cgns", [](int fn) {
    const std::array<cgsize_t, 4> range{1, 1, 1, 3};
    const std::array<cgsize_t, 6> donors{3, 1, 3, 2, 3, 3};
    int n = 0;
    ASSERT_EQ(cg_conn_write(fn, 1, 1, "slide", Vertex, Abutting, PointRange, 2, range.data(), "raw",
                            Structured, PointListDonor, Integer, 3, donors.data(), &n),
              CG_OK)
        << cg_get_error();
  });
  expect_contains(message_of([&] { read_mesh(folder / "raw.cgns"); }), "zone 'raw': its general connections");
}

TEST(CgnsRefusal, RefusesFilesThatAreNotCgns) {
  const TemporaryFolder folder;
  expect_contains(message_of([&] { read_cgns(folder / "none.cgns"); }), "none.cgns: no such file");
  std::ofstream(folder / "text.cgns") << "this is no mesh";
  expect_contains(message_of([&] { read_mesh(folder / "text.cgns"); }),
                  "text.cgns: not a readable CGNS file (ADF or HDF5): cg");

  write_cgns(ring(8, 3), folder / "ring.cgns");
  fs::resize_file(folder / "ring.cgns", fs::file_size(folder / "ring.cgns") / 2);
  expect_contains(message_of([&] { read_mesh(folder / "ring.cgns"); }),
                  "ring.cgns: not a readable CGNS file");
  write_cgns(ring(8, 3), folder / "hdf5.cgns");
  copy_as_adf(folder / "hdf5.cgns", folder / "adf.cgns");
  fs::resize_file(folder / "adf.cgns", fs::file_size(folder / "adf.cgns") / 2);
  expect_contains(message_of([&] { read_mesh(folder / "adf.cgns"); }), "adf.cgns: ");
}

TEST(CgnsRefusal, WritesWholeFilesOrNone) {
  const TemporaryFolder folder;
  MultiblockMesh<2> mesh = ring(8, 3, std::string(33, 'x'));
  expect_contains(message_of([&] { write_cgns(mesh, folder / "mesh.cgns"); }),
                  "CGNS takes 1 to 32 characters");
  mesh = row_of_blocks<2>(2, {2, 2});
  mesh.zones[1].name = mesh.zones[0].name;
  expect_contains(message_of([&] { write_cgns(mesh, folder / "mesh.cgns"); }),
                  "the name 'block-1' is used twice");
  EXPECT_EQ(folder.file_count(), 0U);
  std::ofstream(folder / "file") << "x";
  expect_contains(message_of([&] { write_cgns(ring(8, 3), folder / "file/mesh.cgns"); }), "file");
}
}  // namespace
}  // namespace wingbeat
