#pragma once

#include <array>
#include <span>
#include <vector>

#include "flow/flow_domain.hpp"

namespace wingbeat {

// Carries fields between a mesh and the next coarser one (partition/coarsening.hpp) for
// full-approximation-storage multigrid. Fields are [instance][owned cell][width], of any width;
// spans of another size are an InternalError. The two prolongations are collective, the
// restrictions need no messages.
template <int Dim>
class GridTransfer {
 public:
  // `coarse` must be the domain of a coarsened() partition of that of `fine`; it is referred to.
  GridTransfer(const FlowDomain<Dim>& fine, const FlowDomain<Dim>& coarse);

  // Means over the fine cells of a coarse cell, weighted by their volumes: states (eq:restriction).
  void restrict_mean(std::span<const double> fine, std::span<double> coarse, int instances,
                     int width = state_size<Dim>) const;
  // Sums over the fine cells of a coarse cell: residuals (eq:restriction).
  void restrict_sum(std::span<const double> fine, std::span<double> coarse, int instances,
                    int width = state_size<Dim>) const;

  // fine += a correction on the coarse mesh, linear in index space (eq:prolongation), constant beyond
  // physical boundaries.
  void prolong_add(std::span<const double> coarse, std::span<double> fine, int instances,
                   int width = state_size<Dim>) const;
  // fine = a field on the coarse mesh, interpolated likewise but extrapolated linearly beyond
  // physical boundaries, so that fields linear in index space are exact.
  void interpolate(std::span<const double> coarse, std::span<double> fine, int instances,
                   int width = state_size<Dim>) const;

 private:
  // A fine cell among those of its coarse cell.
  struct Child {
    std::ptrdiff_t offset = 0;   // its number less that of the first of them
    std::array<int, Dim> end{};  // 0 or 1: the half of the coarse cell it lies in
  };
  struct Block {
    std::size_t first_fine = 0;
    std::size_t first_coarse = 0;
    Index<Dim> fine{};    // cells
    Index<Dim> coarse{};  // cells
    Index<Dim> ratio{};   // 2, or 1 in a direction that is not coarsened
    std::vector<Child> children;
  };

  template <class F>
  void for_each_row(const Block& block, F&& f) const;
  template <class Width, class Weight>
  void restrict_cells(const double* fine, double* coarse, Width width, Weight&& weight) const;
  template <bool Extrapolate, class Width, class Store>
  void prolong_cells(const double* coarse, const double* ghosts, double* fine, Width width,
                     Store&& store) const;
  template <bool Extrapolate, class Store>
  void prolong(std::span<const double> coarse, std::span<double> fine, int instances, int width,
               Store&& store) const;
  void check_sizes(std::size_t fine, std::size_t coarse, int instances, int width) const;
  void add_block(const FlowBlock<Dim>& fine, const FlowBlock<Dim>& coarse);

  const FlowDomain<Dim>& coarse_;
  std::size_t fine_count_ = 0;
  std::vector<Block> blocks_;
  std::vector<double> share_;  // [fine cell]: volume over that of all cells of its coarse cell
  // [coarse cell]: local numbers of the neighbours across the low and high side of each direction;
  // -1 beyond a physical boundary, the cell's own in a direction that is not coarsened.
  std::vector<std::array<std::array<int, 2>, Dim>> neighbours_;
  mutable std::vector<double> ghosts_;
};

}  // namespace wingbeat
