#include "apps/case_mesh.hpp"
#include "apps/mesh_table.hpp"
#include "apps/on_root.hpp"
#include "apps/verbs.hpp"
#include "core/mesh/cgns_mesh.hpp"
#include "core/mesh/mesh_quality.hpp"

namespace wingbeat {

SolveStatus run_mesh(Context& context) {
  const AnyMesh mesh = make_case_mesh(context.comm, context.settings.mesh);
  std::visit(
      [&]<int Dim>(const MultiblockMesh<Dim>& built) {
        const MeshQuality<Dim> quality = measure_quality(built);
        context.log.line(format_quality(built, quality));
        on_root(context.comm, [&] {
          write_cgns(built, context.output / "mesh.cgns");
          if constexpr (Dim == 2) near_wall_nodes(built).write(context.output / "mesh.csv");
        });
        context.result.findings["mesh"] = {{"dimension", Dim},
                                           {"blocks", quality.zones},
                                           {"cells", quality.cells},
                                           {"wall_faces", quality.wall_faces},
                                           {"min_volume", quality.min_volume.value},
                                           {"min_angle_deg", quality.min_angle_deg.value},
                                           {"max_aspect_ratio", quality.max_aspect_ratio.value},
                                           {"max_volume_ratio", quality.max_volume_ratio.value}};
      },
      mesh);
  context.result.message = "wrote " + (context.output / "mesh.cgns").string();
  return SolveStatus::converged;
}

}  // namespace wingbeat
