#pragma once

#include <span>
#include <variant>
#include <vector>

#include "adjoint/grid_lines.hpp"
#include "adjoint/inverse_distance.hpp"
#include "adjoint/section_wall.hpp"
#include "core/mesh/node_numbers.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

enum class DeformationMethod { inverse_distance, grid_lines };

// How the nodes of a plane mesh follow its wall: linear in the wall's displacement, with weights fixed on the
// undeformed mesh. The wall's nodes move as told, those of other boundaries not at all. Nodes are named by
// their numbers, and each is moved by itself, so that the outcome is the same, bit for bit, on any number of
// ranks and blocks.
class MeshDeformation {
 public:
  // Throws InputError where the mesh does not suit the method.
  MeshDeformation(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers, const SectionWall& wall,
                  DeformationMethod method);

  // Displacement of each of `nodes`, from that of the wall's nodes [SectionWall::size()].
  std::vector<Vec<double, 2>> displacement(std::span<const Vec<double, 2>> wall,
                                           std::span<const int> nodes) const;
  // The transpose: adds to `wall` what the sensitivities of `nodes` contribute. Not collective: where ranks
  // share the nodes, the caller sums over them.
  void add_wall_sensitivity(std::span<const Vec<double, 2>> sensitivities, std::span<const int> nodes,
                            std::span<Vec<double, 2>> wall) const;

 private:
  std::size_t wall_size_;
  std::variant<InverseDistance<2>, GridLines> method_;
};

// The whole mesh, deformed: each rank moves its share of the nodes, all receive all. Collective.
// Cells may fold: volume_faults (core/mesh/mesh_check.hpp) says which.
MultiblockMesh<2> deformed(const Comm& comm, const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers,
                           const MeshDeformation& deformation, std::span<const Vec<double, 2>> wall);

}  // namespace wingbeat
