#pragma once

#include <filesystem>

#include "core/mesh/any_mesh.hpp"

namespace wingbeat {

// Reads a mesh, checked by validate(): CGNS where the content (ADF or HDF5) or the extension .cgns
// says so, else formatted Plot3D (see read_plot3d). Throws InputError.
AnyMesh read_mesh(const std::filesystem::path& path);

}  // namespace wingbeat
