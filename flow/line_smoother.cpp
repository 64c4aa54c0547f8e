#include "flow/line_smoother.hpp"

#include <algorithm>

#include "flow/cell_vector.hpp"

namespace wingbeat {
namespace {

// Spikes are cut off below this fraction of the jump.
constexpr double negligible = 1e-6;

// Lines that are swept together, so that one's recurrence does not wait for itself: cell k of line
// l lies at first + k step + l across.
struct LineGroup {
  std::size_t first;
  std::size_t step;
  std::size_t across;
  int count;
};

constexpr int group_size = 8;

template <class F>
void for_each_group(const MeshLines& lines, F&& f) {
  const auto step = static_cast<std::size_t>(lines.inner);
  if (lines.inner > 1) {
    for (int o = 0; o < lines.outer; ++o) f(LineGroup{lines.cell(o * lines.inner, 0), step, 1, lines.inner});
    return;
  }
  for (int o = 0; o < lines.outer; o += group_size)
    f(LineGroup{lines.cell(o, 0), step, static_cast<std::size_t>(lines.length),
                std::min(group_size, lines.outer - o)});
}

// Eliminates along the lines, from their first cells or backwards from their last.
void eliminate(const MeshLines& lines, std::span<const double> eps, bool backwards, double* pivot,
               double* transfer) {
  for_each_group(lines, [&](const LineGroup& group) {
    for (int i = 0; i < lines.length; ++i) {
      const int k = backwards ? lines.length - 1 - i : i;
      const std::size_t row = group.first + static_cast<std::size_t>(k) * group.step;
      const double neighbours = (k > 0) + (k < lines.length - 1);
      for (int l = 0; l < group.count; ++l) {
        const std::size_t c = row + static_cast<std::size_t>(l) * group.across;
        const double before = i == 0 ? 0.0 : transfer[backwards ? c + group.step : c - group.step];
        pivot[c] = 1.0 / (1.0 + eps[c] * (neighbours - before));
        transfer[c] = eps[c] * pivot[c];
      }
    }
  });
}

// Forward and backward substitution in `Count` lines of consecutive cells, interleaved.
template <int N, int Count>
void solve_along(const double* pivot, const double* transfer, int length, double* values) {
  CellVector<N> x[Count];
  for (int l = 0; l < Count; ++l) x[l] = 0.0;
  for (int k = 0; k < length; ++k)
    for (int l = 0; l < Count; ++l) {
      const int c = l * length + k;
      x[l] = pivot[c] * load_cell<N>(values + c * N) + transfer[c] * x[l];
      store_cell<N>(x[l], values + c * N);
    }
  for (int k = length - 2; k >= 0; --k)
    for (int l = 0; l < Count; ++l) {
      const int c = l * length + k;
      x[l] = load_cell<N>(values + c * N) + transfer[c] * x[l];
      store_cell<N>(x[l], values + c * N);
    }
}

// The same in `inner` lines side by side, row by row.
template <int N>
void solve_across(const double* pivot, const double* transfer, int length, int inner, double* values) {
  for (int c = 0; c < inner; ++c) store_cell<N>(pivot[c] * load_cell<N>(values + c * N), values + c * N);
  for (int c = inner; c < length * inner; ++c)
    store_cell<N>(
        pivot[c] * load_cell<N>(values + c * N) + transfer[c] * load_cell<N>(values + (c - inner) * N),
        values + c * N);
  for (int k = length - 2; k >= 0; --k)
    for (int c = k * inner; c < (k + 1) * inner; ++c)
      store_cell<N>(load_cell<N>(values + c * N) + transfer[c] * load_cell<N>(values + (c + inner) * N),
                    values + c * N);
}

}  // namespace

LineSmoother::LineSmoother(const MeshLines& lines) : lines_(lines) {
  pivot_.assign(lines.cell_count(), 1.0);
  transfer_.assign(lines.cell_count(), 0.0);
}

void LineSmoother::factorize(std::span<const double> eps, const std::array<bool, 2>& spikes) {
  smooths_ = std::any_of(eps.begin(), eps.end(), [](double e) { return e > 0.0; });
  for (auto& responses : responses_)
    responses.assign(static_cast<std::size_t>(lines_.count()), EndResponse{});
  depth_ = {};
  if (!smooths_) return;
  if (spikes[0]) {
    eliminate(lines_, eps, true, pivot_.data(), transfer_.data());
    set_spike(0, transfer_);
  }
  eliminate(lines_, eps, false, pivot_.data(), transfer_.data());
  if (spikes[1]) set_spike(1, transfer_);
}

// The right-hand side of a spike is eps at the end cell and zero elsewhere. Elimination towards that
// end leaves it alone; substitution back multiplies by `decay`, the transfer factors, cell by cell.
void LineSmoother::set_spike(int end, std::span<const double> decay) {
  const auto count = static_cast<std::size_t>(lines_.count());
  std::vector<double> front(count, 1.0);
  std::vector<std::vector<double>> layers;
  auto& near = responses_[static_cast<std::size_t>(end)];
  auto& far = responses_[static_cast<std::size_t>(1 - end)];
  bool reaches = true;
  for (int distance = 0; distance < lines_.length; ++distance) {
    const int k = end == 0 ? distance : lines_.length - 1 - distance;
    for (int line = 0; line < lines_.count(); ++line)
      front[static_cast<std::size_t>(line)] *= decay[lines_.cell(line, k)];
    if (distance == 0)
      for (std::size_t l = 0; l < count; ++l) near[l].own = front[l];
    reaches = reaches && *std::max_element(front.begin(), front.end()) > negligible;
    if (reaches) layers.push_back(front);
  }
  for (std::size_t l = 0; l < count; ++l) far[l].far = front[l];

  const int depth = static_cast<int>(layers.size());
  depth_[static_cast<std::size_t>(end)] = depth;
  const MeshLines stored{0, lines_.inner, depth, lines_.outer};
  auto& spike = spike_[static_cast<std::size_t>(end)];
  spike.resize(stored.cell_count());
  for (int distance = 0; distance < depth; ++distance)
    for (int line = 0; line < lines_.count(); ++line)
      spike[stored.cell(line, distance)] =
          layers[static_cast<std::size_t>(distance)][static_cast<std::size_t>(line)];
}

template <int N>
void LineSmoother::solve(double* values) const {
  if (!smooths_) return;
  const std::size_t slab = static_cast<std::size_t>(lines_.length) * static_cast<std::size_t>(lines_.inner);
  constexpr int together = 4;
  for (int o = 0; o < lines_.outer;) {
    const std::size_t first = static_cast<std::size_t>(o) * slab;
    const double* pivot = pivot_.data() + first;
    const double* transfer = transfer_.data() + first;
    double* x = values + first * N;
    if (lines_.inner > 1) {
      solve_across<N>(pivot, transfer, lines_.length, lines_.inner, x);
      o += 1;
    } else if (o + together <= lines_.outer) {
      solve_along<N, together>(pivot, transfer, lines_.length, x);
      o += together;
    } else {
      solve_along<N, 1>(pivot, transfer, lines_.length, x);
      o += 1;
    }
  }
}

template <int N>
void LineSmoother::copy_end(int end, const double* values, double* at_end) const {
  const int position = lines_.end_position(end);
  for (int o = 0; o < lines_.outer; ++o) {
    const int line = o * lines_.inner;
    std::copy_n(values + lines_.cell(line, position) * N, lines_.inner * N, at_end + line * N);
  }
}

template <int N>
void LineSmoother::add_spikes(int end, const double* jumps, double* values) const {
  const int depth = depth_[static_cast<std::size_t>(end)];
  const double* spike = spike_[static_cast<std::size_t>(end)].data();
  for (int o = 0; o < lines_.outer; ++o)
    for (int distance = 0; distance < depth; ++distance, spike += lines_.inner) {
      const int line = o * lines_.inner;
      const int position = end == 0 ? distance : lines_.length - 1 - distance;
      double* row = values + lines_.cell(line, position) * N;
      const double* jump = jumps + line * N;
      for (int i = 0; i < lines_.inner; ++i)
        store_cell<N>(load_cell<N>(row + i * N) + spike[i] * load_cell<N>(jump + i * N), row + i * N);
    }
}

template void LineSmoother::solve<4>(double*) const;
template void LineSmoother::solve<5>(double*) const;
template void LineSmoother::copy_end<4>(int, const double*, double*) const;
template void LineSmoother::copy_end<5>(int, const double*, double*) const;
template void LineSmoother::add_spikes<4>(int, const double*, double*) const;
template void LineSmoother::add_spikes<5>(int, const double*, double*) const;

}  // namespace wingbeat
