#pragma once

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// Nodes of a box of cells of a zone and of one layer of neighbours, in the box's own indices
// (extents + 1, halo 1). The neighbours' are copied from the cells that lie there, whatever
// their orientation; beyond physical boundaries and at corners nodes are extrapolated linearly.
template <int Dim>
BlockArray<Vec<double, Dim>, Dim> nodes_with_halo(const MultiblockMesh<Dim>& mesh, int zone,
                                                  const Box<Dim>& box);

}  // namespace wingbeat
