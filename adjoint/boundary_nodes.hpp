#pragma once

#include <cstddef>
#include <vector>

#include "adjoint/section_wall.hpp"
#include "core/mesh/node_numbers.hpp"

namespace wingbeat {

// Nodes on the boundary of a mesh: first those that are moved, then those that stay.
template <int Dim>
struct BoundaryNodes {
  std::vector<int> nodes;  // node numbers
  std::vector<Vec<double, Dim>> positions;
  std::vector<double> areas;  // each node's share of the faces around it
  std::size_t moving = 0;     // how many of them are moved
};

// The nodes of the wall in their order, then those of all other patches in the order of x, then y: the same
// however the mesh is cut into blocks.
BoundaryNodes<2> boundary_nodes(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers,
                                const SectionWall& wall);

}  // namespace wingbeat
