#include "flow/grid_transfer.hpp"

#include <algorithm>
#include <string>
#include <type_traits>

#include "core/io/error.hpp"
#include "core/mesh/coarsen.hpp"

namespace wingbeat {
namespace {

// Calls f(width), the width a constant where it is that of a state.
template <int Dim, class F>
void with_width(int width, F&& f) {
  if (width == state_size<Dim>)
    f(std::integral_constant<int, state_size<Dim>>{});
  else
    f(width);
}

}  // namespace

template <int Dim>
GridTransfer<Dim>::GridTransfer(const FlowDomain<Dim>& fine, const FlowDomain<Dim>& coarse)
    : coarse_(coarse), fine_count_(static_cast<std::size_t>(fine.owned_count())), share_(fine_count_) {
  ensure(fine.blocks().size() == coarse.blocks().size(), "the two meshes have different blocks");
  neighbours_.reserve(static_cast<std::size_t>(coarse.owned_count()));
  for (std::size_t b = 0; b < fine.blocks().size(); ++b) add_block(fine.blocks()[b], coarse.blocks()[b]);

  const auto volumes = fine.volumes();
  for (const Block& block : blocks_)
    for_each_row(block, [&](std::size_t, std::size_t first, int cells) {
      for (int i = 0; i < cells; ++i, first += static_cast<std::size_t>(block.ratio[0])) {
        double sum = 0.0;
        for (const Child& child : block.children) sum += volumes[first + child.offset];
        for (const Child& child : block.children)
          share_[first + child.offset] = volumes[first + child.offset] / sum;
      }
    });
}

template <int Dim>
void GridTransfer<Dim>::add_block(const FlowBlock<Dim>& fine, const FlowBlock<Dim>& coarse) {
  Block block;
  block.first_fine = static_cast<std::size_t>(fine.first_cell);
  block.first_coarse = static_cast<std::size_t>(coarse.first_cell);
  block.fine = fine.geometry.layout.extents;
  block.coarse = coarse.geometry.layout.extents;
  for (int d = 0; d < Dim; ++d) {
    block.ratio[d] = block.fine[d] == block.coarse[d] ? 1 : 2;
    ensure(block.fine[d] == block.ratio[d] * block.coarse[d], "a block is not the half of the fine one");
  }
  for_each(box_of<Dim>(block.ratio), [&](const Index<Dim>& end) {
    Child child{0, end};
    for (int d = Dim - 1; d >= 0; --d) child.offset = child.offset * block.fine[d] + end[d];
    block.children.push_back(child);
  });

  const auto& layout = coarse.geometry.layout;
  for_each(box_of<Dim>(block.coarse), [&](const Index<Dim>& cell) {
    auto& neighbours = neighbours_.emplace_back();
    const std::ptrdiff_t o = layout.offset(cell);
    for (int d = 0; d < Dim; ++d)
      for (int end : {0, 1}) {
        const std::ptrdiff_t step = block.ratio[d] == 1 ? 0 : layout.strides[d];
        neighbours[d][end] = coarse.number[static_cast<std::size_t>(end == 0 ? o - step : o + step)];
      }
  });
  blocks_.push_back(std::move(block));
}

// f(first coarse cell, first of the fine cells that make it, coarse cells) for each row along the
// first direction.
template <int Dim>
template <class F>
void GridTransfer<Dim>::for_each_row(const Block& block, F&& f) const {
  Index<Dim> rows = block.coarse;
  rows[0] = 1;
  std::size_t coarse = block.first_coarse;
  for_each(box_of<Dim>(rows), [&](const Index<Dim>& row) {
    std::size_t fine = 0;
    for (int d = Dim - 1; d >= 0; --d)
      fine =
          fine * static_cast<std::size_t>(block.fine[d]) + static_cast<std::size_t>(row[d] * block.ratio[d]);
    f(coarse, block.first_fine + fine, block.coarse[0]);
    coarse += static_cast<std::size_t>(block.coarse[0]);
  });
}

template <int Dim>
template <class Width, class Weight>
void GridTransfer<Dim>::restrict_cells(const double* fine, double* coarse, Width width,
                                       Weight&& weight) const {
  for (const Block& block : blocks_)
    for_each_row(block, [&](std::size_t cell, std::size_t first, int cells) {
      double* out = coarse + cell * width;
      for (int i = 0; i < cells; ++i, out += width, first += static_cast<std::size_t>(block.ratio[0])) {
        std::fill_n(out, width, 0.0);
        for (const Child& child : block.children) {
          const std::size_t number = first + child.offset;
          const double factor = weight(number);
          const double* in = fine + number * width;
          for (int v = 0; v < width; ++v) out[v] += factor * in[v];
        }
      }
    });
}

template <int Dim>
void GridTransfer<Dim>::restrict_mean(std::span<const double> fine, std::span<double> coarse, int instances,
                                      int width) const {
  check_sizes(fine.size(), coarse.size(), instances, width);
  with_width<Dim>(width, [&](auto n) {
    for (int i = 0; i < instances; ++i)
      restrict_cells(fine.data() + i * fine_count_ * n,
                     coarse.data() + static_cast<std::size_t>(i) * coarse_.owned_count() * n, n,
                     [&](std::size_t cell) { return share_[cell]; });
  });
}

template <int Dim>
void GridTransfer<Dim>::restrict_sum(std::span<const double> fine, std::span<double> coarse, int instances,
                                     int width) const {
  check_sizes(fine.size(), coarse.size(), instances, width);
  with_width<Dim>(width, [&](auto n) {
    for (int i = 0; i < instances; ++i)
      restrict_cells(fine.data() + i * fine_count_ * n,
                     coarse.data() + static_cast<std::size_t>(i) * coarse_.owned_count() * n, n,
                     [](std::size_t) { return 1.0; });
  });
}

template <int Dim>
template <bool Extrapolate, class Width, class Store>
void GridTransfer<Dim>::prolong_cells(const double* coarse, const double* ghosts, double* fine, Width width,
                                      Store&& store) const {
  const int owned = coarse_.owned_count();
  const auto value = [&](int number) {
    return number < owned ? coarse + static_cast<std::ptrdiff_t>(number) * width
                          : ghosts + static_cast<std::ptrdiff_t>(number - owned) * width;
  };
  for (const Block& block : blocks_)
    for_each_row(block, [&](std::size_t cell, std::size_t first, int cells) {
      for (int i = 0; i < cells; ++i, ++cell, first += static_cast<std::size_t>(block.ratio[0])) {
        const double* own = coarse + cell * width;
        // The neighbour's value is own + factor (other - own).
        std::array<std::array<const double*, 2>, Dim> other;
        std::array<std::array<double, 2>, Dim> factor;
        for (int d = 0; d < Dim; ++d)
          for (int end : {0, 1}) {
            const int number = neighbours_[cell][d][end], opposite = neighbours_[cell][d][1 - end];
            const bool beyond = number < 0;
            const bool extrapolates = Extrapolate && beyond && opposite >= 0;
            other[d][end] = beyond ? (extrapolates ? value(opposite) : own) : value(number);
            factor[d][end] = extrapolates ? -0.25 : 0.25;
          }
        for (const Child& child : block.children) {
          double* out = fine + (first + child.offset) * width;
          for (int v = 0; v < width; ++v) {
            double result = own[v];
            for (int d = 0; d < Dim; ++d)
              result += factor[d][child.end[d]] * (other[d][child.end[d]][v] - own[v]);
            store(out[v], result);
          }
        }
      }
    });
}

template <int Dim>
template <bool Extrapolate, class Store>
void GridTransfer<Dim>::prolong(std::span<const double> coarse, std::span<double> fine, int instances,
                                int width, Store&& store) const {
  check_sizes(fine.size(), coarse.size(), instances, width);
  const std::size_t owned = static_cast<std::size_t>(coarse_.owned_count());
  const std::size_t ghosts = static_cast<std::size_t>(coarse_.ghost_count());
  ghosts_.resize(ghosts * instances * width);
  coarse_.exchange().template gather<double>(coarse, ghosts_, instances, width);
  with_width<Dim>(width, [&](auto n) {
    for (int i = 0; i < instances; ++i)
      prolong_cells<Extrapolate>(coarse.data() + i * owned * n, ghosts_.data() + i * ghosts * n,
                                 fine.data() + i * fine_count_ * n, n, store);
  });
}

template <int Dim>
void GridTransfer<Dim>::prolong_add(std::span<const double> coarse, std::span<double> fine, int instances,
                                    int width) const {
  prolong<false>(coarse, fine, instances, width, [](double& to, double value) { to += value; });
}

template <int Dim>
void GridTransfer<Dim>::interpolate(std::span<const double> coarse, std::span<double> fine, int instances,
                                    int width) const {
  prolong<true>(coarse, fine, instances, width, [](double& to, double value) { to = value; });
}

template <int Dim>
void GridTransfer<Dim>::check_sizes(std::size_t fine, std::size_t coarse, int instances, int width) const {
  ensure(instances > 0 && width > 0, "a transfer needs at least one instance and one value a cell");
  const std::size_t entry = static_cast<std::size_t>(instances) * width;
  const auto check = [](const char* what, std::size_t size, std::size_t expected) {
    ensure(size == expected, std::string(what) + " field holds " + std::to_string(size) +
                                 " values instead of " + std::to_string(expected));
  };
  check("the fine", fine, fine_count_ * entry);
  check("the coarse", coarse, static_cast<std::size_t>(coarse_.owned_count()) * entry);
}

template class GridTransfer<2>;
template class GridTransfer<3>;

}  // namespace wingbeat
