#include "core/mesh/mesh_file.hpp"

#include <fstream>
#include <string>

#include "core/io/error.hpp"
#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/plot3d.hpp"

namespace wingbeat {

AnyMesh read_mesh(const std::filesystem::path& path) {
  std::string head(64, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  if (head.starts_with("\x1f\x8b"))
    throw InputError(path.string() + ": is compressed (gzip); decompress it first: gunzip " + path.string());
  const bool is_hdf5 = head.starts_with("\x89HDF");
  const bool is_adf = head.find("ADF Database Version") != std::string::npos;
  if (is_hdf5 || is_adf || path.extension() == ".cgns") return read_cgns(path);
  return read_plot3d(path);
}

}  // namespace wingbeat
