#include "adjoint/boundary_nodes.hpp"

#include <algorithm>

#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/interface_transform.hpp"

namespace wingbeat {

BoundaryNodes<2> boundary_nodes(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers,
                                const SectionWall& wall) {
  const std::vector<Vec<double, 2>> positions = unique_positions(mesh, numbers);
  std::vector<double> area(positions.size(), 0.0);  // of the patches that stay
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for (const BoundaryPatch<2>& patch : mesh.zones[z].patches) {
      if (patch.type == BoundaryType::slip_wall) continue;
      for_each(patch.cells, [&](const Index<2>& cell) {
        const Box<2> face =
            nodes_of_side_cells<2>(mesh.zones[z].cells, patch.side, box_between<2>(cell, cell));
        const int a = numbers.zones[z](face.begin), b = numbers.zones[z](last_index(face));
        const double half = 0.5 * norm(positions[b] - positions[a]);
        area[a] += half;
        area[b] += half;
      });
    }
  for (const int node : wall.nodes) area[node] = 0.0;

  std::vector<int> fixed;
  for (int node = 0; node < numbers.count; ++node)
    if (area[node] > 0.0) fixed.push_back(node);
  std::ranges::sort(fixed, {}, [&](int node) { return positions[node].components; });

  BoundaryNodes<2> boundary{wall.nodes, wall.positions, wall.areas, wall.size()};
  for (const int node : fixed) {
    boundary.nodes.push_back(node);
    boundary.positions.push_back(positions[node]);
    boundary.areas.push_back(area[node]);
  }
  return boundary;
}

}  // namespace wingbeat
