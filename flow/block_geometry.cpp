#include "flow/block_geometry.hpp"

#include "core/mesh/metrics.hpp"
#include "core/number/math.hpp"

namespace wingbeat {
namespace {

Index<2> above(Index<2> node, int d) { return ++node[d], node; }

// Face `f` of direction d, with its low corner at node f.
FaceMetrics<2> face_at(const BlockArray<Vec<double, 2>, 2>& nodes, const Index<2>& f, int d) {
  return d == 0 ? face_metrics(nodes(f), nodes(above(f, 1))) : face_metrics(nodes(above(f, 0)), nodes(f));
}

FaceMetrics<3> face_at(const BlockArray<Vec<double, 3>, 3>& nodes, const Index<3>& f, int d) {
  const int s = (d + 1) % 3, t = (d + 2) % 3;
  Index<3> f10 = f, f01 = f, f11 = f;
  ++f10[s], ++f01[t], ++f11[s], ++f11[t];
  return face_metrics(nodes(f), nodes(f10), nodes(f01), nodes(f11));
}

}  // namespace

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
      const FaceMetrics<Dim> face = face_at(block.nodes, f, d);
      const auto o = static_cast<std::size_t>(layout.offset(f));
      for (int c = 0; c < Dim; ++c) normal[d][c][o] = face.normal[c];
      moment[d][o] = face.moment_z - (axis[0] * face.normal[1] - axis[1] * face.normal[0]);
    });

    std::size_t cell = 0;
    for_each(cells, [&](const Index<Dim>& low) {
      Index<Dim> high = low;
      ++high[d];
      volume[cell++] +=
          (face_at(block.nodes, high, d).volume_flux - face_at(block.nodes, low, d).volume_flux) / Dim;
    });
  }
}

template struct BlockLayout<2>;
template struct BlockLayout<3>;
template struct BlockGeometry<2>;
template struct BlockGeometry<3>;

}  // namespace wingbeat
