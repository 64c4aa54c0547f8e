#include "apps/mesh_table.hpp"

#include <algorithm>
#include <limits>

namespace wingbeat {

namespace {

struct Rectangle {
  Vec<double, 2> low{{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()}};
  Vec<double, 2> high = -low;

  void include(const Vec<double, 2>& point) {
    for (int d = 0; d < 2; ++d) low[d] = std::min(low[d], point[d]), high[d] = std::max(high[d], point[d]);
  }
  bool contains(const Vec<double, 2>& point, double margin) const {
    for (int d = 0; d < 2; ++d)
      if (point[d] < low[d] - margin || point[d] > high[d] + margin) return false;
    return true;
  }
};

// The nodes of a patch: one layer along its side.
Box<2> nodes_of(const BoundaryPatch<2>& patch) {
  Box<2> nodes = patch.cells;
  const int normal = patch.side.direction;
  for (int d = 0; d < 2; ++d)
    if (d != normal) ++nodes.end[d];
  if (patch.side.end == 1) ++nodes.begin[normal], ++nodes.end[normal];
  return nodes;
}

Rectangle box_of_walls(const MultiblockMesh<2>& mesh) {
  Rectangle box;
  for (const auto& zone : mesh.zones)
    for (const auto& patch : zone.patches)
      if (patch.type == BoundaryType::slip_wall)
        for_each(nodes_of(patch), [&](const Index<2>& node) { box.include(zone.nodes(node)); });
  return box;
}

}  // namespace

CsvTable near_wall_nodes(const MultiblockMesh<2>& mesh, double margin) {
  const Rectangle walls = box_of_walls(mesh);
  CsvTable table({"zone", "i", "j", "x", "y"});
  long number = 0;
  for (const auto& zone : mesh.zones) {
    ++number;
    const Box<2> nodes = box_of<2>({zone.cells[0] + 1, zone.cells[1] + 1});
    for_each(nodes, [&](const Index<2>& node) {
      const auto& point = zone.nodes(node);
      if (walls.contains(point, margin))
        table.add({CsvTable::Cell(number), node[0] + 1L, node[1] + 1L, point[0], point[1]});
    });
  }
  return table;
}

}  // namespace wingbeat
