#pragma once

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// A renumbering of a block: its direction d becomes direction axis[d], reversed where sign[d] < 0.
template <int Dim>
struct Orientation {
  Index<Dim> axis{};
  Index<Dim> sign{};
};

// The same mesh with one zone renumbered; patches and interfaces, also those of other zones
// that lead into it, follow.
template <int Dim>
MultiblockMesh<Dim> reoriented(MultiblockMesh<Dim> mesh, int zone, const Orientation<Dim>& orientation);

// The same mesh with the first direction reversed in every zone that has more cells of negative
// than of positive volume.
template <int Dim>
MultiblockMesh<Dim> make_right_handed(MultiblockMesh<Dim> mesh);

}  // namespace wingbeat
