#include "partition/coarsening.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

#include "core/io/error.hpp"
#include "core/mesh/mesh_check.hpp"
#include "partition/local_mesh.hpp"
#include "test/partition/doubled_lattice.hpp"

namespace wingbeat {
namespace {

template <int Dim>
Partition<Dim> whole(const MultiblockMesh<Dim>& mesh) {
  return partition_mesh(mesh, 1, {});
}

// The text of a limit; fails where one of the words is missing.
void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

template <int Dim>
void expect_same_topology(const Zone<Dim>& a, const Zone<Dim>& b) {
  EXPECT_EQ(a.cells, b.cells);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t p = 0; p < a.patches.size(); ++p) {
    EXPECT_EQ(a.patches[p].side, b.patches[p].side);
    EXPECT_EQ(a.patches[p].cells, b.patches[p].cells);
  }
  ASSERT_EQ(a.interfaces.size(), b.interfaces.size());
  for (std::size_t i = 0; i < a.interfaces.size(); ++i) {
    EXPECT_EQ(a.interfaces[i].nodes, b.interfaces[i].nodes);
    EXPECT_EQ(a.interfaces[i].donor_origin, b.interfaces[i].donor_origin);
    EXPECT_EQ(a.interfaces[i].axis, b.interfaces[i].axis);
    EXPECT_EQ(a.interfaces[i].sign, b.interfaces[i].sign);
  }
}

template <int Dim>
void expect_every_second_node(const DoubledLattice<Dim>& lattice) {
  const auto& fine = lattice.fine.mesh();
  const auto grid = coarsened(fine, whole(fine), 1);
  ASSERT_TRUE(grid);
  EXPECT_EQ(mesh_faults(grid->mesh), std::vector<std::string>{});
  for (std::size_t z = 0; z < fine.zones.size(); ++z) {
    expect_same_topology(grid->mesh.zones[z], lattice.coarse.mesh().zones[z]);
    for_each(grid->mesh.zones[z].nodes.interior(), [&](const Index<Dim>& node) {
      EXPECT_EQ(grid->mesh.zones[z].nodes(node).components,
                fine.zones[z].nodes(lattice.doubled(node)).components);
    });
  }
}

TEST(Coarsening, TakesEverySecondNodeInZonesOfAnyOrientation) {
  expect_every_second_node(doubled_ring());
  expect_every_second_node(doubled_shell());
  expect_every_second_node(doubled_box());
}

template <int Dim>
void expect_cells_on_the_same_rank(const DoubledLattice<Dim>& lattice, int ranks, unsigned seed) {
  const auto& fine = lattice.fine.mesh();
  const auto partition =
      refined(random_partition(lattice.coarse.mesh(), ranks, seed), lattice.coarse.mesh(), fine);
  const auto grid = coarsened(fine, partition, 1);
  ASSERT_TRUE(grid);
  for (int rank = 0; rank < ranks; ++rank) {
    const auto part = build_local_mesh(fine, partition, rank);
    const auto coarse = build_local_mesh(grid->mesh, grid->partition, rank);
    ASSERT_EQ(part.blocks.size(), coarse.blocks.size());
    EXPECT_EQ(static_cast<std::size_t>(part.owned_count),
              static_cast<std::size_t>(coarse.owned_count) * (1u << Dim));
    for (std::size_t b = 0; b < part.blocks.size(); ++b) {
      ASSERT_EQ(part.blocks[b].zone, coarse.blocks[b].zone);
      for_each(part.blocks[b].zone_cells, [&](const Index<Dim>& cell) {
        EXPECT_TRUE(coarse.blocks[b].zone_cells.contains(lattice.halved(cell)));
      });
    }
  }
}

TEST(Coarsening, KeepsEveryCellOnItsRankAndInItsBlock) {
  for (const int ranks : {1, 3, 5}) {
    expect_cells_on_the_same_rank(doubled_ring(), ranks, 11);
    expect_cells_on_the_same_rank(doubled_shell(), ranks, 12);
    expect_cells_on_the_same_rank(doubled_box(), ranks, 13);
  }
}

TEST(Coarsening, CountsLevelsAndSaysWhatLimitsThem) {
  const auto levels = [](int around, int outwards, int least) {
    const auto mesh = single_ring(around, outwards).mesh();
    return coarsening_levels(mesh, whole(mesh), least);
  };
  EXPECT_EQ(levels(48, 16, 2), 3);  // 6 x 2
  EXPECT_EQ(levels(48, 16, 1), 4);  // 3 x 1: a single cell outwards
  EXPECT_EQ(levels(48, 16, 4), 2);
  EXPECT_EQ(levels(250, 50, 2), 1);
  EXPECT_EQ(levels(249, 50, 2), 0);

  const auto odd = single_ring(250, 50).mesh();
  expect_words(describe_limit(odd, whole(odd)), {"halved once", "zone-0", "125 x 25", "125 is odd"});
  const auto small = single_ring(48, 16).mesh();
  expect_words(describe_limit(small, whole(small)), {"3 times", "6 x 2", "half of 2 is less than 2"});
  const auto turned = turned_ring().mesh();
  EXPECT_EQ(coarsening_levels(turned, whole(turned)), 0);
  expect_words(describe_limit(turned, whole(turned)), {"zone-0", "7 x 9", "7 is odd"});
}

TEST(Coarsening, NamesTheCutOfThePartitionThatLimitsIt) {
  const auto mesh = single_ring(48, 16).mesh();
  const Partition<2> partition{2, {{0, {{0, 0}, {18, 16}}, 0}, {0, {{18, 0}, {48, 16}}, 1}}};
  EXPECT_EQ(coarsening_levels(mesh, partition), 1);
  expect_words(describe_limit(mesh, partition), {"halved once", "zone-0", "24 x 8", "cut at 9 for rank 0"});
}

TEST(Coarsening, NamesTheEdgeOfAPatchOrAnInterfaceThatLimitsIt) {
  // Two zones side by side and a third along both: an even count of cells, joined at an odd plane.
  const LatticeMesh<2> lattice({8, 4}, false,
                               {{{{0, 0}, {8, 2}}, {{0, 1}, {1, 1}}},
                                {{{0, 2}, {6, 4}}, {{0, 1}, {1, 1}}},
                                {{{6, 2}, {8, 4}}, {{0, 1}, {1, 1}}}});
  EXPECT_EQ(coarsening_levels(lattice.mesh(), whole(lattice.mesh()), 1), 1);
  auto mesh = single_ring(16, 8).mesh();
  auto rest = mesh.zones[0].patches[0];
  mesh.zones[0].patches[0].cells.end[0] = rest.cells.begin[0] = 7;
  mesh.zones[0].patches.push_back(rest);
  EXPECT_FALSE(coarsened(mesh, whole(mesh)));
  expect_words(describe_limit(mesh, whole(mesh)), {"patch", "zone-0", "7, which is odd"});
  const LatticeMesh<2> shifted({8, 4}, false,
                               {{{{0, 0}, {8, 2}}, {{0, 1}, {1, 1}}},
                                {{{0, 2}, {1, 4}}, {{0, 1}, {1, 1}}},
                                {{{1, 2}, {5, 4}}, {{0, 1}, {1, 1}}},
                                {{{5, 2}, {8, 4}}, {{0, 1}, {1, 1}}}});
  EXPECT_FALSE(coarsened(shifted.mesh(), whole(shifted.mesh()), 1));
  expect_words(describe_limit(shifted.mesh(), whole(shifted.mesh()), 1), {"interface", "1, which is odd"});
}

TEST(Coarsening, ADirectionOfASingleCellIsLeftAsItIs) {
  const LatticeMesh<3> lattice({16, 8, 1}, false, {{{{0, 0, 0}, {16, 8, 1}}, {{0, 1, 2}, {1, 1, 1}}}});
  const auto partition = partition_mesh(lattice.mesh(), 4, {.granularity = 4});
  EXPECT_EQ(coarsening_levels(lattice.mesh(), partition), 2);
  const auto grid = coarsened(lattice.mesh(), partition);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->mesh.zones[0].cells, (Index<3>{8, 4, 1}));
  EXPECT_EQ(mesh_faults(grid->mesh), std::vector<std::string>{});
}

