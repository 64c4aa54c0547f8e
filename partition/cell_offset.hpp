#pragma once

#include "core/mesh/block_array.hpp"

namespace wingbeat {

// Position of a cell among the cells of a box, the first index fastest.
template <int Dim>
std::size_t cell_offset(const Box<Dim>& box, const Index<Dim>& cell) {
  std::size_t offset = 0;
  for (int d = Dim - 1; d >= 0; --d)
    offset =
        offset * static_cast<std::size_t>(box.extent(d)) + static_cast<std::size_t>(cell[d] - box.begin[d]);
  return offset;
}

}  // namespace wingbeat
