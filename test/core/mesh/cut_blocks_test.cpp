#include "core/mesh/cut_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/io/error.hpp"
#include "core/mesh/coarsen.hpp"
#include "core/mesh/conformal_omesh.hpp"
#include "core/mesh/cut_box.hpp"
#include "core/mesh/mesh_check.hpp"

namespace wingbeat {
namespace {

template <int Dim>
using Corners = std::vector<std::array<double, Dim>>;

// Every cell's corner coordinates, sorted: the mesh without its division into zones.
template <int Dim>
std::vector<Corners<Dim>> cells_of(const MultiblockMesh<Dim>& mesh) {
  std::vector<Corners<Dim>> cells;
  for (const auto& zone : mesh.zones)
    for_each(box_of<Dim>(zone.cells), [&](const Index<Dim>& cell) {
      Box<Dim> corners{cell, cell};
      for (int d = 0; d < Dim; ++d) corners.end[d] += 2;
      cells.emplace_back();
      for_each(corners,
               [&](const Index<Dim>& index) { cells.back().push_back(zone.nodes(index).components); });
    });
  std::sort(cells.begin(), cells.end());
  return cells;
}

// Cells along each patch name.
template <int Dim>
std::map<std::string, std::size_t> patch_sizes(const MultiblockMesh<Dim>& mesh) {
  std::map<std::string, std::size_t> sizes;
  for (const auto& zone : mesh.zones)
    for (const auto& patch : zone.patches) sizes[patch.name] += patch.cells.size();
  return sizes;
}

TEST(CutBlocks, OmeshIsTheSameBitForBitInAnyNumberOfBlocks) {
  const Airfoil airfoil = make_airfoil("naca2412");
  const OmeshOptions whole{.around = 37, .normal = 11};
  const auto reference = conformal_omesh(airfoil, whole);
  EXPECT_EQ(reference.zones.front().name, "block-1");
  for (const int blocks : {1, 2, 3, 4, 5, 7, 16, 37, 38, 64, 101, 407}) {
    OmeshOptions options = whole;
    options.blocks = blocks;
    const auto mesh = conformal_omesh(airfoil, options);
    ASSERT_EQ(mesh.zones.size(), static_cast<std::size_t>(blocks));
    EXPECT_EQ(mesh.zones.back().name, "block-" + std::to_string(blocks));
    EXPECT_EQ(cells_of(mesh), cells_of(reference)) << blocks << " blocks";
    EXPECT_EQ(patch_sizes(mesh), patch_sizes(reference)) << blocks << " blocks";
    EXPECT_EQ(mesh_faults(mesh), std::vector<std::string>{}) << blocks << " blocks";
  }
}

TEST(CutBlocks, PiecesAroundAreAsEqualAsPossible) {
  for (const int count : {2, 3, 5, 8, 12}) {
    const auto boxes = cut_box<2>({{0, 0}, {250, 50}}, count);
    int narrowest = 250, widest = 0;
    for (const auto& box : boxes) {
      EXPECT_EQ(box.extent(1), 50);
      narrowest = std::min(narrowest, box.extent(0));
      widest = std::max(widest, box.extent(0));
    }
    EXPECT_LE(widest - narrowest, 1) << count << " pieces";
  }
}

TEST(CutBlocks, PiecesKeepTheirMinimumWidthAsFarAsTheyFit) {
  for (int count = 1; count <= 20; ++count) {
    std::size_t cells = 0;
    for (const auto& box : cut_box<2>({{3, 5}, {18, 21}}, count, 3)) {
      EXPECT_GE(box.extent(0), 3);
      EXPECT_GE(box.extent(1), 3);
      cells += box.size();
    }
    EXPECT_EQ(cells, 15u * 16u);
  }
  EXPECT_THROW(cut_box<2>({{0, 0}, {15, 16}}, 26, 3), InputError);
}

// Levels of every second node that a mesh allows.
int levels(MultiblockMesh<2> mesh) {
  int count = 0;
  for (; auto coarse = coarsened(mesh, 1); ++count) mesh = std::move(*coarse);
  return count;
}

TEST(CutBlocks, PiecesCanBeHalvedWhereFivePercentOfUnevennessAllowIt) {
  const auto omesh = [](int around, int normal, int blocks) {
    return conformal_omesh(make_airfoil("naca0012"), {.around = around, .normal = normal, .blocks = blocks});
  };
  EXPECT_EQ(levels(omesh(250, 50, 1)), 1);
  const auto halves = omesh(250, 50, 2);  // 125 is odd
  EXPECT_EQ(halves.zones[0].cells[0] + halves.zones[1].cells[0], 250);
  EXPECT_EQ(std::abs(halves.zones[0].cells[0] - halves.zones[1].cells[0]), 2);
  EXPECT_EQ(levels(halves), 1);
  EXPECT_EQ(levels(omesh(256, 64, 4)), 6);  // squares of 64
  EXPECT_EQ(levels(omesh(256, 64, 3)), 3);  // 80 + 88 + 88; 80 + 80 + 96 is too uneven
  // Pieces of two and of one column in eight: a cut at even planes is too uneven.
  EXPECT_EQ(levels(omesh(40, 8, 16)), 0);
}

TEST(CutBlocks, PiecesForMultigridKeepTheMinimumWidth) {
  const auto mesh = conformal_omesh(make_airfoil("naca0012"), {.around = 64, .normal = 16});
  for (const int width : {1, 3, 5, 8}) {
    for (const auto& zone : cut_blocks(mesh, 8, width).zones) {
      EXPECT_GE(zone.cells[0], width);
      EXPECT_GE(zone.cells[1], width);
    }
  }
}

// Nodes at integer coordinates of a box of `cells` cells; index d of the zone runs along
// coordinate axis[d], backwards where sign[d] < 0.
Zone<3> brick(const std::string& name, const Index<3>& cells, const Index<3>& axis, const Index<3>& sign,
              const Vec<double, 3>& corner) {
  Zone<3> zone;
  zone.name = name;
  zone.cells = cells;
  zone.nodes = BlockArray<Vec<double, 3>, 3>({cells[0] + 1, cells[1] + 1, cells[2] + 1}, 0);
  for_each(zone.nodes.interior(), [&](const Index<3>& index) {
    Vec<double, 3> p = corner;
    for (int d = 0; d < 3; ++d) p[axis[d]] += sign[d] > 0 ? index[d] : cells[d] - index[d];
    zone.nodes(index) = p;
  });
  return zone;
}

void close_with_farfield(Zone<3>& zone, const Side& open) {
  for (int d = 0; d < 3; ++d)
    for (int end = 0; end < 2; ++end) {
      if (open == Side{d, end}) continue;
      Box<3> cells = box_of<3>(zone.cells);
      (end == 0 ? cells.end[d] : cells.begin[d]) = end == 0 ? 1 : zone.cells[d] - 1;
      zone.patches.push_back({"outer", "outer", BoundaryType::farfield, {d, end}, cells});
    }
}

// Two bricks that meet at x = 4. The second is turned: its i is z, its j is -x, its k is -y.
MultiblockMesh<3> turned_bricks() {
  MultiblockMesh<3> mesh;
  mesh.zones = {brick("left", {4, 6, 5}, {0, 1, 2}, {1, 1, 1}, {{0, 0, 0}}),
                brick("right", {5, 3, 6}, {2, 0, 1}, {1, -1, -1}, {{4, 0, 0}})};
  Interface<3> right_of_left{"meet",    {0, 1},     {{4, 0, 0}, {5, 7, 6}}, 1, {1, 1}, {0, 3, 6},
                             {1, 2, 0}, {-1, -1, 1}};
  Interface<3> left_of_right{"meet",    {1, 1},     {{0, 3, 0}, {6, 4, 7}}, 0, {0, 1}, {4, 6, 0},
                             {2, 0, 1}, {1, -1, -1}};
  mesh.zones[0].interfaces = {right_of_left};
  mesh.zones[1].interfaces = {left_of_right};
  close_with_farfield(mesh.zones[0], {0, 1});
  close_with_farfield(mesh.zones[1], {1, 1});
  return mesh;
}

TEST(CutBlocks, InterfacesOfAnyOrientationAreDivided) {
  const auto mesh = turned_bricks();
  ASSERT_EQ(mesh_faults(mesh), std::vector<std::string>{});
  for (const int count : {2, 3, 5, 8, 13, 30, 60}) {
    const auto cut = cut_blocks(mesh, count);
    ASSERT_EQ(cut.zones.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(mesh_faults(cut), std::vector<std::string>{}) << count << " blocks";
    EXPECT_EQ(cells_of(cut), cells_of(mesh)) << count << " blocks";
    EXPECT_EQ(patch_sizes(cut), patch_sizes(mesh)) << count << " blocks";
  }
}

TEST(CutBlocks, WholeZonesKeepTheirNamesAndFewerBlocksAreRefused) {
  const auto mesh = turned_bricks();
  EXPECT_EQ(cut_blocks(mesh, 2).zones[1].name, "right");
  EXPECT_EQ(cut_blocks(mesh, 3).zones[0].name, "left-1");
  EXPECT_THROW(cut_blocks(mesh, 1), InputError);
  EXPECT_THROW(cut_blocks(mesh, 211), InputError);
}

}  // namespace
}  // namespace wingbeat
