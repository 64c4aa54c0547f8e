#include "adjoint/section_wall.hpp"

#include <gtest/gtest.h>

#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/cut_blocks.hpp"
#include "core/mesh/find_interfaces.hpp"
#include "test/adjoint/section_meshes.hpp"
#include "test/core/mesh/example_meshes.hpp"
#include "test/core/mesh/message.hpp"
#include "test/partition/lattice_mesh.hpp"

namespace wingbeat {
namespace {

TEST(SectionWall, RunsFromTheLowerTrailingEdgeOverTheNoseToTheUpperOne) {
  for (const int blocks : {1, 5}) {
    const SectionMesh m("naca2412", 64, 16, blocks);
    ASSERT_EQ(m.wall.size(), 64U);
    EXPECT_NEAR(m.wall.positions[0][0], 1.0, 1e-3);
    EXPECT_LT(m.wall.positions[8][1], 0.0);
    EXPECT_GT(m.wall.positions[56][1], 0.0);
    EXPECT_NEAR(m.wall.chord(), 1.0, 1e-3);
    for (std::size_t w = 1; w < m.wall.size(); ++w) EXPECT_GT(m.wall.s[w], m.wall.s[w - 1]);
    EXPECT_EQ(m.wall.s[0], 0.0);
    EXPECT_LT(m.wall.s.back(), 1.0);
  }
}

TEST(SectionWall, MirroredNodesOfASymmetricSectionHaveMirroredParameters) {
  for (const int around : {250, 251, 64}) {
    const SectionMesh m("naca64a010", around, 8);
    const std::size_t n = m.wall.size();
    for (std::size_t w = 1; w < n; ++w) {
      EXPECT_NEAR(m.wall.s[w] + m.wall.s[n - w], 1.0, 1e-13);
      EXPECT_NEAR(m.wall.normals[w][0], m.wall.normals[n - w][0], 1e-11);
      EXPECT_NEAR(m.wall.normals[w][1], -m.wall.normals[n - w][1], 1e-11);
    }
    if (around % 2 == 0) {
      EXPECT_EQ(m.wall.s[n / 2], 0.5);
    }
  }
}

TEST(SectionWall, NormalsPointOutOfTheSectionAndAreasAddUpToTheWall) {
  const SectionMesh m("naca0012", 128, 8);
  const Airfoil airfoil = make_airfoil("naca0012");
  double area = 0.0, faces = 0.0;
  for (std::size_t w = 0; w < m.wall.size(); ++w) {
    EXPECT_NEAR(norm(m.wall.normals[w]), 1.0, 1e-14);
    if (w > 0) {
      EXPECT_GT(dot(m.wall.normals[w], airfoil.outward_normal(m.wall.s[w])), 0.99);
    }
    area += m.wall.areas[w];
    faces += norm(m.wall.positions[(w + 1) % m.wall.size()] - m.wall.positions[w]);
  }
  EXPECT_NEAR(area, faces, 1e-13);
  EXPECT_NEAR(m.wall.normals[0][0], 1.0, 1e-13) << "downstream, along the bisector of the trailing edge";
}

TEST(SectionWall, ParameterIsThatOfTheSectionItself) {
  const SectionMesh m("naca2412", 512, 8);
  const Airfoil airfoil = make_airfoil("naca2412");
  for (std::size_t w = 1; w < m.wall.size(); w += 16)
    EXPECT_LT(norm(airfoil.point(m.wall.s[w]) - m.wall.positions[w]), 3e-3);
}

TEST(SectionWall, IsTheSameBitForBitHoweverTheMeshIsCut) {
  const MultiblockMesh<2> file = mesh_of_file("naca64a010_250x50.x");
  for (const auto& [whole, cut] :
       {std::pair(SectionMesh("naca0012", 96, 16), SectionMesh("naca0012", 96, 16, 5)),
        std::pair(SectionMesh(file), SectionMesh(cut_blocks(file, 7)))}) {
    EXPECT_EQ(whole.wall.positions, cut.wall.positions);
    EXPECT_EQ(whole.wall.normals, cut.wall.normals);
    EXPECT_EQ(whole.wall.areas, cut.wall.areas);
    EXPECT_EQ(whole.wall.s, cut.wall.s);
    const auto positions = unique_positions(cut.mesh, cut.numbers);
    for (std::size_t w = 0; w < cut.wall.size(); ++w)
      EXPECT_EQ(positions[cut.wall.nodes[w]], cut.wall.positions[w]);
  }
}

TEST(SectionWall, ReadsMeshesOfFiles) {
  for (const std::string name : {"naca0012_128x32.x", "naca64a010_250x50.x"}) {
    const SectionMesh m(mesh_of_file(name));
    const std::size_t n = m.wall.size();
    EXPECT_EQ(n, name == "naca0012_128x32.x" ? 128U : 250U);
    EXPECT_NEAR(m.wall.positions[0][0], 1.0, 1e-6);
    for (std::size_t w = 1; w < n; ++w) EXPECT_NEAR(m.wall.s[w] + m.wall.s[n - w], 1.0, 1e-7);
    EXPECT_LT(m.wall.positions[n / 4][1], 0.0);
  }
}

TEST(SectionWall, FollowsZonesOfAnyOrientation) {
  const LatticeMesh<2> lattice = turned_ring();
  const SectionMesh m(lattice.mesh());
  ASSERT_EQ(m.wall.size(), 20U);
  EXPECT_EQ(m.wall.positions[0], lattice.position({0, 0})) << "a circle: the node farthest downstream";
  for (int w = 0; w < 20; ++w) {
    EXPECT_EQ(m.wall.positions[w], lattice.position({w, 0}));
    EXPECT_NEAR(m.wall.s[w], w / 20.0, 1e-14);
    if (w > 0) {
      EXPECT_NEAR(dot(m.wall.normals[w], m.wall.positions[w]), norm(m.wall.positions[w]), 1e-13);
    }
  }
}

TEST(SectionWall, RefusesAnythingButOneClosedCurve) {
  MultiblockMesh<2> two = example::ring(12, 4);
  two.zones.push_back(example::ring(16, 4).zones.front());
  for (Interface<2>& cut : two.zones[1].interfaces) cut.donor = 1;
  example::expect_contains(example::message_of([&] { SectionMesh{two}; }),
                           "2 bodies, with 12, 16 wall faces");

  example::expect_contains(example::message_of([] {
                             SectionMesh{example::row_of_blocks<2>(2, {5, 4})};
                           }),
                           "it is open");

  MultiblockMesh<2> bare = example::ring(12, 4);
  bare.zones[0].patches[0].type = BoundaryType::farfield;
  example::expect_contains(example::message_of([&] { SectionMesh{bare}; }), "no slip wall");

  MultiblockMesh<2> channel = example::ring(12, 4);
  std::swap(channel.zones[0].patches[0].type, channel.zones[0].patches[1].type);
  example::expect_contains(example::message_of([&] { SectionMesh{channel}; }), "encloses the fluid");
}

}  // namespace
}  // namespace wingbeat
