#pragma once

#include "core/mesh/multiblock_mesh.hpp"
#include "partition/halo_cells.hpp"

namespace wingbeat {

// Calls f(index, zone, node) for each node of a box of cells of a zone and of one layer of neighbours:
// `index` in the box's own indices (extents + 1, halo 1), and which node of which zone lies there,
// whatever the orientation. Nodes beyond physical boundaries and at corners are left out; those of the
// layer may be called more than once.
template <int Dim, class F>
void for_each_node_with_halo(const MultiblockMesh<Dim>& mesh, int zone, const Box<Dim>& box, F&& f) {
  Box<Dim> own = box;
  for (int d = 0; d < Dim; ++d) ++own.end[d];
  const auto relative = [&](Index<Dim> node) {
    for (int d = 0; d < Dim; ++d) node[d] -= box.begin[d];
    return node;
  };
  for_each(own, [&](const Index<Dim>& node) { f(relative(node), zone, node); });
  for_each_halo_cell(mesh, zone, box, 1, [&](const HaloCell<Dim>& halo) {
    const int d = halo.side.direction;
    Index<Dim> two;
    two.fill(2);
    for_each(box_of<Dim>(two), [&](const Index<Dim>& corner) {
      if (corner[d] != halo.side.end) return;  // the others are the box's own
      Index<Dim> node = halo.index;
      for (int e = 0; e < Dim; ++e) node[e] += corner[e];
      f(relative(node), halo.position.zone, corner_node<Dim>(halo.position, corner));
    });
  });
}

// Nodes of a box of cells of a zone and of one layer of neighbours, in the box's own indices
// (extents + 1, halo 1). The neighbours' are copied from the cells that lie there, whatever
// their orientation; beyond physical boundaries and at corners nodes are extrapolated linearly.
template <int Dim>
BlockArray<Vec<double, Dim>, Dim> nodes_with_halo(const MultiblockMesh<Dim>& mesh, int zone,
                                                  const Box<Dim>& box);

}  // namespace wingbeat
