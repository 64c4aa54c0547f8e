#include "apps/case_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/on_root.hpp"
#include "core/io/error.hpp"
#include "core/io/memory.hpp"
#include "core/mesh/airfoil.hpp"
#include "core/mesh/coarsen.hpp"
#include "core/mesh/conformal_omesh.hpp"
#include "core/mesh/cut_blocks.hpp"
#include "core/mesh/mesh_check.hpp"
#include "core/mesh/mesh_file.hpp"

namespace wingbeat {

namespace {

// Making a built-in mesh takes so many bytes a cell at the most: 68 to 70 were measured from 0.4 to 4
// million.
constexpr double bytes_a_cell = 75.0;

void check_mesh_memory(const std::array<int, 2>& cells) {
  const double needed = bytes_a_cell * cells[0] * cells[1];
  const double available = std::min(available_bytes(), allowed_bytes());
  if (needed > available)
    throw InputError(fmt::format(
        "mesh.cells = [{}, {}]: the mesh alone takes {:.3g} GB on every rank, and {:.3g} GB are to be had; "
        "ask for fewer cells, or run where there is more memory",
        cells[0], cells[1], 1e-9 * needed, 1e-9 * available));
}

MultiblockMesh<2> built_in_mesh(const MeshSettings& settings, const std::array<int, 2>& cells,
                                std::optional<double> stretching) {
  const Airfoil airfoil = make_airfoil(*settings.airfoil);
  MultiblockMesh<2> mesh = conformal_omesh(airfoil, {.around = cells[0],
                                                     .normal = cells[1],
                                                     .farfield_chords = settings.farfield_chords,
                                                     .stretching = stretching,
                                                     .blocks = settings.blocks});
  validate(mesh, "mesh.airfoil = \"" + airfoil.name() + "\"");
  return mesh;
}

}  // namespace

AnyMesh make_case_mesh(const MeshSettings& settings) {
  if (settings.file) {
    AnyMesh mesh = read_mesh(*settings.file);
    std::visit(
        [&]<int Dim>(MultiblockMesh<Dim>& read) {
          if (settings.blocks > static_cast<int>(read.zones.size())) read = cut_blocks(read, settings.blocks);
        },
        mesh);
    return mesh;
  }
  check_mesh_memory(settings.cells);
  return built_in_mesh(settings, settings.cells, settings.stretching);
}

AnyMesh make_case_mesh(const Comm& comm, const MeshSettings& settings) {
  return on_all(comm, [&] { return make_case_mesh(settings); });
}

MultiblockMesh<2> make_plane_mesh(const Comm& comm, const MeshSettings& settings) {
  AnyMesh mesh = make_case_mesh(comm, settings);
  if (auto* plane = std::get_if<MultiblockMesh<2>>(&mesh)) return std::move(*plane);
  throw InputError(
      "mesh.file: the mesh is three-dimensional; this verb solves plane flow: give a 2-D mesh, or one a "
      "single cell "
      "thick between two symmetry planes");
}

template <int Dim>
std::vector<MultiblockMesh<Dim>> mesh_sequence(const MeshSettings& settings, const MultiblockMesh<Dim>& mesh,
                                               int coarse_levels) {
  constexpr int least_around = 48, least_normal = 12;
  std::vector<MultiblockMesh<Dim>> meshes{mesh};
  std::array<int, 2> cells = settings.cells;
  std::optional<double> stretching = settings.stretching;
  for (int level = 0; level < coarse_levels; ++level) {
    if (settings.airfoil) {
      if constexpr (Dim == 2) {
        cells = {cells[0] / 4 * 2, cells[1] / 4 * 2};
        if (cells[0] < least_around || cells[1] < least_normal || cells[0] < 4 * settings.blocks) break;
        if (stretching) *stretching *= *stretching;
        meshes.push_back(built_in_mesh(settings, cells, stretching));
      }
    } else {
      auto coarse = coarsened(meshes.back(), least_normal);
      if (!coarse) break;
      meshes.push_back(std::move(*coarse));
    }
  }
  std::reverse(meshes.begin(), meshes.end());
  return meshes;
}

template std::vector<MultiblockMesh<2>> mesh_sequence<2>(const MeshSettings&, const MultiblockMesh<2>&, int);
template std::vector<MultiblockMesh<3>> mesh_sequence<3>(const MeshSettings&, const MultiblockMesh<3>&, int);

}  // namespace wingbeat
