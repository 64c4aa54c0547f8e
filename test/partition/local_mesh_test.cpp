#include "partition/local_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"
#include "partition/halo_cells.hpp"
#include "test/partition/lattice_mesh.hpp"
#include "test/partition/lattice_partition.hpp"

namespace wingbeat {
namespace {

// All ranks' parts of a lattice mesh, built in one process.
template <int Dim>
struct Parts {
  const LatticeMesh<Dim>& lattice;
  Partition<Dim> partition;
  std::vector<LocalMesh<Dim>> ranks;

  Parts(const LatticeMesh<Dim>& source, const Partition<Dim>& division)
      : lattice(source), partition(division) {
    for (int rank = 0; rank < partition.ranks; ++rank)
      ranks.push_back(build_local_mesh(lattice.mesh(), partition, rank));
  }

  Index<Dim> lattice_cell(const LocalBlock<Dim>& block, Index<Dim> cell) const {
    for (int d = 0; d < Dim; ++d) cell[d] += block.zone_cells.begin[d];
    return lattice.lattice_cell(block.zone, cell);
  }
  Index<Dim> lattice_node(const LocalBlock<Dim>& block, Index<Dim> node) const {
    for (int d = 0; d < Dim; ++d) node[d] += block.zone_cells.begin[d];
    return lattice.lattice_node(block.zone, node);
  }

