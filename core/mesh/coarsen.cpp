#include "core/mesh/coarsen.hpp"

namespace wingbeat {
namespace {

template <int Dim>
bool is_even(const Index<Dim>& index) {
  for (int i : index)
    if (i % 2 != 0) return false;
  return true;
}

template <int Dim>
Index<Dim> halved(Index<Dim> index) {
  for (int& i : index) i /= 2;
  return index;
}

// A layer of cells along a side: even edges along the side, one cell thick across it.
template <int Dim>
std::optional<Box<Dim>> halved_layer(Box<Dim> cells, const Side& side, const Index<Dim>& extents) {
  const int d = side.direction;
  cells.begin[d] = 0;
  cells.end[d] = extents[d];
  if (!is_even<Dim>(cells.begin) || !is_even<Dim>(cells.end)) return std::nullopt;
  Box<Dim> half{halved<Dim>(cells.begin), halved<Dim>(cells.end)};
  half.begin[d] = side.end == 0 ? 0 : extents[d] / 2 - 1;
  half.end[d] = half.begin[d] + 1;
  return half;
}

template <int Dim>
std::optional<Zone<Dim>> halved_zone(const Zone<Dim>& zone, int least_cells) {
  if (!is_even<Dim>(zone.cells)) return std::nullopt;
  Zone<Dim> half;
  half.name = zone.name;
  half.cells = halved<Dim>(zone.cells);
  Index<Dim> nodes = half.cells;
  for (int& count : nodes) {
    if (count < least_cells) return std::nullopt;
    ++count;
  }
  half.nodes = BlockArray<Vec<double, Dim>, Dim>(nodes, 0);
  for_each(half.nodes.interior(), [&](const Index<Dim>& node) {
    Index<Dim> fine = node;
    for (int& i : fine) i *= 2;
    half.nodes(node) = zone.nodes(fine);
  });
  for (BoundaryPatch<Dim> patch : zone.patches) {
    const auto cells = halved_layer<Dim>(patch.cells, patch.side, zone.cells);
    if (!cells) return std::nullopt;
    patch.cells = *cells;
    half.patches.push_back(std::move(patch));
  }
  for (Interface<Dim> interface : zone.interfaces) {
    Box<Dim> edges = interface.nodes;
    for (int d = 0; d < Dim; ++d)
      if (d != interface.side.direction) --edges.end[d];
    edges.end[interface.side.direction] = edges.begin[interface.side.direction];
    if (!is_even<Dim>(edges.begin) || !is_even<Dim>(edges.end) || !is_even<Dim>(interface.donor_origin))
      return std::nullopt;
    interface.nodes = {halved<Dim>(edges.begin), halved<Dim>(edges.end)};
    for (int d = 0; d < Dim; ++d) ++interface.nodes.end[d];
    interface.donor_origin = halved<Dim>(interface.donor_origin);
    half.interfaces.push_back(std::move(interface));
  }
  return half;
}

}  // namespace

template <int Dim>
std::optional<MultiblockMesh<Dim>> coarsened(const MultiblockMesh<Dim>& mesh, int least_cells) {
  MultiblockMesh<Dim> coarse;
  for (const Zone<Dim>& zone : mesh.zones) {
    auto half = halved_zone<Dim>(zone, least_cells);
    if (!half) return std::nullopt;
    coarse.zones.push_back(std::move(*half));
  }
  return coarse;
}

template std::optional<MultiblockMesh<2>> coarsened(const MultiblockMesh<2>&, int);
template std::optional<MultiblockMesh<3>> coarsened(const MultiblockMesh<3>&, int);

}  // namespace wingbeat
