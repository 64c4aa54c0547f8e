#include "core/mesh/side_faces.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "core/mesh/cell_geometry.hpp"

namespace wingbeat {

template <int Dim>
std::vector<SideFace<Dim>> uncovered_faces(const MultiblockMesh<Dim>& mesh) {
  std::vector<SideFace<Dim>> faces;
  for (int z = 0; z < static_cast<int>(mesh.zones.size()); ++z) {
    const Zone<Dim>& zone = mesh.zones[z];
    for (int side_number = 0; side_number < 2 * Dim; ++side_number) {
      const Side side{side_number / 2, side_number % 2};
      std::vector<Box<Dim>> covers;
      for (const BoundaryPatch<Dim>& patch : zone.patches)
        if (patch.side == side) covers.push_back(patch.cells);
      for (const Interface<Dim>& connection : zone.interfaces)
        if (connection.side == side)
          covers.push_back(cells_of_side_nodes<Dim>(zone.cells, side, connection.nodes));
      for_each<Dim>(side_cells<Dim>(zone.cells, side), [&](const Index<Dim>& cell) {
        if (std::none_of(covers.begin(), covers.end(),
                         [&](const Box<Dim>& box) { return box.contains(cell); }))
          faces.push_back({z, side, cell});
      });
    }
  }
  return faces;
}

template <int Dim>
double shortest_edge(const MultiblockMesh<Dim>& mesh, const SideFace<Dim>& face) {
  const Zone<Dim>& zone = mesh.zones[face.zone];
  const Box<Dim> nodes = face_nodes<Dim>(mesh, face);
  double shortest = std::numeric_limits<double>::infinity();
  for_each<Dim>(nodes, [&](const Index<Dim>& node) {
    for (int d = 0; d < Dim; ++d) {
      Index<Dim> next = node;
      ++next[d];
      if (nodes.contains(next)) shortest = std::min(shortest, norm(zone.nodes(next) - zone.nodes(node)));
    }
  });
  return shortest;
}

template <int Dim>
std::vector<IndexPair> coincident_pairs(std::span<const Vec<double, Dim>> points,
                                        std::span<const double> tolerances) {
  // Sorted along a direction in which points of grids rarely line up, coincident points are close.
  constexpr std::array<double, 3> direction{0.6917, 0.5417, 0.4772};
  std::vector<double> position(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int d = 0; d < Dim; ++d) position[i] += direction[static_cast<std::size_t>(d)] * points[i][d];
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return position[a] != position[b] ? position[a] < position[b] : a < b; });

  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int a = order[i];
    for (std::size_t j = i + 1; j < order.size() && position[order[j]] - position[a] <= tolerances[a]; ++j) {
      const int b = order[j];
      if (norm(points[b] - points[a]) <= std::min(tolerances[a], tolerances[b]))
        pairs.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  return pairs;
}

template std::vector<SideFace<2>> uncovered_faces<2>(const MultiblockMesh<2>&);
template std::vector<SideFace<3>> uncovered_faces<3>(const MultiblockMesh<3>&);
template double shortest_edge<2>(const MultiblockMesh<2>&, const SideFace<2>&);
template double shortest_edge<3>(const MultiblockMesh<3>&, const SideFace<3>&);
template std::vector<IndexPair> coincident_pairs<2>(std::span<const Vec<double, 2>>, std::span<const double>);
template std::vector<IndexPair> coincident_pairs<3>(std::span<const Vec<double, 3>>, std::span<const double>);

}  // namespace wingbeat
