#pragma once

#include <vector>

#include "core/mesh/cgns_file.hpp"
#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// The physical boundaries of zone `zone` (counted from 1) of base `base`, whose name and cells
// `block` already holds. Types: every BCWall* is a slip wall, BCSymmetryPlane, BCFarfield; given on
// the patch or, where it says FamilySpecified, by its family. Ranges: of vertices or of face centres.
// Throws InputError naming file, zone and patch for anything else.
template <int Dim>
std::vector<BoundaryPatch<Dim>> read_cgns_boundaries(const CgnsFile& file, int base, int zone,
                                                     const Zone<Dim>& block);

}  // namespace wingbeat
