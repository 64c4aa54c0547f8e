#pragma once

#include <optional>
#include <string>

#include "core/mesh/multiblock_mesh.hpp"
#include "partition/partition.hpp"

// Meshes of every second node for multigrid, divided among the ranks as the fine mesh is: a coarse
// cell lives on the rank, and in the sub-block, of the fine cells it is made of.
namespace wingbeat {

template <int Dim>
struct CoarseGrid {
  MultiblockMesh<Dim> mesh;
  Partition<Dim> partition;
};

// The next coarser mesh (core/mesh/coarsen.hpp) with its partition, sub-blocks in the same order.
// Nothing where the mesh cannot be coarsened or a sub-block begins or ends at an odd plane.
// `least_cells` holds for the zones; sub-blocks may become a single cell wide.
template <int Dim>
std::optional<CoarseGrid<Dim>> coarsened(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition,
                                         int least_cells = 2);

// How often coarsened() can be repeated; the same on every rank.
template <int Dim>
int coarsening_levels(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition, int least_cells = 2);

// Why there are no more levels than coarsening_levels(): which zone, patch, interface or sub-block.
template <int Dim>
std::string describe_limit(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition,
                           int least_cells = 2);

// The partition of a coarse mesh as one of the fine mesh it was made of, by one or more coarsenings.
template <int Dim>
Partition<Dim> refined(Partition<Dim> partition, const MultiblockMesh<Dim>& coarse,
                       const MultiblockMesh<Dim>& fine);

}  // namespace wingbeat
