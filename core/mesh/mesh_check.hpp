#pragma once

#include <string>
#include <vector>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// Nodes that two sides of an interface share may differ by this much of the shortest edge
// that leaves the node: room for coordinates written with few digits, not for a gap.
inline constexpr double interface_tolerance = 1e-4;

// Everything that is wrong with a mesh, one line each, naming zone, patch or side, and index
// (counted from 1, as CGNS and Plot3D do): nodes that are not finite; cells of zero or negative
// volume; patches and interfaces that do not lie on their side; interfaces whose nodes do not
// meet or whose donor does not lead back; faces of a side that nothing covers, or two things do.
template <int Dim>
std::vector<std::string> mesh_faults(const MultiblockMesh<Dim>& mesh);

// The first of these alone: nodes that are not finite, cells of zero or negative volume. What can go wrong
// where the nodes of a checked mesh are moved.
template <int Dim>
std::vector<std::string> volume_faults(const MultiblockMesh<Dim>& mesh);

// Throws InputError listing the first 20 faults, and how many more there are.
// `source` is what the message begins with: the name of a file, say.
template <int Dim>
void validate(const MultiblockMesh<Dim>& mesh, const std::string& source = "mesh");

}  // namespace wingbeat
