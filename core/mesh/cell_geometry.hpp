#pragma once

#include <array>
#include <cmath>

#include "core/mesh/metrics.hpp"
#include "core/mesh/multiblock_mesh.hpp"

// Volumes and edges of single cells.
namespace wingbeat {

// Corners of a cell: corner c is displaced by one node in direction d where bit d of c is set.
template <int Dim>
using CellCorners = std::array<Vec<double, Dim>, std::size_t{1} << Dim>;

template <int Dim>
CellCorners<Dim> cell_corners(const Zone<Dim>& zone, const Index<Dim>& cell) {
  CellCorners<Dim> corners;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    Index<Dim> node = cell;
    for (int d = 0; d < Dim; ++d) node[d] += static_cast<int>(c >> d & 1);
    corners[c] = zone.nodes(node);
  }
  return corners;
}

// Mean of the corners.
template <int Dim>
Vec<double, Dim> cell_centre(const Zone<Dim>& zone, const Index<Dim>& cell) {
  const CellCorners<Dim> corners = cell_corners<Dim>(zone, cell);
  Vec<double, Dim> sum{};
  for (const Vec<double, Dim>& corner : corners) sum += corner;
  return (1.0 / static_cast<double>(corners.size())) * sum;
}

// Edge that leaves corner c along direction d, pointing to increasing index.
template <int Dim>
Vec<double, Dim> corner_edge(const CellCorners<Dim>& corners, std::size_t c, int d) {
  const std::size_t bit = std::size_t{1} << d;
  return corners[c | bit] - corners[c & ~bit];
}

template <int Dim>
double norm(const Vec<double, Dim>& a) {
  return std::sqrt(dot(a, a));
}

inline double determinant(const std::array<Vec<double, 2>, 2>& e) {
  return e[0][0] * e[1][1] - e[0][1] * e[1][0];
}
inline double determinant(const std::array<Vec<double, 3>, 3>& e) { return dot(e[0], cross(e[1], e[2])); }

// Determinant of the edges that meet in corner c.
template <int Dim>
double corner_determinant(const CellCorners<Dim>& corners, std::size_t c) {
  std::array<Vec<double, Dim>, Dim> edges;
  for (std::size_t d = 0; d < Dim; ++d) edges[d] = corner_edge<Dim>(corners, c, static_cast<int>(d));
  return determinant(edges);
}

// Signed area of the quadrilateral.
inline double cell_volume(const CellCorners<2>& x) {
  return 0.5 * determinant(std::array{x[3] - x[0], x[2] - x[1]});
}

// Signed volume of the trilinear hexahedron: two Gauss points a direction integrate its
// Jacobian determinant, quadratic in each coordinate, exactly.
inline double cell_volume(const CellCorners<3>& x) {
  constexpr std::array<double, 2> points{0.21132486540518711775, 0.78867513459481288225};
  double volume = 0.0;
  for (int gauss = 0; gauss < 8; ++gauss) {
    std::array<double, 3> t{};
    for (std::size_t d = 0; d < 3; ++d) t[d] = points[static_cast<std::size_t>(gauss >> d & 1)];
    std::array<Vec<double, 3>, 3> tangents{};
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t c = 0; c < 8; ++c) {
        double weight = (c >> d & 1) != 0 ? 1.0 : -1.0;
        for (std::size_t e = 0; e < 3; ++e)
          if (e != d) weight *= (c >> e & 1) != 0 ? t[e] : 1.0 - t[e];
        tangents[d] += weight * x[c];
      }
    volume += determinant(tangents) / 8.0;
  }
  return volume;
}

}  // namespace wingbeat
