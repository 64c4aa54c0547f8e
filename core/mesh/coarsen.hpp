#pragma once

#include <optional>
#include <string>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// How many cells in line become one: 2, or 1 in a direction of a single cell.
template <int Dim>
Index<Dim> coarsening_ratio(const Index<Dim>& cells);

// Why a mesh cannot be coarsened: an odd count of cells, an odd edge of a patch or an interface, or
// fewer than `least_cells` cells left in a direction that is halved. Empty where it can.
template <int Dim>
std::string coarsening_obstacle(const MultiblockMesh<Dim>& mesh, int least_cells = 2);

// Every second node of a mesh, of a direction of one cell both; nothing where there is an obstacle.
template <int Dim>
std::optional<MultiblockMesh<Dim>> coarsened(const MultiblockMesh<Dim>& mesh, int least_cells = 2);

}  // namespace wingbeat
