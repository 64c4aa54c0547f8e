#include "partition/halo_nodes.hpp"

namespace wingbeat {
namespace {

template <int Dim>
using Nodes = BlockArray<Vec<double, Dim>, Dim>;

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
  for_each_node_with_halo(mesh, zone, box, [&](const Index<Dim>& index, int source, const Index<Dim>& node) {
    nodes(index) = mesh.zones[source].nodes(node);
    known(index) = 1;
  });
  extrapolate_the_rest<Dim>(nodes, known);
  return nodes;
}

template BlockArray<Vec<double, 2>, 2> nodes_with_halo<2>(const MultiblockMesh<2>&, int, const Box<2>&);
template BlockArray<Vec<double, 3>, 3> nodes_with_halo<3>(const MultiblockMesh<3>&, int, const Box<3>&);

}  // namespace wingbeat
