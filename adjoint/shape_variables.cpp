#include "adjoint/shape_variables.hpp"

namespace wingbeat {

ShapeVariables::ShapeVariables(const MultiblockMesh<2>& mesh, const LocalMesh<2>& local,
                               const DesignSettings& settings)
    : numbers_(number_nodes(mesh)),
      nodes_(build_local_nodes(mesh, numbers_, local)),
      wall_(section_wall(mesh, numbers_)),
      bumps_(wall_, settings.bump_options()),
      deformation_(mesh, numbers_, wall_, settings.deformation_method()) {}

std::vector<Vec<double, 2>> ShapeVariables::node_change(std::span<const double> amplitudes) const {
  return deformation_.displacement(bumps_.displacement(amplitudes), nodes_.numbers);
}

MultiblockMesh<2> ShapeVariables::deformed_mesh(const Comm& comm, const MultiblockMesh<2>& mesh,
                                                std::span<const double> amplitudes) const {
  return deformed(comm, mesh, numbers_, deformation_, bumps_.displacement(amplitudes));
}

std::vector<Vec<double, 2>> ShapeVariables::wall_sensitivity(const Comm& comm,
                                                             std::span<const Vec<double, 2>> nodes) const {
  std::vector<Vec<double, 2>> wall(wall_.size());
  deformation_.add_wall_sensitivity(nodes, nodes_.numbers, wall);
  std::vector<double> values;
  for (const auto& v : wall) values.insert(values.end(), {v[0], v[1]});
  comm.sum(values);
  for (std::size_t i = 0; i < wall.size(); ++i) wall[i] = {{{values[2 * i], values[2 * i + 1]}}};
  return wall;
}

}  // namespace wingbeat
