#include "adjoint/inverse_distance.hpp"

#include <algorithm>
#include <utility>

#include "core/io/error.hpp"
#include "core/number/math.hpp"

namespace wingbeat {
namespace {

// One value a lane: entry first + lane of `entries`, the last one again beyond their end.
template <class F>
Pack gathered(std::span<const std::size_t> entries, std::size_t first, F&& value) {
  return Pack([&](auto lane) { return value(entries[std::min(first + lane, entries.size() - 1)]); });
}

}  // namespace

template <int Dim>
InverseDistance<Dim>::InverseDistance(std::vector<Vec<double, Dim>> positions, BoundaryNodes<Dim> boundary,
                                      double length)
    : positions_(std::move(positions)),
      boundary_(std::move(boundary)),
      boundary_entry_(positions_.size(), -1),
      length_squared_(length * length) {
  for (std::size_t k = 0; k < boundary_.nodes.size(); ++k)
    boundary_entry_[boundary_.nodes[k]] = static_cast<int>(k);
}

// Weight of boundary node k at x, of eq:inverse-distance.
template <int Dim>
template <class T>
T InverseDistance<Dim>::weight(const Vec<T, Dim>& x, std::size_t k) const {
  T square = T(0.0);
  for (int d = 0; d < Dim; ++d) {
    const T distance = x[d] - boundary_.positions[k][d];
    square += distance * distance;
  }
  const T near = length_squared_ / square;
  return boundary_.areas[k] * near * sqrt(near) * (1.0 + near);
}

// Which of `nodes` are not on the boundary.
template <int Dim>
std::vector<std::size_t> InverseDistance<Dim>::free_entries(std::span<const int> nodes) const {
  std::vector<std::size_t> entries;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (boundary_entry_[nodes[n]] < 0) entries.push_back(n);
  return entries;
}

// One node a lane, so that every sum runs over the boundary in its order, whatever nodes are asked for.
template <int Dim>
std::vector<Vec<double, Dim>> InverseDistance<Dim>::displacement(std::span<const Vec<double, Dim>> moving,
                                                                 std::span<const int> nodes) const {
  std::vector<Vec<double, Dim>> moved(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const int entry = boundary_entry_[nodes[n]];
    if (entry >= 0 && static_cast<std::size_t>(entry) < boundary_.moving) moved[n] = moving[entry];
  }
  const std::vector<std::size_t> entries = free_entries(nodes);
  for (std::size_t first = 0; first < entries.size(); first += Pack::size()) {
    Vec<Pack, Dim> x, sum;
    for (int d = 0; d < Dim; ++d) {
      x[d] = gathered(entries, first, [&](std::size_t n) { return positions_[nodes[n]][d]; });
      sum[d] = 0.0;
    }
    Pack total = 0.0;
    for (std::size_t k = 0; k < boundary_.nodes.size(); ++k) {
      const Pack w = weight(x, k);
      total += w;
      if (k >= boundary_.moving) continue;
      for (int d = 0; d < Dim; ++d) sum[d] += w * moving[k][d];
    }
    for (std::size_t lane = 0; lane < std::min(Pack::size(), entries.size() - first); ++lane)
      for (int d = 0; d < Dim; ++d) moved[entries[first + lane]][d] = Pack(sum[d] / total)[lane];
  }
  return moved;
}

template <int Dim>
void InverseDistance<Dim>::add_transpose(std::span<const Vec<double, Dim>> sensitivities,
                                         std::span<const int> nodes,
                                         std::span<Vec<double, Dim>> moving) const {
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const int entry = boundary_entry_[nodes[n]];
    if (entry >= 0 && static_cast<std::size_t>(entry) < boundary_.moving) moving[entry] += sensitivities[n];
  }
  const std::vector<std::size_t> entries = free_entries(nodes);
  std::vector<Vec<Pack, Dim>> sums(boundary_.moving);  // a lane's sum each
  for (Vec<Pack, Dim>& sum : sums)
    for (int d = 0; d < Dim; ++d) sum[d] = 0.0;
  for (std::size_t first = 0; first < entries.size(); first += Pack::size()) {
    Vec<Pack, Dim> x, scaled;
    for (int d = 0; d < Dim; ++d) {
      x[d] = gathered(entries, first, [&](std::size_t n) { return positions_[nodes[n]][d]; });
      scaled[d] = Pack([&](auto lane) {
        return first + lane < entries.size() ? sensitivities[entries[first + lane]][d] : 0.0;
      });
    }
    Pack total = 0.0;
    for (std::size_t k = 0; k < boundary_.nodes.size(); ++k) total += weight(x, k);
    for (int d = 0; d < Dim; ++d) scaled[d] /= total;
    for (std::size_t k = 0; k < boundary_.moving; ++k) {
      const Pack w = weight(x, k);
      for (int d = 0; d < Dim; ++d) sums[k][d] += w * scaled[d];
    }
  }
  for (std::size_t k = 0; k < boundary_.moving; ++k)
    for (int d = 0; d < Dim; ++d) moving[k][d] += std::experimental::reduce(sums[k][d]);
}

template class InverseDistance<2>;
template class InverseDistance<3>;

}  // namespace wingbeat
