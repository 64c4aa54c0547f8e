#include "flow/block_geometry.hpp"

#include <tuple>

#include "core/mesh/metrics.hpp"
#include "core/number/math.hpp"

namespace wingbeat {
namespace {

template <int Dim>
FaceMetrics<Dim> face_at(const BlockArray<Vec<double, Dim>, Dim>& nodes, const Index<Dim>& f, int d) {
  return std::apply([&](const auto&... corner) { return face_metrics(nodes(corner)...); },
                    face_corners<Dim>(f, d));
}

}  // namespace

template <>
std::array<Index<2>, 2> face_corners<2>(const Index<2>& f, int d) {
  if (d == 0) return {f, {f[0], f[1] + 1}};
  return {Index<2>{f[0] + 1, f[1]}, f};
}

template <>
std::array<Index<3>, 4> face_corners<3>(const Index<3>& f, int d) {
  const auto s = static_cast<std::size_t>((d + 1) % 3), t = static_cast<std::size_t>((d + 2) % 3);
  std::array<Index<3>, 4> corners{f, f, f, f};
  ++corners[1][s], ++corners[2][t], ++corners[3][s], ++corners[3][t];
  return corners;
}

template <int Dim>
BlockLayout<Dim>::BlockLayout(const Index<Dim>& cells) : extents(cells) {
  std::ptrdiff_t step = 1;
  for (int d = 0; d < Dim; ++d) {
    strides[d] = step;
    origin += halo_layers * step;
    step *= cells[d] + 2 * halo_layers;
  }
  size = static_cast<std::size_t>(step) + lanes<Pack>;
}

template <int Dim>
BlockGeometry<Dim>::BlockGeometry(const LocalBlock<Dim>& block, const Vec<double, 2>& axis)
    : layout(block.extents) {
  const Box<Dim> cells = box_of<Dim>(block.extents);
  volume.assign(cells.size(), 0.0);
  for (int d = 0; d < Dim; ++d) {
    // Never-used corners get a unit area, so that sweeps over them stay finite.
    for (int c = 0; c < Dim; ++c) normal[d][c].assign(layout.size, c == d ? 1.0 : 0.0);
    moment[d].assign(layout.size, 0.0);

    Box<Dim> faces = grown(cells, 1);
    ++faces.end[d];
    for_each(faces, [&](const Index<Dim>& f) {
      const FaceMetrics<Dim> face = face_at<Dim>(block.nodes, f, d);
      const auto o = static_cast<std::size_t>(layout.offset(f));
      for (int c = 0; c < Dim; ++c) normal[d][c][o] = face.normal[c];
      moment[d][o] = face.moment_z - (axis[0] * face.normal[1] - axis[1] * face.normal[0]);
    });

    std::size_t cell = 0;
    for_each(cells, [&](const Index<Dim>& low) {
      Index<Dim> high = low;
      ++high[d];
      volume[cell++] +=
          (face_at<Dim>(block.nodes, high, d).volume_flux - face_at<Dim>(block.nodes, low, d).volume_flux) /
          Dim;
    });
  }
}

template <int Dim>
BlockGeometry<Dim>::BlockGeometry(const BlockLayout<Dim>& zero_layout) : layout(zero_layout) {
  for (auto& direction : normal)
    for (auto& values : direction) values.assign(layout.size, 0.0);
  for (auto& values : moment) values.assign(layout.size, 0.0);
  volume.assign(box_of<Dim>(layout.extents).size(), 0.0);
}

template struct BlockLayout<2>;
template struct BlockLayout<3>;
template struct BlockGeometry<2>;
template struct BlockGeometry<3>;

}  // namespace wingbeat
