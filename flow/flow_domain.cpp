#include "flow/flow_domain.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

// The layer of positions `layer` cells beyond a side (negative: within the block).
template <int Dim>
Box<Dim> layer_beyond(const Index<Dim>& extents, int direction, int end, int layer) {
  Box<Dim> box = box_of<Dim>(extents);
  const int position = end == 0 ? -layer : extents[direction] - 1 + layer;
  box.begin[direction] = position;
  box.end[direction] = position + 1;
  return box;
}

// Every row reaches two cells to each side in each direction.
template <int Dim>
BlockPattern stencil_pattern(const std::vector<FlowBlock<Dim>>& blocks, int owned_count, int column_count) {
  BlockPattern pattern;
  pattern.row_count = owned_count;
  pattern.column_count = column_count;
  pattern.row_begin.assign(1, 0);
  for (const auto& block : blocks)
    for_each(box_of<Dim>(block.geometry.layout.extents), [&](const Index<Dim>& cell) {
      const auto& layout = block.geometry.layout;
      const std::ptrdiff_t o = layout.offset(cell);
      std::vector<int> row{block.number[static_cast<std::size_t>(o)]};
      for (int d = 0; d < Dim; ++d)
        for (int step : {-2, -1, 1, 2}) {
          const int number = block.number[static_cast<std::size_t>(o + step * layout.strides[d])];
          if (number >= 0) row.push_back(number);
        }
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
      pattern.columns.insert(pattern.columns.end(), row.begin(), row.end());
      pattern.row_begin.push_back(static_cast<int>(pattern.columns.size()));
    });
  return pattern;
}

}  // namespace

template <int Dim>
FlowBlock<Dim>::FlowBlock(const LocalBlock<Dim>& block, const Vec<double, 2>& axis)
    : first_cell(block.first_cell), geometry(block, axis) {
  const auto& layout = geometry.layout;
  number.assign(layout.size, -1);
  for_each(grown(box_of<Dim>(block.extents), halo_layers), [&](const Index<Dim>& cell) {
    number[static_cast<std::size_t>(layout.offset(cell))] = block.cell_number(cell);
  });

  for (int d = 0; d < Dim; ++d)
    for (int end : {0, 1})
      for (int layer = 1; layer <= halo_layers; ++layer)
        for_each(layer_beyond<Dim>(block.extents, d, end, layer), [&](const Index<Dim>& cell) {
          const std::ptrdiff_t o = layout.offset(cell);
          const std::ptrdiff_t inward = end == 0 ? layout.strides[d] : -layout.strides[d];
          const int neighbour = number[static_cast<std::size_t>(o)];
          if (neighbour >= 0) {
            halo.push_back({o, neighbour});
            return;
          }
          const bool thin = number[static_cast<std::size_t>(o + 2 * inward)] < 0 && layer == 1;
          extrapolated.push_back({o, o + inward, thin ? o + inward : o + 2 * inward});
        });

  for (const auto& patch : block.patches) {
    const int d = patch.side.direction;
    for_each(patch.cells, [&](const Index<Dim>& cell) {
      BoundaryFace face;
      face.type = patch.type;
      face.direction = d;
      face.outward = patch.side.end == 0 ? -1.0 : 1.0;
      face.first = layout.offset(cell);
      face.face = patch.side.end == 0 ? face.first : face.first + layout.strides[d];
      const std::ptrdiff_t inner =
          face.first + (patch.side.end == 0 ? layout.strides[d] : -layout.strides[d]);
      face.second = number[static_cast<std::size_t>(inner)] >= 0 ? inner : face.first;
      boundary.push_back(face);
    });
  }
}

template <int Dim>
FlowDomain<Dim>::FlowDomain(const Comm& comm, const LocalMesh<Dim>& mesh, const Vec<double, 2>& axis)
    : comm_(comm), axis_(axis), owned_count_(mesh.owned_count), exchange_(comm, mesh.ghosts) {
  for (const auto& block : mesh.blocks) {
    blocks_.emplace_back(block, axis);
    const auto& volume = blocks_.back().geometry.volume;
    volumes_.insert(volumes_.end(), volume.begin(), volume.end());
  }
  pattern_ = std::make_shared<const BlockPattern>(
      stencil_pattern(blocks_, owned_count_, owned_count_ + static_cast<int>(mesh.ghosts.size())));
}

template struct FlowBlock<2>;
template struct FlowBlock<3>;
template class FlowDomain<2>;
template class FlowDomain<3>;

}  // namespace wingbeat
