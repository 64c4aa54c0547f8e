#pragma once

#include <optional>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// A 3-D mesh one cell thick between two symmetry planes, as a 2-D mesh: the span and its two
// symmetry patches are dropped, all else is kept. Nothing where a zone is not of that form.
// The planes must be normal to one coordinate axis, the same for all zones, and the remaining
// two coordinates (x, y of a span along z; x, z along y; y, z along x) become the mesh's.
// Throws InputError, beginning with `source`, where the two planes are not flat or not alike.
// Blocks may come out left-handed: see make_right_handed.
std::optional<MultiblockMesh<2>> collapse_to_2d(const MultiblockMesh<3>& mesh, const std::string& source);

}  // namespace wingbeat
