#pragma once

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// The same cells, nodes (bit for bit), patches and connections in `count` zones, as equal as
// possible; no zone is narrower than `minimum_width` cells unless it was. A piece may exceed the mean
// of its zone by 5 % where the pieces can then be coarsened more often (core/mesh/coarsen.hpp). Pieces of
// zone "name" are called "name-1", "name-2", ...; a zone left whole keeps its name. Interfaces that are
// divided are numbered likewise, interfaces along the cuts are called "to-" and the neighbour's name. Throws
// InputError if `count` is less than the zones there are, or more than fit.
template <int Dim>
MultiblockMesh<Dim> cut_blocks(const MultiblockMesh<Dim>& mesh, int count, int minimum_width = 1);

}  // namespace wingbeat
