#pragma once

#include <cstddef>
#include <experimental/simd>

namespace wingbeat {

// The N variables of one cell in one vector, as passes over arrays of [cell][variable] take them.
template <int N>
using CellVector = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, N>>;

template <int N>
CellVector<N> load_cell(const double* values) {
  return CellVector<N>(values, std::experimental::element_aligned);
}
template <int N>
void store_cell(const CellVector<N>& x, double* values) {
  x.copy_to(values, std::experimental::element_aligned);
}

}  // namespace wingbeat
