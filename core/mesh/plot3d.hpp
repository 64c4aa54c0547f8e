#pragma once

#include <filesystem>

#include "core/mesh/any_mesh.hpp"

namespace wingbeat {

// Reads formatted (text) Plot3D without IBLANK: 2-D or 3-D, with or without the leading count of
// blocks; which of these it is follows from the number of values. A 3-D file of one node, or one
// cell between two flat sides, in one direction gives a 2-D mesh.
// The format holds nodes only: interfaces are found (find_interfaces), boundaries guessed
// (guess_boundaries), left-handed blocks reversed. Blocks are called "block-1", "block-2", ...
// Throws InputError naming file and line or zone, also for the faults of validate().
AnyMesh read_plot3d(const std::filesystem::path& path);

// Writes the nodes with all their digits: count of blocks, nodes in each direction, then all x,
// all y (and all z) of each block. Interfaces and boundaries are lost. Throws InputError.
template <int Dim>
void write_plot3d(const MultiblockMesh<Dim>& mesh, const std::filesystem::path& path);

}  // namespace wingbeat
