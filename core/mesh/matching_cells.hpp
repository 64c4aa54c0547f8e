#pragma once

#include <optional>
#include <vector>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// Of every cell of `to`, counted zone by zone, the cell of `from` at the same place; nothing where the two
// are not the same cells, however they are cut into zones. Places are compared by the means of a cell's
// nodes, to `tolerance`.
template <int Dim>
std::optional<std::vector<long>> matching_cells(const MultiblockMesh<Dim>& from,
                                                const MultiblockMesh<Dim>& to, double tolerance = 1e-9);

}  // namespace wingbeat
