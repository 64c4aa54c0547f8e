#include "adjoint/mesh_deformation.hpp"

#include <numeric>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

using Points = std::vector<Vec<double, 2>>;
using Method = std::variant<InverseDistance<2>, GridLines>;

Method make_method(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers, const SectionWall& wall,
                   DeformationMethod method) {
  if (method == DeformationMethod::grid_lines) return GridLines(mesh, numbers, wall);
  return InverseDistance<2>(unique_positions(mesh, numbers), boundary_nodes(mesh, numbers, wall),
                            wall.chord());
}

// The components of points, one point after the other.
std::vector<double> flattened(const Points& points) {
  std::vector<double> values;
  for (const auto& x : points) values.insert(values.end(), {x[0], x[1]});
  return values;
}

}  // namespace

MeshDeformation::MeshDeformation(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers,
                                 const SectionWall& wall, DeformationMethod method)
    : wall_size_(wall.size()), method_(make_method(mesh, numbers, wall, method)) {}

Points MeshDeformation::displacement(std::span<const Vec<double, 2>> wall, std::span<const int> nodes) const {
  ensure(wall.size() == wall_size_, "one displacement a node of the wall");
  return std::visit([&](const auto& method) { return method.displacement(wall, nodes); }, method_);
}

void MeshDeformation::add_wall_sensitivity(std::span<const Vec<double, 2>> sensitivities,
                                           std::span<const int> nodes, std::span<Vec<double, 2>> wall) const {
  ensure(wall.size() == wall_size_ && sensitivities.size() == nodes.size(),
         "one sensitivity a node, of the mesh and of the wall");
  std::visit([&](const auto& method) { method.add_transpose(sensitivities, nodes, wall); }, method_);
}

MultiblockMesh<2> deformed(const Comm& comm, const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers,
                           const MeshDeformation& deformation, std::span<const Vec<double, 2>> wall) {
  const auto begin_of = [&](long rank) { return static_cast<int>(numbers.count * rank / comm.size()); };
  std::vector<int> share(begin_of(comm.rank() + 1) - begin_of(comm.rank()));
  std::iota(share.begin(), share.end(), begin_of(comm.rank()));
  std::vector<double> moves = comm.gather(flattened(deformation.displacement(wall, share)));
  moves.resize(2 * static_cast<std::size_t>(numbers.count));
  comm.broadcast(moves);

  Points positions = unique_positions(mesh, numbers);
  for (std::size_t n = 0; n < positions.size(); ++n)
    positions[n] += Vec<double, 2>{{{moves[2 * n], moves[2 * n + 1]}}};
  return with_positions<2>(mesh, numbers, positions);
}

}  // namespace wingbeat
