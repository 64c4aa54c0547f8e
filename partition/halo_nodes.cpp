#include "partition/halo_nodes.hpp"

#include "partition/halo_cells.hpp"

namespace wingbeat {
namespace {

template <int Dim>
using Nodes = BlockArray<Vec<double, Dim>, Dim>;

// Calls f(corner) for the corners of a cell: 0 or 1 in each direction.
template <int Dim, class F>
void for_each_corner(F&& f) {
  Index<Dim> two;
  two.fill(2);
  for_each(box_of<Dim>(two), f);
}

// The node of the cell at `position` that is its corner `corner` as the start zone sees it.
template <int Dim>
const Vec<double, Dim>& corner_node(const MultiblockMesh<Dim>& mesh, const CellPosition<Dim>& position,
                                    const Index<Dim>& corner) {
  Index<Dim> node = position.cell;
  for (int d = 0; d < Dim; ++d) node[position.axis[d]] += position.sign[d] > 0 ? corner[d] : 1 - corner[d];
  return mesh.zones[position.zone].nodes(node);
}

// Copies the nodes one layer out; `known` marks them.
template <int Dim>
void copy_from_neighbours(const MultiblockMesh<Dim>& mesh, int zone, const Box<Dim>& box, Nodes<Dim>& nodes,
                          BlockArray<char, Dim>& known) {
  for_each_halo_cell(mesh, zone, box, 1, [&](const HaloCell<Dim>& halo) {
    const int d = halo.side.direction;
    for_each_corner<Dim>([&](const Index<Dim>& corner) {
      if (corner[d] != halo.side.end) return;  // the others are the box's own
      Index<Dim> node;
      for (int e = 0; e < Dim; ++e) node[e] = halo.index[e] - box.begin[e] + corner[e];
      nodes(node) = corner_node<Dim>(mesh, halo.position, corner);
      known(node) = 1;
    });
  });
}

// Direction by direction, each from all that the earlier directions have filled.
template <int Dim>
void extrapolate_the_rest(Nodes<Dim>& nodes, const BlockArray<char, Dim>& known) {
  Box<Dim> filled = nodes.interior();
  for (int d = 0; d < Dim; ++d) {
    for (int end = 0; end < 2; ++end) {
      const int inward = end == 0 ? 1 : -1;
      Box<Dim> layer = filled;
      layer.begin[d] = end == 0 ? -1 : filled.end[d];
      layer.end[d] = layer.begin[d] + 1;
      for_each(layer, [&](const Index<Dim>& node) {
        if (known(node)) return;
        Index<Dim> first = node, second = node;
        first[d] += inward;
        second[d] += 2 * inward;
        nodes(node) = 2.0 * nodes(first) - nodes(second);
      });
    }
    filled.begin[d] -= 1;
    filled.end[d] += 1;
  }
}

}  // namespace

template <int Dim>
BlockArray<Vec<double, Dim>, Dim> nodes_with_halo(const MultiblockMesh<Dim>& mesh, int zone,
                                                  const Box<Dim>& box) {
  Index<Dim> extents;
  for (int d = 0; d < Dim; ++d) extents[d] = box.extent(d) + 1;
  Nodes<Dim> nodes(extents, 1);
  BlockArray<char, Dim> known(extents, 1, 0);
  for_each(nodes.interior(), [&](const Index<Dim>& node) {
    Index<Dim> zone_node;
    for (int d = 0; d < Dim; ++d) zone_node[d] = node[d] + box.begin[d];
    nodes(node) = mesh.zones[zone].nodes(zone_node);
  });
  copy_from_neighbours(mesh, zone, box, nodes, known);
  extrapolate_the_rest<Dim>(nodes, known);
  return nodes;
}

template BlockArray<Vec<double, 2>, 2> nodes_with_halo<2>(const MultiblockMesh<2>&, int, const Box<2>&);
template BlockArray<Vec<double, 3>, 3> nodes_with_halo<3>(const MultiblockMesh<3>&, int, const Box<3>&);

}  // namespace wingbeat
