#pragma once

#include <array>
#include <vector>

#include "core/mesh/block_array.hpp"
#include "partition/local_mesh.hpp"

namespace wingbeat {

// Where the values of a block lie in its arrays: cells and faces share one layout, two halo
// layers wide, the first index fastest. Face f of direction d lies at the offset of the cell
// above it. A sweep is then one loop over offsets, halos included, whatever Dim is; the padding
// lets the last pack of a sweep run past the end.
template <int Dim>
struct BlockLayout {
  Index<Dim> extents{};
  std::array<std::ptrdiff_t, Dim> strides{};
  std::ptrdiff_t origin = 0;
  std::size_t size = 0;

  explicit BlockLayout(const Index<Dim>& cells);

  std::ptrdiff_t offset(const Index<Dim>& cell) const {
    std::ptrdiff_t position = origin;
    for (int d = 0; d < Dim; ++d) position += cell[d] * strides[d];
    return position;
  }
  // Offsets [first, last) that cover the cells of `box`.
  std::ptrdiff_t first(const Box<Dim>& box) const { return offset(box.begin); }
  std::ptrdiff_t last(const Box<Dim>& box) const {
    Index<Dim> back = box.end;
    for (int& index : back) --index;
    return offset(back) + 1;
  }
};

// Area vectors and moments of a block's faces, and its cells' volumes, on the mesh at rest.
// Faces of the first halo layer are included. Normals point along their direction.
template <int Dim>
struct BlockGeometry {
  BlockLayout<Dim> layout;
  std::array<std::array<std::vector<double>, Dim>, Dim> normal;  // [direction][component][offset]
  std::array<std::vector<double>, Dim>
      moment;                  // [direction][offset]: about the axis of rotation, z component
  std::vector<double> volume;  // [cell of the block]

  // `axis`: a point of the axis of rotation, which is parallel to z.
  BlockGeometry(const LocalBlock<Dim>& block, const Vec<double, 2>& axis);
  // All zero: to hold a change of a geometry, or sensitivities to it.
  explicit BlockGeometry(const BlockLayout<Dim>& zero_layout);
};

// Nodes of face f of direction d, in the order that face_metrics takes.
template <int Dim>
inline constexpr int face_corner_count = 1 << (Dim - 1);
template <int Dim>
std::array<Index<Dim>, face_corner_count<Dim>> face_corners(const Index<Dim>& f, int d);

}  // namespace wingbeat
