#include "core/mesh/coarsen.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace wingbeat {
namespace {

template <int Dim>
Index<Dim> divided(Index<Dim> index, const Index<Dim>& ratio) {
  for (int d = 0; d < Dim; ++d) index[d] /= ratio[d];
  return index;
}

// The first entry that its ratio does not divide; 0 where there is none.
template <int Dim>
int odd_entry(const Index<Dim>& index, const Index<Dim>& ratio) {
  for (int d = 0; d < Dim; ++d)
    if (index[d] % ratio[d] != 0) return index[d];
  return 0;
}

// The edges of a patch across its side: its cells, without extent normal to the side.
template <int Dim>
Box<Dim> patch_edges(const BoundaryPatch<Dim>& patch) {
  Box<Dim> edges = patch.cells;
  edges.begin[patch.side.direction] = edges.end[patch.side.direction] = 0;
  return edges;
}

// Nodes of the first and last corner of an interface.
template <int Dim>
Box<Dim> interface_edges(const Interface<Dim>& interface) {
  Box<Dim> edges = interface.nodes;
  for (int& end : edges.end) --end;
  return edges;
}

template <int Dim>
std::string edge_obstacle(const std::string& what, const Box<Dim>& edges, const Index<Dim>& ratio) {
  const int low = odd_entry<Dim>(edges.begin, ratio);
  const int odd = low != 0 ? low : odd_entry<Dim>(edges.end, ratio);
  return odd == 0 ? "" : fmt::format("{} has an edge at {}, which is odd", what, odd);
}

template <int Dim>
std::string interface_obstacle(const MultiblockMesh<Dim>& mesh, const Zone<Dim>& zone,
                               const Interface<Dim>& interface) {
  const auto ratio = coarsening_ratio<Dim>(zone.cells);
  const auto donor_ratio = coarsening_ratio<Dim>(mesh.zones[interface.donor].cells);
  const std::string what = fmt::format("interface \"{}\" of zone \"{}\"", interface.name, zone.name);
  std::string edge = edge_obstacle<Dim>(what, interface_edges(interface), ratio);
  return edge.empty() ? edge_obstacle<Dim>(what, {interface.donor_origin, {}}, donor_ratio) : edge;
}

template <int Dim>
std::string zone_obstacle(const MultiblockMesh<Dim>& mesh, const Zone<Dim>& zone, int least_cells) {
  const auto ratio = coarsening_ratio<Dim>(zone.cells);
  const std::string size = fmt::format("zone \"{}\" has {} cells", zone.name, fmt::join(zone.cells, " x "));
  if (const int odd = odd_entry<Dim>(zone.cells, ratio)) return fmt::format("{}: {} is odd", size, odd);
  for (int d = 0; d < Dim; ++d)
    if (ratio[d] == 2 && zone.cells[d] / 2 < least_cells)
      return fmt::format("{}: half of {} is less than {}", size, zone.cells[d], least_cells);
  for (const auto& patch : zone.patches) {
    const std::string what = fmt::format("patch \"{}\" of zone \"{}\"", patch.name, zone.name);
    if (auto edge = edge_obstacle<Dim>(what, patch_edges(patch), ratio); !edge.empty()) return edge;
  }
  for (const auto& interface : zone.interfaces)
    if (auto found = interface_obstacle(mesh, zone, interface); !found.empty()) return found;
  return {};
}

template <int Dim>
Zone<Dim> coarsened_zone(const MultiblockMesh<Dim>& mesh, const Zone<Dim>& zone) {
  const auto ratio = coarsening_ratio<Dim>(zone.cells);
  Zone<Dim> coarse;
  coarse.name = zone.name;
  coarse.cells = divided<Dim>(zone.cells, ratio);
  Index<Dim> nodes = coarse.cells;
  for (int& count : nodes) ++count;
  coarse.nodes = BlockArray<Vec<double, Dim>, Dim>(nodes, 0);
  for_each(coarse.nodes.interior(), [&](const Index<Dim>& node) {
    Index<Dim> fine = node;
    for (int d = 0; d < Dim; ++d) fine[d] *= ratio[d];
    coarse.nodes(node) = zone.nodes(fine);
  });
  for (BoundaryPatch<Dim> patch : zone.patches) {
    const int d = patch.side.direction;
    patch.cells = {divided<Dim>(patch.cells.begin, ratio), divided<Dim>(patch.cells.end, ratio)};
    patch.cells.begin[d] = patch.side.end == 0 ? 0 : coarse.cells[d] - 1;
    patch.cells.end[d] = patch.cells.begin[d] + 1;
    coarse.patches.push_back(std::move(patch));
  }
  for (Interface<Dim> interface : zone.interfaces) {
    const Box<Dim> edges = interface_edges(interface);
    interface.nodes = {divided<Dim>(edges.begin, ratio), divided<Dim>(edges.end, ratio)};
    for (int& end : interface.nodes.end) ++end;
    interface.donor_origin =
        divided<Dim>(interface.donor_origin, coarsening_ratio<Dim>(mesh.zones[interface.donor].cells));
    coarse.interfaces.push_back(std::move(interface));
  }
  return coarse;
}

}  // namespace

template <int Dim>
Index<Dim> coarsening_ratio(const Index<Dim>& cells) {
  Index<Dim> ratio;
  for (int d = 0; d < Dim; ++d) ratio[d] = cells[d] == 1 ? 1 : 2;
  return ratio;
}

template <int Dim>
std::string coarsening_obstacle(const MultiblockMesh<Dim>& mesh, int least_cells) {
  if (mesh.cell_count() == mesh.zones.size()) return "every zone is a single cell";
  for (const auto& zone : mesh.zones)
    if (auto found = zone_obstacle(mesh, zone, least_cells); !found.empty()) return found;
  return {};
}

template <int Dim>
std::optional<MultiblockMesh<Dim>> coarsened(const MultiblockMesh<Dim>& mesh, int least_cells) {
  if (!coarsening_obstacle(mesh, least_cells).empty()) return std::nullopt;
  MultiblockMesh<Dim> coarse;
  for (const auto& zone : mesh.zones) coarse.zones.push_back(coarsened_zone(mesh, zone));
  return coarse;
}

template Index<2> coarsening_ratio<2>(const Index<2>&);
template Index<3> coarsening_ratio<3>(const Index<3>&);
template std::string coarsening_obstacle(const MultiblockMesh<2>&, int);
template std::string coarsening_obstacle(const MultiblockMesh<3>&, int);
template std::optional<MultiblockMesh<2>> coarsened(const MultiblockMesh<2>&, int);
template std::optional<MultiblockMesh<3>> coarsened(const MultiblockMesh<3>&, int);

}  // namespace wingbeat
