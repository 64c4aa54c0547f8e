#pragma once

#include <optional>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// Every second node of a mesh, or nothing where a cell count, or the edge of a patch or an
// interface, is odd, or a zone would be left with fewer than `least_cells` cells in a direction.
template <int Dim>
std::optional<MultiblockMesh<Dim>> coarsened(const MultiblockMesh<Dim>& mesh, int least_cells = 2);

}  // namespace wingbeat
