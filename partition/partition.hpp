#pragma once

#include <vector>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// A box of cells of one zone, given to one rank.
template <int Dim>
struct SubBlock {
  int zone = 0;
  Box<Dim> cells;
  int rank = 0;
};

// Every cell of the mesh belongs to exactly one sub-block; every rank has at least one.
template <int Dim>
struct Partition {
  int ranks = 1;
  std::vector<SubBlock<Dim>> blocks;
};

struct PartitionOptions {
  double imbalance = 0.05;  // allowed excess of the heaviest rank over the mean
  int granularity = 1;      // power of two: cut zones at multiples of it, for multigrid
};

// What a partition costs: printed before a run.
struct PartitionStatistics {
  int ranks = 1;
  std::size_t blocks = 0;
  double imbalance = 0.0;      // heaviest rank over mean, minus one
  std::size_t edge_cut = 0;    // cell faces between different ranks
  std::size_t halo_cells = 0;  // ghost cells received, summed over ranks (two layers)
  std::size_t halo_bytes = 0;  // bytes of one exchange of the state of all instances
};

// Splits the zones, weighs sub-blocks by cells (all instances of a cell live on one rank) and
// divides the graph of sub-blocks, its edges weighted by shared faces, by METIS k-way; recursive
// bisection takes its place where it cuts no more faces or METIS misses the allowed imbalance.
// No rank exceeds that imbalance by more than whole cells force it to. One rank keeps the zones
// whole. Deterministic; time grows about as ranks do.
// The granularity asked for is halved until the mesh itself can be coarsened that far and the allowed
// imbalance can be kept.
// Throws InputError when there are more ranks than cells.
template <int Dim>
Partition<Dim> partition_mesh(const MultiblockMesh<Dim>& mesh, int ranks, const PartitionOptions& options);

template <int Dim>
PartitionStatistics partition_statistics(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition,
                                         int instances);

}  // namespace wingbeat
