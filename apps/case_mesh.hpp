#pragma once

#include <variant>

#include "core/mesh/mesh_settings.hpp"
#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// The one place where the dimension is still open; std::visit settles it.
using AnyMesh = std::variant<MultiblockMesh<2>, MultiblockMesh<3>>;

// The mesh that a case asks for, generated or read, cut into mesh.blocks (a file only where that
// exceeds its zones), checked. Every rank makes it for itself. Throws InputError.
AnyMesh make_case_mesh(const MeshSettings& settings);

}  // namespace wingbeat
