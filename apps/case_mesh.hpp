#pragma once

#include <vector>

#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/mesh_settings.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

// The mesh that a case asks for, generated or read, cut into mesh.blocks (a file only where that
// exceeds its zones), checked. std::visit settles
// its dimension. Throws InputError.
AnyMesh make_case_mesh(const MeshSettings& settings);

// The same, made by every rank for itself: all have it, or all throw. Collective.
AnyMesh make_case_mesh(const Comm& comm, const MeshSettings& settings);

// Likewise where only plane flow is solved: a 3-D mesh is refused. Collective.
MultiblockMesh<2> make_plane_mesh(const Comm& comm, const MeshSettings& settings);

// `mesh` and up to `coarse_levels` coarser ones, coarsest first, with the same zones: the built-in
// mesh made with half the cells each way, a file's mesh at every second node while its cell counts
// allow. None is coarser than grid sequencing profits from.
template <int Dim>
std::vector<MultiblockMesh<Dim>> mesh_sequence(const MeshSettings& settings, const MultiblockMesh<Dim>& mesh,
                                               int coarse_levels);

}  // namespace wingbeat
