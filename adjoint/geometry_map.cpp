#include "adjoint/geometry_map.hpp"

#include <tuple>

#include "core/mesh/metrics.hpp"
#include "core/number/math.hpp"

namespace wingbeat {
namespace {

template <int Dim>
Box<Dim> faces_of(const LocalBlock<Dim>& block, int d) {
  Box<Dim> faces = grown(box_of<Dim>(block.extents), 1);
  ++faces.end[static_cast<std::size_t>(d)];
  return faces;
}

template <int Dim, class T>
FaceMetrics<Dim, T> metrics_of(const std::array<Vec<T, Dim>, face_corner_count<Dim>>& corners) {
  return std::apply([](const auto&... corner) { return face_metrics(corner...); }, corners);
}

// The cells of the block below and above a face: -1 where there is none of its own.
struct Beside {
  std::ptrdiff_t below = -1, above = -1;
};
template <int Dim>
Beside cells_beside(const Index<Dim>& extents, Index<Dim> face, int d) {
  const Box<Dim> cells = box_of<Dim>(extents);
  const auto number = [&](const Index<Dim>& cell) -> std::ptrdiff_t {
    if (!cells.contains(cell)) return -1;
    std::ptrdiff_t at = 0, stride = 1;
    for (std::size_t e = 0; e < Dim; ++e) {
      at += cell[e] * stride;
      stride *= extents[e];
    }
    return at;
  };
  Beside beside;
  beside.above = number(face);
  --face[static_cast<std::size_t>(d)];
  beside.below = number(face);
  return beside;
}

// Moment of an area vector at the axis, z component.
template <int Dim, class T, class A>
auto axis_moment(const Vec<A, 2>& axis, const Vec<T, Dim>& normal) {
  return axis[0] * normal[1] - axis[1] * normal[0];
}

}  // namespace

template <int Dim>
BlockGeometry<Dim> geometry_change(const LocalBlock<Dim>& block, const BlockArray<int, Dim>& local,
                                   const BlockGeometry<Dim>& at, const Vec<double, 2>& axis,
                                   std::span<const Vec<double, Dim>> nodes,
                                   const Vec<double, 2>& axis_change) {
  using D = Dual<double, 1>;
  BlockGeometry<Dim> change(at.layout);
  for (int d = 0; d < Dim; ++d)
    for_each(faces_of(block, d), [&](const Index<Dim>& f) {
      std::array<Vec<D, Dim>, face_corner_count<Dim>> corners;
      const auto indices = face_corners<Dim>(f, d);
      for (std::size_t k = 0; k < indices.size(); ++k) {
        corners[k] = lifted<D>(block.nodes(indices[k]));
        if (const int node = local(indices[k]); node >= 0)
          for (int c = 0; c < Dim; ++c) corners[k][c].gradient[0] = nodes[static_cast<std::size_t>(node)][c];
      }
      const FaceMetrics<Dim, D> face = metrics_of<Dim, D>(corners);
      Vec<D, 2> moving_axis = lifted<D>(axis);
      for (int c = 0; c < 2; ++c) moving_axis[c].gradient[0] = axis_change[c];
      const auto o = static_cast<std::size_t>(at.layout.offset(f));
      for (int c = 0; c < Dim; ++c) change.normal[d][c][o] = face.normal[c].gradient[0];
      change.moment[d][o] = (face.moment_z - axis_moment(moving_axis, face.normal)).gradient[0];
      const double volume = face.volume_flux.gradient[0] / Dim;
      const auto [below, above] = cells_beside<Dim>(block.extents, f, d);
      if (below >= 0) change.volume[static_cast<std::size_t>(below)] += volume;
      if (above >= 0) change.volume[static_cast<std::size_t>(above)] -= volume;
    });
  return change;
}

template <int Dim>
Vec<double, 2> add_node_sensitivity(const LocalBlock<Dim>& block, const BlockArray<int, Dim>& local,
                                    const BlockGeometry<Dim>& at, const Vec<double, 2>& axis,
                                    const BlockGeometry<Dim>& sensitivity,
                                    std::span<Vec<double, Dim>> nodes) {
  constexpr int seeds = Dim * face_corner_count<Dim>;
  using D = Dual<double, seeds>;
  Vec<double, 2> by_axis{};
  for (int d = 0; d < Dim; ++d)
    for_each(faces_of(block, d), [&](const Index<Dim>& f) {
      const auto indices = face_corners<Dim>(f, d);
      std::array<Vec<D, Dim>, face_corner_count<Dim>> corners;
      for (std::size_t k = 0; k < indices.size(); ++k)
        for (int c = 0; c < Dim; ++c)
          corners[k][c] = D::seed(block.nodes(indices[k])[c], static_cast<int>(k) * Dim + c);
      const FaceMetrics<Dim, D> face = metrics_of<Dim, D>(corners);
      const auto o = static_cast<std::size_t>(at.layout.offset(f));
      const double by_moment = sensitivity.moment[d][o];
      const auto [below, above] = cells_beside<Dim>(block.extents, f, d);
      double by_flux = 0.0;
      if (below >= 0) by_flux += sensitivity.volume[static_cast<std::size_t>(below)] / Dim;
      if (above >= 0) by_flux -= sensitivity.volume[static_cast<std::size_t>(above)] / Dim;
      D total = by_moment * (face.moment_z - axis_moment(axis, face.normal)) + by_flux * face.volume_flux;
      for (int c = 0; c < Dim; ++c) total += sensitivity.normal[d][c][o] * face.normal[c];
      for (std::size_t k = 0; k < indices.size(); ++k)
        if (const int node = local(indices[k]); node >= 0)
          for (int c = 0; c < Dim; ++c)
            nodes[static_cast<std::size_t>(node)][c] += total.gradient[static_cast<int>(k) * Dim + c];
      by_axis[0] -= by_moment * face.normal[1].value;
      by_axis[1] += by_moment * face.normal[0].value;
    });
  return by_axis;
}

template BlockGeometry<2> geometry_change<2>(const LocalBlock<2>&, const BlockArray<int, 2>&,
                                             const BlockGeometry<2>&, const Vec<double, 2>&,
                                             std::span<const Vec<double, 2>>, const Vec<double, 2>&);
template BlockGeometry<3> geometry_change<3>(const LocalBlock<3>&, const BlockArray<int, 3>&,
                                             const BlockGeometry<3>&, const Vec<double, 2>&,
                                             std::span<const Vec<double, 3>>, const Vec<double, 2>&);
template Vec<double, 2> add_node_sensitivity<2>(const LocalBlock<2>&, const BlockArray<int, 2>&,
                                                const BlockGeometry<2>&, const Vec<double, 2>&,
                                                const BlockGeometry<2>&, std::span<Vec<double, 2>>);
template Vec<double, 2> add_node_sensitivity<3>(const LocalBlock<3>&, const BlockArray<int, 3>&,
                                                const BlockGeometry<3>&, const Vec<double, 2>&,
                                                const BlockGeometry<3>&, std::span<Vec<double, 3>>);

}  // namespace wingbeat
