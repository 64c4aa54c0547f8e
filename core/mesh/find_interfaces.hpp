#pragma once

#include <string>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// The mesh with an interface (both ways) wherever faces on uncovered parts of its sides share all
// their nodes, within interface_tolerance: whole sides, parts of sides, O- and C-cuts. The two
// sides of a wall of no thickness are joined, too: such a mesh needs a file that states its boundaries.
// Throws InputError, beginning with `source`, where three faces coincide or a face has no extent.
template <int Dim>
MultiblockMesh<Dim> find_interfaces(MultiblockMesh<Dim> mesh, const std::string& source);

// The mesh with a patch on every face still uncovered. Faces that share nodes form a surface: the
// surface with the largest bounding box is the far field, all others are slip walls.
// Throws InputError, beginning with `source`, where all faces form one surface: it cannot be told
// which part of it is what.
template <int Dim>
MultiblockMesh<Dim> guess_boundaries(MultiblockMesh<Dim> mesh, const std::string& source);

}  // namespace wingbeat
