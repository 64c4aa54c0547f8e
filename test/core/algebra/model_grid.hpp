#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "core/algebra/block_sparse.hpp"
#include "core/algebra/linear_operator.hpp"
#include "core/parallel/comm.hpp"
#include "core/parallel/ghost_exchange.hpp"

namespace wingbeat::test {

// Irregular, yet smooth enough that round-off of the seed does not show.
inline double noise(double seed) { return std::sin(37.0 * seed + 1.0); }

// Convection-diffusion of B coupled quantities on ni x nj cells, periodic in i, divided among the
// ranks in strips of i. The stencil reaches two cells along each direction.
template <int B>
struct ModelGrid {
  int ni, nj, ranks, rank;
  std::vector<long> cells;  // global number of each owned cell
  GhostExchange halo;
  std::shared_ptr<const BlockPattern> pattern;

  ModelGrid(const Comm& comm, int ni_, int nj_) : ni(ni_), nj(nj_), ranks(comm.size()), rank(comm.rank()) {
    for (long g = 0; g < static_cast<long>(ni) * nj; ++g)
      if (owner(g) == rank) cells.push_back(g);
    auto p = std::make_shared<BlockPattern>();
    p->row_count = static_cast<int>(cells.size());
    std::set<long> foreign;
    for (const long g : cells)
      for (const long c : neighbours(g))
        if (owner(c) != rank) foreign.insert(c);
    std::map<long, int> ghost_number;
    std::vector<GhostSource> sources;
    for (const long c : foreign) {
      ghost_number[c] = p->row_count + static_cast<int>(sources.size());
      sources.push_back({owner(c), index_at_owner(c)});
    }
    halo = GhostExchange(comm, sources);
    p->column_count = p->row_count + static_cast<int>(sources.size());
    p->row_begin = {0};
    for (const long g : cells) {
      std::vector<int> columns;
      for (const long c : neighbours(g))
        columns.push_back(owner(c) == rank ? index_at_owner(c) : ghost_number[c]);
      std::sort(columns.begin(), columns.end());
      p->columns.insert(p->columns.end(), columns.begin(), columns.end());
      p->row_begin.push_back(static_cast<int>(p->columns.size()));
      for (const int column : columns)
        column_cells.push_back(column < p->row_count ? cells[column]
                                                     : *std::next(foreign.begin(), column - p->row_count));
    }
    pattern = p;
  }

  int owner(long g) const { return static_cast<int>(g % ni) * ranks / ni; }
  int index_at_owner(long g) const {
    int index = 0;
    for (long c = 0; c < g; ++c) index += owner(c) == owner(g) ? 1 : 0;
    return index;
  }
  // The cell and those its row reaches; one-way at the lowest cells, as near a wall.
  std::vector<long> neighbours(long g) const {
    const long i = g % ni, j = g / ni;
    std::vector<long> result{g};
    for (const long di : {-2, -1, 1, 2}) result.push_back((i + di + ni) % ni + ni * j);
    for (const long dj : {-2, -1, 1, 2})
      if (j + dj >= 0 && j + dj < nj && !(j == 0 && dj == 2)) result.push_back(i + ni * (j + dj));
    return result;
  }
  // Entry (r, s) of block (row, column): not symmetric, the diagonal hardly dominant.
  static double entry(long row, long column, int r, int s) {
    const double random =
        noise(0.37 * static_cast<double>(row) + 1.13 * static_cast<double>(column) + 7 * r + 31 * s);
    if (row == column) return (r == s ? 6.0 : 0.0) + 0.5 * random;
    const double drift = column < row ? -1.0 : -0.6;
    return (r == s ? drift : 0.0) + 0.1 * random;
  }

  BlockSparse<B> matrix() const {
    BlockSparse<B> a(pattern);
    for (int row = 0; row < pattern->row_count; ++row)
      for (int k = pattern->row_begin[row]; k < pattern->row_begin[row + 1]; ++k)
        for (int r = 0; r < B; ++r)
          for (int s = 0; s < B; ++s) a.block(k)[r * B + s] = entry(cells[row], column_cells[k], r, s);
    return a;
  }

  // A field that does not depend on the number of ranks.
  template <class T>
  std::vector<T> field(double seed) const {
    std::vector<T> x;
    for (const long g : cells)
      for (int r = 0; r < B; ++r) {
        const double at = seed + 0.71 * static_cast<double>(g) + 5.3 * r;
        if constexpr (std::is_same_v<T, double>)
          x.push_back(noise(at));
        else
          x.push_back({noise(at), noise(at + 0.5)});
      }
    return x;
  }
  template <class T>
  std::vector<T> shift() const {
    std::vector<T> values;
    for (const long g : cells) values.push_back(shift_of<T>(g));
    return values;
  }
  template <class T>
  static T shift_of(long g) {
    const double size = 0.3 + 0.2 * noise(static_cast<double>(g));
    if constexpr (std::is_same_v<T, double>)
      return size;
    else
      return {0.1, size};
  }

  std::vector<long> column_cells;  // global number of each block's column
};

// matrix + shift, with its halo exchange, on real or complex vectors.
template <class T, int B>
class ShiftedOperator final : public LinearOperator<T> {
 public:
  ShiftedOperator(const ModelGrid<B>& grid, const BlockSparse<B>& matrix, std::vector<T> shift)
      : grid_(grid), matrix_(matrix), shift_(std::move(shift)) {}

  std::size_t local_size() const override { return grid_.cells.size() * B; }
  void apply(std::span<const T> x, std::span<T> y) const override {
    run(x, y, [&](std::span<const double> part, std::span<double> result) {
      std::vector<double> ghosts(grid_.halo.ghost_count() * B);
      grid_.halo.template gather<double>(part, ghosts, 1, B);
      matrix_.multiply_add(part, ghosts, result);
    });
  }
  void apply_transpose(std::span<const T> x, std::span<T> y) const override {
    run(x, y, [&](std::span<const double> part, std::span<double> result) {
      std::vector<double> ghosts(grid_.halo.ghost_count() * B);
      matrix_.transpose_multiply_add(part, result, ghosts);
      grid_.halo.template scatter_add<double>(ghosts, result, 1, B);
    });
  }

 private:
  template <class Multiply>
  void run(std::span<const T> x, std::span<T> y, const Multiply& multiply) const {
    std::vector<double> real(x.size()), imaginary(x.size()), product(x.size()), other(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      real[i] = std::real(x[i]);
      imaginary[i] = std::imag(x[i]);
    }
    multiply(real, product);
    multiply(imaginary, other);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if constexpr (std::is_same_v<T, double>)
        y[i] = product[i] + shift_[i / B] * x[i];
      else
        y[i] = T(product[i], other[i]) + shift_[i / B] * x[i];
    }
  }

  const ModelGrid<B>& grid_;
  const BlockSparse<B>& matrix_;
  std::vector<T> shift_;
};

// Sum of a_i b_i over all ranks, without conjugation: what a transpose is about.
template <class T>
T bilinear(const Comm& comm, const std::vector<T>& a, const std::vector<T>& b) {
  T sum(0);
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return comm.sum(sum);
}

template <class T>
double norm(const Comm& comm, const std::vector<T>& a) {
  double sum = 0.0;
  for (const T& value : a) sum += std::norm(value);
  return std::sqrt(comm.sum(sum));
}

template <class T>
double distance(const Comm& comm, const std::vector<T>& a, std::vector<T> b) {
  for (std::size_t i = 0; i < b.size(); ++i) b[i] -= a[i];
  return norm(comm, b);
}

}  // namespace wingbeat::test
