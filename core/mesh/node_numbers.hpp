#pragma once

#include <span>
#include <vector>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// Every node of a mesh once: copies that interfaces join, also at corners of several blocks and along
// the cut of an O-mesh, share one number. Numbers 0 ... count - 1 rise with the first copy, zone by
// zone, the first index fastest; they do not depend on ranks.
template <int Dim>
struct NodeNumbers {
  std::vector<BlockArray<int, Dim>> zones;  // [zone](node)
  int count = 0;
};

// `mesh` must have passed validate() (mesh_check.hpp).
template <int Dim>
NodeNumbers<Dim> number_nodes(const MultiblockMesh<Dim>& mesh);

// Position of each node, [number]: that of its first copy. Copies in files differ by round-off.
template <int Dim>
std::vector<Vec<double, Dim>> unique_positions(const MultiblockMesh<Dim>& mesh,
                                               const NodeNumbers<Dim>& numbers);

// The same mesh with its nodes at `positions` [number]: all copies of a node in one place, bit for bit.
template <int Dim>
MultiblockMesh<Dim> with_positions(MultiblockMesh<Dim> mesh, const NodeNumbers<Dim>& numbers,
                                   std::span<const Vec<double, Dim>> positions);

}  // namespace wingbeat
