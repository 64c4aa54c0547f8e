#pragma once

#include <string>
#include <vector>

#include "core/mesh/cgns_file.hpp"
#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// The GridConnectivity1to1 nodes of zone `zone` (counted from 1) of base `base`; `blocks` are all
// zones in the file's order with names and cells already set, by which donors are numbered.
// Throws InputError naming file, zone and interface for periodic, general (abutting, overset) or
// degenerate connections, and where ranges and transform contradict each other.
template <int Dim>
std::vector<Interface<Dim>> read_cgns_interfaces(const CgnsFile& file, int base, int zone,
                                                 const std::vector<Zone<Dim>>& blocks);

}  // namespace wingbeat
