#pragma once

#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/mesh_settings.hpp"

namespace wingbeat {

// The mesh that a case asks for, generated or read, cut into mesh.blocks (a file only where that
// exceeds its zones), checked. std::visit settles
// its dimension. Every rank makes it for itself. Throws InputError.
AnyMesh make_case_mesh(const MeshSettings& settings);

}  // namespace wingbeat