TEST(Coarsening, EndsAtASingleCell) {
  const LatticeMesh<2> lattice({4, 4}, false, {{{{0, 0}, {4, 4}}, {{0, 1}, {1, 1}}}});
  EXPECT_EQ(coarsening_levels(lattice.mesh(), whole(lattice.mesh()), 1), 2);
  expect_words(describe_limit(lattice.mesh(), whole(lattice.mesh()), 1), {"single cell"});
}

TEST(Granularity, CutsAtItsMultiplesWithinTheImbalance) {
  const auto check = [](const auto& lattice, int ranks, int granularity) {
    SCOPED_TRACE(std::to_string(ranks) + " ranks");
    const auto& mesh = lattice.mesh();
    const auto partition = partition_mesh(mesh, ranks, {.imbalance = 0.05, .granularity = granularity});
    for (const auto& block : partition.blocks)
      for (const auto& planes : {block.cells.begin, block.cells.end})
        for (const int plane : planes) EXPECT_EQ(plane % granularity, 0);
    EXPECT_LE(partition_statistics(mesh, partition, 1).imbalance, 0.05);
    EXPECT_GE(coarsening_levels(mesh, partition, 1), std::countr_zero(static_cast<unsigned>(granularity)));
  };
  for (const int ranks : {2, 3, 4, 6, 7, 16}) check(single_ring(256, 64), ranks, 4);
  for (const int ranks : {2, 4, 8}) check(single_ring(250, 50), ranks, 2);
  for (const int ranks : {2, 3, 4, 8}) check(doubled_shell().fine, ranks, 2);
}

TEST(Granularity, IsLoweredWhereTheMeshOrTheBalanceAsksForIt) {
  const auto ring = single_ring(250, 50).mesh();
  // 125 x 25 pairs of cells: the granularity is at most 2, whatever is asked for.
  EXPECT_EQ(coarsening_levels(ring, partition_mesh(ring, 2, {.imbalance = 0.05, .granularity = 8})), 1);
  // 3125 of four cells are not shared by two.
  const auto even = partition_mesh(ring, 2, {.imbalance = 0.0, .granularity = 8});
  EXPECT_EQ(partition_statistics(ring, even, 1).imbalance, 0.0);
  EXPECT_EQ(coarsening_levels(ring, even), 0);
  // More ranks than coarse cells.
  const auto small = single_ring(8, 4).mesh();
  EXPECT_EQ(partition_statistics(small, partition_mesh(small, 32, {.granularity = 4}), 1).imbalance, 0.0);
}

TEST(Granularity, MustBeAPowerOfTwo) {
  const auto ring = single_ring(8, 4).mesh();
  for (const int wrong : {0, -2, 3, 6})
    EXPECT_THROW(partition_mesh(ring, 2, {.granularity = wrong}), InternalError);
}

}  // namespace
}  // namespace wingbeat
