#include "core/algebra/block_sparse.hpp"

#include <algorithm>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// The stretch of B values of a column, which is owned or a ghost.
template <int B, class Pointer>
Pointer column_values(Pointer owned, Pointer ghosts, int column, int owned_count) {
  return column < owned_count ? owned + static_cast<std::ptrdiff_t>(column) * B
                              : ghosts + static_cast<std::ptrdiff_t>(column - owned_count) * B;
}

template <int B>
void check_sizes(const BlockPattern& pattern, std::size_t rows, std::size_t owned, std::size_t ghosts) {
  const auto row_values = static_cast<std::size_t>(pattern.row_count) * B;
  const auto ghost_values = static_cast<std::size_t>(pattern.column_count - pattern.row_count) * B;
  ensure(rows == row_values && owned == row_values && ghosts == ghost_values,
         "BlockSparse: vector of a wrong size");
}

}  // namespace

int BlockPattern::find(int row, int column) const {
  const auto begin = columns.begin() + row_begin[row];
  const auto end = columns.begin() + row_begin[row + 1];
  const auto found = std::lower_bound(begin, end, column);
  return found != end && *found == column ? static_cast<int>(found - columns.begin()) : -1;
}

template <int B>
void BlockSparse<B>::multiply_add(std::span<const double> x_owned, std::span<const double> x_ghosts,
                                  std::span<double> y) const {
  const BlockPattern& p = *pattern_;
  check_sizes<B>(p, y.size(), x_owned.size(), x_ghosts.size());
  for (int row = 0; row < p.row_count; ++row) {
    // One accumulator an entry of the block: vector products all along the row, one sum at its end.
    double products[B][B] = {};
    for (int k = p.row_begin[row]; k < p.row_begin[row + 1]; ++k) {
      const double* const a = values_.data() + static_cast<std::size_t>(k) * B * B;
      const double* const x = column_values<B>(x_owned.data(), x_ghosts.data(), p.columns[k], p.row_count);
      for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c) products[r][c] += a[r * B + c] * x[c];
    }
    double* const target = y.data() + static_cast<std::size_t>(row) * B;
    for (int r = 0; r < B; ++r) {
      double sum = products[r][0];
      for (int c = 1; c < B; ++c) sum += products[r][c];
      target[r] += sum;
    }
  }
}

template <int B>
void BlockSparse<B>::transpose_multiply_add(std::span<const double> x, std::span<double> y_owned,
                                            std::span<double> y_ghosts) const {
  const BlockPattern& p = *pattern_;
  check_sizes<B>(p, x.size(), y_owned.size(), y_ghosts.size());
  for (int row = 0; row < p.row_count; ++row) {
    const double* const source = x.data() + static_cast<std::size_t>(row) * B;
    for (int k = p.row_begin[row]; k < p.row_begin[row + 1]; ++k) {
      const double* const a = values_.data() + static_cast<std::size_t>(k) * B * B;
      double* const y = column_values<B>(y_owned.data(), y_ghosts.data(), p.columns[k], p.row_count);
      double sums[B] = {};
      for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c) sums[c] += a[r * B + c] * source[r];
      for (int c = 0; c < B; ++c) y[c] += sums[c];
    }
  }
}

template class BlockSparse<1>;
template class BlockSparse<3>;
template class BlockSparse<4>;
template class BlockSparse<5>;

}  // namespace wingbeat
