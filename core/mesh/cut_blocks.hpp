#pragma once

#include <vector>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// Cuts `box` into `count` boxes of nearly equal size that cover it exactly, by repeated halving:
// in the first direction long enough for all the pieces to be `minimum_width` wide, else in the
// longest. Throws InputError if `count` pieces of that width do not fit.
template <int Dim>
std::vector<Box<Dim>> cut_box(const Box<Dim>& box, int count, int minimum_width = 1);

// The same cells, nodes (bit for bit), patches and connections in `count` zones, as equal as
// possible; no zone is narrower than `minimum_width` cells unless it was. Pieces of zone "name" are
// called "name-1", "name-2", ...; a zone left whole keeps its name. Interfaces that are divided are
// numbered likewise, interfaces along the cuts are called "to-" and the neighbour's name.
// Throws InputError if `count` is less than the zones there are, or more than fit.
template <int Dim>
MultiblockMesh<Dim> cut_blocks(const MultiblockMesh<Dim>& mesh, int count, int minimum_width = 1);

}  // namespace wingbeat
