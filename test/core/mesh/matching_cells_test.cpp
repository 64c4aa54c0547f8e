#include "core/mesh/matching_cells.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/mesh/cut_blocks.hpp"
#include "test/core/mesh/example_meshes.hpp"

namespace wingbeat {
namespace {

using namespace example;

template <int Dim>
Vec<double, Dim> first_node(const MultiblockMesh<Dim>& mesh, long cell) {
  for (const Zone<Dim>& zone : mesh.zones) {
    const auto box = box_of<Dim>(zone.cells);
    const long count = static_cast<long>(box.size());
    if (cell >= count) {
      cell -= count;
      continue;
    }
    Vec<double, Dim> found{};
    for_each<Dim>(box, [&](const Index<Dim>& index) {
      if (cell-- == 0) found = zone.nodes(index);
    });
    return found;
  }
  return {};
}

TEST(MatchingCells, AreThoseAtTheSamePlaceHoweverTheMeshIsCut) {
  const MultiblockMesh<2> whole = ring(24, 6);
  const MultiblockMesh<2> cut = cut_blocks<2>(whole, 5);
  const auto cells = matching_cells<2>(whole, cut);
  ASSERT_TRUE(cells);
  ASSERT_EQ(cells->size(), whole.cell_count());
  bool is_as_it_was = true;
  for (std::size_t c = 0; c < cells->size(); ++c) {
    EXPECT_EQ(first_node(cut, static_cast<long>(c)), first_node(whole, (*cells)[c]));
    is_as_it_was = is_as_it_was && (*cells)[c] == static_cast<long>(c);
  }
  EXPECT_FALSE(is_as_it_was) << "the cut changes no order: nothing was tested";
  std::vector<long> same(whole.cell_count());
  std::iota(same.begin(), same.end(), 0L);
  EXPECT_EQ(matching_cells<2>(whole, whole), same);
}

TEST(MatchingCells, AreNoneOfAnotherMesh) {
  const MultiblockMesh<2> mesh = ring(24, 6);
  EXPECT_FALSE(matching_cells<2>(mesh, ring(24, 5)));
  EXPECT_FALSE(matching_cells<2>(mesh, ring(12, 12)));
  MultiblockMesh<2> moved = mesh;
  moved.zones[0].nodes({3, 2})[0] += 1e-6;
  EXPECT_FALSE(matching_cells<2>(mesh, moved));
  EXPECT_TRUE(matching_cells<2>(mesh, moved, 1e-5));
  MultiblockMesh<2> rounded = mesh;
  for_each<2>(rounded.zones[0].nodes.interior(),
              [&](const Index<2>& node) { rounded.zones[0].nodes(node)[1] *= 1.0 + 1e-15; });
  EXPECT_TRUE(matching_cells<2>(mesh, rounded));
}

}  // namespace
}  // namespace wingbeat
