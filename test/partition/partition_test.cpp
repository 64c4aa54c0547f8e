#include "partition/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/io/error.hpp"
#include "core/parallel/comm.hpp"
#include "partition/block_graph.hpp"
#include "partition/block_lookup.hpp"
#include "partition/local_mesh.hpp"
#include "partition/recursive_bisection.hpp"
#include "partition/split_blocks.hpp"
#include "test/partition/lattice_mesh.hpp"
#include "test/partition/lattice_partition.hpp"

namespace wingbeat {
namespace {

// Rank of every cell of the lattice; fails where a cell is owned twice or not at all.
template <int Dim>
std::vector<int> rank_of_cells(const LatticeMesh<Dim>& lattice, const std::vector<SubBlock<Dim>>& blocks) {
  std::vector<int> ranks(lattice.mesh().cell_count(), -1);
  for (const SubBlock<Dim>& block : blocks)
    for_each(block.cells, [&](const Index<Dim>& cell) {
      int& rank = ranks.at(lattice.number(lattice.lattice_cell(block.zone, cell)));
      EXPECT_EQ(rank, -1) << "owned twice";
      rank = block.rank;
    });
  EXPECT_EQ(std::ranges::count(ranks, -1), 0) << "cells without owner";
  return ranks;
}

std::size_t heaviest(const std::vector<int>& rank_of, int ranks) {
  std::vector<std::size_t> cells(ranks, 0);
  for (const int rank : rank_of) ++cells.at(rank);
  const auto [least, most] = std::ranges::minmax(cells);
  EXPECT_GT(least, 0u) << "a rank without cells";
  return most;
}

TEST(Partition, OneRankKeepsTheZonesWhole) {
  const LatticeMesh<2> lattice = turned_ring();
  const Partition<2> partition = partition_mesh(lattice.mesh(), 1, {});
  ASSERT_EQ(partition.blocks.size(), 5u);
  for (int z = 0; z < 5; ++z) EXPECT_EQ(partition.blocks[z].cells, box_of<2>(lattice.mesh().zones[z].cells));
}

TEST(Partition, TwoRanksHalveAnOMesh) {
  const LatticeMesh<2> lattice = single_ring(250, 50);
  const Partition<2> partition = partition_mesh(lattice.mesh(), 2, {});
  ASSERT_EQ(partition.blocks.size(), 2u);
  for (const SubBlock<2>& block : partition.blocks) {
    EXPECT_EQ(block.cells.extent(0), 125);
    EXPECT_EQ(block.cells.extent(1), 50);
  }
  EXPECT_EQ(partition_statistics(lattice.mesh(), partition, 3).edge_cut, 100u);
}

// Zones listed in an order that says nothing of where they lie: only the graph knows.
TEST(Partition, ZonesInAnyOrderAreGroupedByTheirConnections) {
  std::vector<LatticeZone<2>> zones;
  for (int n = 0; n < 16; ++n) {
    const int place = n * 7 % 16, i = place % 4, j = place / 4;
    zones.push_back({{{8 * i, 8 * j}, {8 * i + 8, 8 * j + 8}}, {{0, 1}, {1, 1}}});
  }
  const LatticeMesh<2> lattice({32, 32}, false, zones);
  const Partition<2> partition = partition_mesh(lattice.mesh(), 4, {});
  const auto statistics = partition_statistics(lattice.mesh(), partition, 1);
  EXPECT_EQ(statistics.imbalance, 0.0);
  // Four squares of 16 x 16 cells cut 64 faces, four strips 96.
  EXPECT_LE(statistics.edge_cut, 96u);
}

// The limit is the imbalance asked for, or one cell above the mean where that is finer.
template <int Dim>
void expect_balanced(const LatticeMesh<Dim>& lattice, int ranks, double imbalance) {
  SCOPED_TRACE(std::to_string(ranks) + " ranks, imbalance " + std::to_string(imbalance));
  const Partition<Dim> partition = partition_mesh(lattice.mesh(), ranks, {imbalance});
  const double mean = static_cast<double>(lattice.mesh().cell_count()) / ranks;
  EXPECT_EQ(partition.ranks, ranks);
  EXPECT_LE(heaviest(rank_of_cells(lattice, partition.blocks), ranks),
            std::max(std::ceil(mean), std::floor(mean * (1.0 + imbalance))));
}

TEST(Partition, MeetsTheImbalanceAskedForDownToOneCell) {
  if (Comm().size() > 1) GTEST_SKIP() << "serial";
  for (const double imbalance : {0.0, 0.02, 0.05, 0.5})
    for (const int ranks : {2, 3, 5, 7, 13, 60, 149, 180}) {
      expect_balanced(turned_ring(), ranks, imbalance);
      expect_balanced(turned_box(), ranks, imbalance);
      expect_balanced(turned_shell(), ranks, imbalance);
      expect_balanced(single_ring(36, 5), ranks, imbalance);
    }
}

TEST(Partition, RecursiveBisectionIsBalancedToOneCell) {
  const LatticeMesh<3> lattice = turned_box();
  const std::size_t cells = lattice.mesh().cell_count();
  for (int ranks = 1; ranks <= static_cast<int>(cells); ranks += 7) {
    const std::size_t limit = (cells + ranks - 1) / ranks;
    EXPECT_EQ(heaviest(rank_of_cells(lattice, bisect_recursively(lattice.mesh(), ranks, limit)), ranks),
              limit);
  }
  EXPECT_THROW(bisect_recursively(lattice.mesh(), 2, cells / 2 - 1), InternalError);
}

TEST(Partition, IsRepeatable) {
  const LatticeMesh<3> lattice = turned_shell();
  const auto blocks = [&] {
    std::vector<std::tuple<int, Index<3>, Index<3>, int>> list;
    for (const auto& [zone, cells, rank] : partition_mesh(lattice.mesh(), 6, {}).blocks)
      list.emplace_back(zone, cells.begin, cells.end, rank);
    return list;
  };
  EXPECT_EQ(blocks(), blocks());
}

TEST(Partition, RefusesMoreRanksThanCells) {
  const LatticeMesh<2> lattice = single_ring(6, 2);
  EXPECT_EQ(partition_mesh(lattice.mesh(), 12, {}).blocks.size(), 12u);
  try {
    partition_mesh(lattice.mesh(), 13, {});
    FAIL() << "13 ranks for 12 cells";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("13 ranks"), std::string::npos) << message;
    EXPECT_NE(message.find("12 cells"), std::string::npos) << message;
  }
  EXPECT_THROW(partition_mesh(lattice.mesh(), 0, {}), InputError);
  EXPECT_THROW(partition_mesh(lattice.mesh(), 2, {-0.1}), InputError);
  EXPECT_THROW(partition_mesh(lattice.mesh(), 2, {std::nan("")}), InputError);
}

// Counted cell by cell on the lattice, without blocks or interfaces.
template <int Dim>
void compare_with_brute_force(const LatticeMesh<Dim>& lattice, const Partition<Dim>& partition) {
  const std::vector<int> rank_of = rank_of_cells(lattice, partition.blocks);
  const auto rank_at = [&](Index<Dim> cell) {
    return lattice.wrap(cell) ? rank_of[lattice.number(cell)] : -1;
  };
  std::size_t cut = 0;
  for_each(box_of<Dim>(lattice.cells()), [&](const Index<Dim>& cell) {
    for (int d = 0; d < Dim; ++d) {
      Index<Dim> next = cell;
      ++next[d];
      if (rank_at(next) >= 0 && rank_at(next) != rank_at(cell)) ++cut;
    }
  });
  // A halo cell lies one or two cells straight across a side of a block.
  std::set<std::pair<int, long>> halo;
  for (const SubBlock<Dim>& block : partition.blocks)
    for_each(grown(block.cells, halo_layers), [&](const Index<Dim>& cell) {
      int outside = 0;
      for (int d = 0; d < Dim; ++d)
        outside += cell[d] < block.cells.begin[d] || cell[d] >= block.cells.end[d];
      Index<Dim> place = lattice.lattice_cell(block.zone, cell);
      if (outside != 1 || !lattice.wrap(place) || rank_at(place) == block.rank) return;
      halo.emplace(block.rank, lattice.number(place));
    });

  const PartitionStatistics statistics = partition_statistics(lattice.mesh(), partition, 3);
  EXPECT_EQ(statistics.ranks, partition.ranks);
  EXPECT_EQ(statistics.blocks, partition.blocks.size());
  EXPECT_EQ(statistics.edge_cut, cut);
  EXPECT_EQ(statistics.halo_cells, halo.size());
  EXPECT_EQ(statistics.halo_bytes, halo.size() * 3 * (Dim + 2) * 8);
  const double mean = static_cast<double>(rank_of.size()) / partition.ranks;
  EXPECT_DOUBLE_EQ(statistics.imbalance,
                   static_cast<double>(heaviest(rank_of, partition.ranks)) / mean - 1.0);

  std::size_t ghosts = 0;
  for (int rank = 0; rank < partition.ranks; ++rank)
    ghosts += build_local_mesh(lattice.mesh(), partition, rank).ghosts.size();
  EXPECT_EQ(statistics.halo_cells, ghosts);
}

TEST(PartitionStatistics, AgreeWithBruteForceAndWithTheGhostsBuilt) {
  for (const int ranks : {1, 2, 3, 6}) {
    SCOPED_TRACE(ranks);
    compare_with_brute_force(turned_ring(), random_partition(turned_ring().mesh(), ranks, 40 + ranks));
    compare_with_brute_force(turned_box(), random_partition(turned_box().mesh(), ranks, 50 + ranks));
    compare_with_brute_force(turned_shell(), partition_mesh(turned_shell().mesh(), ranks, {}));
    compare_with_brute_force(single_ring(30, 7), partition_mesh(single_ring(30, 7).mesh(), ranks, {}));
  }
}

TEST(PartitionStatistics, OneRankSendsNothing) {
  const LatticeMesh<2> lattice = turned_ring();
  const auto statistics = partition_statistics(lattice.mesh(), partition_mesh(lattice.mesh(), 1, {}), 3);
  EXPECT_EQ(statistics.edge_cut, 0u);
  EXPECT_EQ(statistics.halo_cells, 0u);
  EXPECT_EQ(statistics.imbalance, 0.0);
}

// 64 cells a rank: 8 x 8 squares cut 2 x 262144 / 8 faces, less the two outer boundaries.
TEST(PartitionStatistics, ThousandsOfRanksAreCompact) {
  if (Comm().size() > 1) GTEST_SKIP() << "serial";
  const LatticeMesh<2> lattice = single_ring(1024, 256);
  const Partition<2> partition = partition_mesh(lattice.mesh(), 4096, {});
  const auto statistics = partition_statistics(lattice.mesh(), partition, 3);
  EXPECT_LE(statistics.imbalance, 0.05);
  EXPECT_LE(statistics.edge_cut, 65536u - 1024u);
  EXPECT_EQ(heaviest(rank_of_cells(lattice, partition.blocks), 4096), 64u);
}

TEST(BlockLookup, FindsTheBlockOfEveryCell) {
  const LatticeMesh<3> lattice = turned_box();
  const Partition<3> partition = random_partition(lattice.mesh(), 9, 77);
  const BlockLookup<3> lookup(static_cast<int>(lattice.mesh().zones.size()), partition.blocks);
  for (std::size_t b = 0; b < partition.blocks.size(); ++b)
    for_each(partition.blocks[b].cells, [&](const Index<3>& cell) {
      ASSERT_EQ(lookup.find(partition.blocks[b].zone, cell), static_cast<int>(b));
    });
  EXPECT_THROW(lookup.find(0, {-1, 0, 0}), InternalError);
}

TEST(BlockGraph, IsSymmetricAndCountsFaces) {
  const LatticeMesh<2> lattice = turned_ring();
  const Partition<2> partition = random_partition(lattice.mesh(), 8, 3);
  const BlockGraph graph = build_block_graph<2>(lattice.mesh(), partition.blocks);
  std::map<std::pair<int, int>, int> faces;
  for (int v = 0; v < std::ssize(graph.weights); ++v) {
    EXPECT_EQ(graph.weights[v], static_cast<int>(partition.blocks[v].cells.size()));
    for (int e = graph.starts[v]; e < graph.starts[v + 1]; ++e) {
      EXPECT_NE(graph.neighbours[e], v);
      EXPECT_TRUE(faces.emplace(std::pair(v, graph.neighbours[e]), graph.faces[e]).second);
    }
  }
  for (const auto& [edge, count] : faces) EXPECT_EQ(faces.at({edge.second, edge.first}), count);
  std::vector<int> ranks;
  for (const SubBlock<2>& block : partition.blocks) ranks.push_back(block.rank);
  EXPECT_EQ(edge_cut(graph, ranks), partition_statistics(lattice.mesh(), partition, 1).edge_cut);
}

TEST(SplitBlocks, CutsPreferExactThenEvenPlanes) {
  EXPECT_EQ(cut_plane(0, 250, 0.5), 125);
  EXPECT_EQ(cut_plane(0, 125, 0.5), 62);
  EXPECT_EQ(cut_plane(0, 127, 0.5), 64);
  EXPECT_EQ(cut_plane(1, 3, 0.01), 2);
  EXPECT_EQ(cut_plane(0, 3, 0.99), 2);
}

TEST(SplitBlocks, MergingJoinsWhatFormsABoxAndNothingElse) {
  const std::vector<SubBlock<2>> blocks{
      {0, {{2, 2}, {4, 4}}, 1}, {0, {{0, 0}, {2, 2}}, 1}, {0, {{0, 2}, {2, 4}}, 1}, {0, {{2, 0}, {4, 2}}, 1},
      {0, {{4, 0}, {6, 3}}, 1}, {0, {{4, 3}, {6, 4}}, 0}, {1, {{0, 0}, {2, 2}}, 0}, {1, {{2, 0}, {4, 2}}, 0}};
  const auto merged = merge_blocks(blocks);
  ASSERT_EQ(merged.size(), 4u);
  EXPECT_EQ(merged[0].cells, (Box<2>{{4, 3}, {6, 4}}));
  EXPECT_EQ(merged[1].cells, (Box<2>{{0, 0}, {4, 2}}));
  EXPECT_EQ(merged[2].cells, (Box<2>{{0, 0}, {4, 4}}));
  EXPECT_EQ(merged[3].cells, (Box<2>{{4, 0}, {6, 3}}));
}

}  // namespace
}  // namespace wingbeat
