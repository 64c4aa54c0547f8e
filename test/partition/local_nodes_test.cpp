#include "partition/local_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "test/partition/lattice_mesh.hpp"
#include "test/partition/lattice_partition.hpp"

namespace wingbeat {
namespace {

// Nodes of the cells that the block knows: its own and those of the first layer that are no corner.
template <int Dim>
BlockArray<char, Dim> nodes_of_known_cells(const LocalBlock<Dim>& block) {
  BlockArray<char, Dim> known(block.nodes.extents(), 1, 0);
  for_each(grown(box_of<Dim>(block.extents), 1), [&](const Index<Dim>& cell) {
    if (block.cell_number(cell) < 0) return;
    Index<Dim> end = cell;
    for (int& e : end) e += 2;
    for_each(Box<Dim>{cell, end}, [&](const Index<Dim>& node) { known(node) = 1; });
  });
  return known;
}

template <int Dim>
void check_all_ranks(const LatticeMesh<Dim>& lattice) {
  const MultiblockMesh<Dim>& mesh = lattice.mesh();
  const NodeNumbers<Dim> numbers = number_nodes(mesh);
  const auto positions = unique_positions(mesh, numbers);
  for (int ranks = 1; ranks <= 5; ++ranks) {
    const Partition<Dim> partition = random_partition(mesh, ranks, 7 + ranks);
    std::vector<char> seen(numbers.count, 0);
    for (int rank = 0; rank < ranks; ++rank) {
      const LocalMesh<Dim> local = build_local_mesh(mesh, partition, rank);
      const LocalNodes<Dim> nodes = build_local_nodes(mesh, numbers, local);
      EXPECT_EQ(std::ranges::adjacent_find(nodes.numbers, std::greater_equal{}), nodes.numbers.end());
      for (const int number : nodes.numbers) seen.at(number) = 1;
      ASSERT_EQ(nodes.blocks.size(), local.blocks.size());
      for (std::size_t b = 0; b < local.blocks.size(); ++b) {
        const LocalBlock<Dim>& block = local.blocks[b];
        const auto known = nodes_of_known_cells(block);
        for_each(grown(block.nodes.interior(), 1), [&](const Index<Dim>& node) {
          const int n = nodes.blocks[b](node);
          ASSERT_EQ(n >= 0, known(node) == 1);
          if (n >= 0) {
            ASSERT_EQ(positions[nodes.numbers.at(n)], block.nodes(node));
          }
        });
      }
    }
    EXPECT_EQ(std::ranges::count(seen, 1), numbers.count) << ranks << " ranks";
  }
}

// Positions of a lattice tell its nodes apart.
TEST(LocalNodes, AreThoseOfTheBlocksAndTheirFirstNeighbours) {
  check_all_ranks(single_ring(17, 5));
  check_all_ranks(turned_ring());
  check_all_ranks(turned_box());
  check_all_ranks(turned_shell());
}

TEST(LocalNodes, AreNoMoreThanTheBlocksUse) {
  const LatticeMesh<2> lattice = turned_ring();
  const Partition<2> partition = random_partition(lattice.mesh(), 3, 2);
  for (int rank = 0; rank < 3; ++rank) {
    const LocalMesh<2> local = build_local_mesh(lattice.mesh(), partition, rank);
    const LocalNodes<2> nodes = build_local_nodes(lattice.mesh(), number_nodes(lattice.mesh()), local);
    std::vector<char> used(nodes.numbers.size(), 0);
    for (const BlockArray<int, 2>& block : nodes.blocks)
      for (const int n : std::span(block.data(), block.size()))
        if (n >= 0) used.at(n) = 1;
    EXPECT_EQ(std::ranges::count(used, 0), 0);
  }
}

}  // namespace
}  // namespace wingbeat
