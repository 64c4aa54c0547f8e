#include "apps/case_mesh.hpp"

#include "core/mesh/airfoil.hpp"
#include "core/mesh/conformal_omesh.hpp"
#include "core/mesh/cut_blocks.hpp"
#include "core/mesh/mesh_check.hpp"
#include "core/mesh/mesh_file.hpp"

namespace wingbeat {

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
  const Airfoil airfoil = make_airfoil(*settings.airfoil);
  MultiblockMesh<2> mesh = conformal_omesh(airfoil, {.around = settings.cells[0],
                                                     .normal = settings.cells[1],
                                                     .farfield_chords = settings.farfield_chords,
                                                     .stretching = settings.stretching,
                                                     .blocks = settings.blocks});
  validate(mesh, "mesh.airfoil = \"" + airfoil.name() + "\"");
  return mesh;
}

}  // namespace wingbeat
