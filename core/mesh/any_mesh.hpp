#pragma once

#include <variant>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// A mesh read from a file, which alone knows its dimension.
using AnyMesh = std::variant<MultiblockMesh<2>, MultiblockMesh<3>>;

}  // namespace wingbeat
