#pragma once

#include <vector>

#include "core/mesh/multiblock_mesh.hpp"
#include "core/parallel/ghost_exchange.hpp"
#include "partition/partition.hpp"

namespace wingbeat {

inline constexpr int halo_layers = 2;

// One block of a rank, with what the flow kernels need to know of its surroundings.
template <int Dim>
struct LocalBlock {
  int zone = 0;
  Box<Dim> zone_cells;   // the cells of the zone it covers
  Index<Dim> extents{};  // cells in each direction
  int first_cell = 0;    // local number of cell 0; the others follow, the first index fastest
  // Local number of each cell and of two layers of neighbours across each side: below
  // owned_count an owned cell (of this block or another of the rank), from there on a ghost;
  // -1 beyond a physical boundary and at corners.
  BlockArray<int, Dim> cell_number;
  // Nodes of the block and of the first layer of neighbours (extents + 1, halo 1). Beyond
  // physical boundaries and at corners: extrapolated linearly, to be finite, never to be used.
  BlockArray<Vec<double, Dim>, Dim> nodes;
  std::vector<BoundaryPatch<Dim>> patches;  // cells in this block's indices
};

// A rank's part of a partitioned mesh.
template <int Dim>
struct LocalMesh {
  std::vector<LocalBlock<Dim>> blocks;
  int owned_count = 0;
  std::vector<GhostSource> ghosts;  // owner of each ghost cell; ghost g has number owned_count + g
  std::vector<long> global_cell;    // of each owned cell: its number in the whole mesh, zone by zone
};

// The part of `rank`: a pure function of mesh and partition, so that it can be built and
// inspected without running on that many ranks.
template <int Dim>
LocalMesh<Dim> build_local_mesh(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition, int rank);

}  // namespace wingbeat