  // The lattice cell that each owned cell of each rank is.
  std::vector<std::vector<long>> owned_numbers() const {
    std::vector<std::vector<long>> numbers;
    for (const LocalMesh<Dim>& local : ranks) {
      numbers.emplace_back(local.owned_count, -1);
      for (const LocalBlock<Dim>& block : local.blocks)
        for_each(box_of<Dim>(block.extents), [&](const Index<Dim>& cell) {
          numbers.back()[block.cell_number(cell)] = lattice.number(lattice_cell(block, cell));
        });
    }
    return numbers;
  }
};

template <int Dim, class F>
void for_all_partitions(const LatticeMesh<Dim>& lattice, F&& check) {
  for (int ranks = 1; ranks <= 7; ++ranks) {
    SCOPED_TRACE("ranks " + std::to_string(ranks));
    check(Parts<Dim>(lattice, partition_mesh(lattice.mesh(), ranks, {})));
    check(Parts<Dim>(lattice, random_partition(lattice.mesh(), ranks, 3 + ranks)));
  }
}
template <class F>
void for_all_meshes(F&& check) {
  for_all_partitions(single_ring(17, 5), check);
  for_all_partitions(turned_ring(), check);
  for_all_partitions(turned_box(), check);
  for_all_partitions(turned_shell(), check);
}

// How many directions leave the block at this index.
template <int Dim>
int directions_outside(const LocalBlock<Dim>& block, const Index<Dim>& index) {
  int n = 0;
  for (int d = 0; d < Dim; ++d) n += index[d] < 0 || index[d] >= block.extents[d];
  return n;
}

TEST(LocalMesh, EveryCellIsOwnedOnce) {
  for_all_meshes([]<int Dim>(const Parts<Dim>& parts) {
    std::vector<int> owners(parts.lattice.mesh().cell_count(), 0), named(owners.size(), 0);
    for (const auto& numbers : parts.owned_numbers())
      for (const long number : numbers) ++owners.at(number);
    for (const LocalMesh<Dim>& local : parts.ranks) {
      ASSERT_EQ(local.global_cell.size(), static_cast<std::size_t>(local.owned_count));
      for (const long cell : local.global_cell) ++named.at(cell);
    }
    EXPECT_EQ(std::ranges::count(owners, 1), std::ssize(owners));
    EXPECT_EQ(std::ranges::count(named, 1), std::ssize(named));
  });
}

TEST(LocalMesh, CellsFollowEachOtherInTheirBlockAndZone) {
  for_all_meshes([]<int Dim>(const Parts<Dim>& parts) {
    for (const LocalMesh<Dim>& local : parts.ranks) {
      int next = 0;
      for (const LocalBlock<Dim>& block : local.blocks) {
        EXPECT_EQ(block.first_cell, next);
        long zone_start = 0;
        for (int z = 0; z < block.zone; ++z)
          zone_start += static_cast<long>(box_of<Dim>(parts.lattice.mesh().zones[z].cells).size());
        const Index<Dim>& cells = parts.lattice.mesh().zones[block.zone].cells;
        for_each(box_of<Dim>(block.extents), [&](const Index<Dim>& cell) {
          long in_zone = 0;
          for (int d = Dim - 1; d >= 0; --d)
            in_zone = in_zone * cells[d] + block.zone_cells.begin[d] + cell[d];
          ASSERT_EQ(local.global_cell[next], zone_start + in_zone);
          ASSERT_EQ(block.cell_number(cell), next++);
        });
      }
      EXPECT_EQ(local.owned_count, next);
    }
  });
}

// The halo cell at a place of the lattice is the cell that owns this place, through interfaces of
// any orientation, blocks one cell thick and the cut of the ring.
TEST(LocalMesh, HaloCellsAreTheNeighboursInTheLattice) {
  for_all_meshes([]<int Dim>(const Parts<Dim>& parts) {
    const auto owned = parts.owned_numbers();
    for (const LocalMesh<Dim>& local : parts.ranks)
      for (const LocalBlock<Dim>& block : local.blocks)
        for_each(grown(box_of<Dim>(block.extents), halo_layers), [&](const Index<Dim>& index) {
          const int number = block.cell_number(index);
          Index<Dim> place = parts.lattice_cell(block, index);
          if (directions_outside<Dim>(block, index) > 1 || !parts.lattice.wrap(place)) {
            ASSERT_EQ(number, -1);
            return;
          }
          ASSERT_GE(number, 0);
          if (number < local.owned_count) {
            ASSERT_EQ(owned[&local - parts.ranks.data()][number], parts.lattice.number(place));
          } else {
            const GhostSource& source = local.ghosts.at(number - local.owned_count);
            ASSERT_EQ(owned.at(source.rank).at(source.index), parts.lattice.number(place));
          }
        });
  });
}

TEST(LocalMesh, GhostsAreSortedUsedAndOfOtherRanks) {
  for_all_meshes([]<int Dim>(const Parts<Dim>& parts) {
    for (int rank = 0; rank < parts.partition.ranks; ++rank) {
      const LocalMesh<Dim>& local = parts.ranks[rank];
      std::vector<int> uses(local.ghosts.size(), 0);
      for (const LocalBlock<Dim>& block : local.blocks)
        for_each(grown(box_of<Dim>(block.extents), halo_layers), [&](const Index<Dim>& index) {
          const int number = block.cell_number(index);
          if (number >= local.owned_count) ++uses.at(number - local.owned_count);
        });
      EXPECT_EQ(std::ranges::count(uses, 0), 0);
      EXPECT_EQ(std::ranges::adjacent_find(local.ghosts, std::greater_equal{}), local.ghosts.end());
      EXPECT_TRUE(std::ranges::none_of(local.ghosts, [&](const GhostSource& g) { return g.rank == rank; }));
    }
  });
}

// Copies, hence equal to the last bit; nodes of the block itself as well as of the first halo.
TEST(LocalMesh, NodesOfNeighboursAreTheirOwn) {
  for_all_meshes([]<int Dim>(const Parts<Dim>& parts) {
    for (const LocalMesh<Dim>& local : parts.ranks)
      for (const LocalBlock<Dim>& block : local.blocks)
        for_each(grown(box_of<Dim>(block.extents), 1), [&](const Index<Dim>& cell) {
          if (block.cell_number(cell) < 0) return;
          Index<Dim> node_end = cell;
          for (int d = 0; d < Dim; ++d) node_end[d] += 2;
          for_each(Box<Dim>{cell, node_end}, [&](const Index<Dim>& node) {
            ASSERT_EQ(block.nodes(node), parts.lattice.position(parts.lattice_node(block, node)));
          });
        });
  });
}

TEST(LocalMesh, NodesBeyondBoundariesContinueALinearMesh) {
  const LatticeMesh<3> lattice = turned_box();
  MultiblockMesh<3> mesh = lattice.mesh();
  const auto linear = [](const Index<3>& node) {
    return Vec<double, 3>{{2.0 * node[0] + node[1], node[1] - 0.5 * node[2], 3.0 * node[2] + node[0]}};
  };
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for_each(mesh.zones[z].nodes.interior(), [&](const Index<3>& node) {
      mesh.zones[z].nodes(node) = linear(lattice.lattice_node(static_cast<int>(z), node));
    });
  const Partition<3> partition = random_partition(mesh, 5, 11);
  for (int rank = 0; rank < 5; ++rank)
    for (const LocalBlock<3>& block : build_local_mesh(mesh, partition, rank).blocks)
      for_each(grown(block.nodes.interior(), 1), [&](const Index<3>& node) {
        Index<3> in_zone = node;
        for (int d = 0; d < 3; ++d) in_zone[d] += block.zone_cells.begin[d];
        // Coordinates are small multiples of 1/2: exact.
        ASSERT_EQ(block.nodes(node), linear(lattice.lattice_node(block.zone, in_zone)));
      });
}

// Each side of each block is covered by patches exactly where the lattice ends.
TEST(LocalMesh, PatchesAreClippedToTheBlocks) {
  for_all_meshes([]<int Dim>(const Parts<Dim>& parts) {
    for (const LocalMesh<Dim>& local : parts.ranks)
      for (const LocalBlock<Dim>& block : local.blocks) {
        BlockArray<int, Dim> covered(block.extents, 1, 0);
        for (const BoundaryPatch<Dim>& patch : block.patches) {
          const int d = patch.side.direction;
          EXPECT_EQ(patch.cells.extent(d), 1);
          EXPECT_EQ(patch.cells.begin[d], patch.side.end == 0 ? 0 : block.extents[d] - 1);
          for_each(patch.cells, [&](Index<Dim> cell) {
            cell[d] += patch.side.end == 0 ? -1 : 1;
            const Index<Dim> place = parts.lattice_cell(block, cell);
            const bool wall = place[1] < 0;
            ASSERT_EQ(patch.type, wall ? BoundaryType::slip_wall : BoundaryType::farfield);
            ++covered(cell);
          });
        }
        for_each(grown(box_of<Dim>(block.extents), 1), [&](const Index<Dim>& index) {
          Index<Dim> place = parts.lattice_cell(block, index);
          const bool boundary = directions_outside<Dim>(block, index) == 1 && !parts.lattice.wrap(place);
          ASSERT_EQ(covered(index), boundary ? 1 : 0);
        });
      }
  });
}

TEST(LocalMesh, RefusesARankThatIsNotThere) {
  const LatticeMesh<2> lattice = single_ring(8, 2);
  const Partition<2> partition = partition_mesh(lattice.mesh(), 2, {});
  EXPECT_THROW(build_local_mesh(lattice.mesh(), partition, 2), InternalError);
  EXPECT_THROW(build_local_mesh(lattice.mesh(), partition, -1), InternalError);
}

TEST(LocalMesh, RefusesAPartitionThatLeavesCellsOut) {
  const LatticeMesh<2> lattice = single_ring(8, 2);
  const Partition<2> holed{1, {{0, {{0, 0}, {5, 2}}, 0}}};
  EXPECT_THROW(build_local_mesh(lattice.mesh(), holed, 0), InternalError);
}

}  // namespace
}  // namespace wingbeat
