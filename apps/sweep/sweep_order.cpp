#include "apps/sweep/sweep_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wingbeat {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double squared_distance(const PointPlaces& points, std::size_t a, std::size_t b) {
  // Points of different classes are farther apart than any of one class.
  double sum = points.classes[a] == points.classes[b] ? 0.0 : 1e6;
  for (std::size_t i = 0; i < points.places[a].size(); ++i) {
    const double difference = points.places[a][i] - points.places[b][i];
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

std::optional<std::size_t> next_point(const PointPlaces& points, std::span<const PointState> states,
                                      std::optional<std::size_t> last) {
  // The least is taken: of the distance from the last one, or of minus the distance from those begun.
  const auto cost = [&](std::size_t point) {
    if (last) return squared_distance(points, *last, point);
    double nearest = infinity;
    for (std::size_t other = 0; other < states.size(); ++other)
      if (states[other] == PointState::running || states[other] == PointState::done)
        nearest = std::min(nearest, squared_distance(points, other, point));
    return -nearest;
  };
  std::optional<std::size_t> best;
  double least = infinity;
  for (std::size_t point = 0; point < states.size(); ++point) {
    if (states[point] != PointState::pending) continue;
    const double own = cost(point);
    if (best && own >= least - 1e-12) continue;
    best = point;
    least = own;
  }
  return best;
}

std::optional<std::size_t> nearest_done(const PointPlaces& points, std::span<const PointState> states,
                                        std::size_t point) {
  std::optional<std::size_t> best;
  double least = infinity;
  for (std::size_t other = 0; other < states.size(); ++other) {
    if (states[other] != PointState::done || points.classes[other] != points.classes[point]) continue;
    const double distance = squared_distance(points, other, point);
    if (best && distance >= least - 1e-12) continue;
    best = other;
    least = distance;
  }
  return best;
}

std::optional<PointBefore> done_before(const PointPlaces& points, std::span<const PointState> states,
                                       std::size_t point, std::size_t start) {
  constexpr double farthest = 2.0, straightness = 1e-6;
  const auto& to = points.places[point];
  const auto& from = points.places[start];
  std::optional<PointBefore> best;
  for (std::size_t other = 0; other < states.size(); ++other) {
    if (states[other] != PointState::done || other == start) continue;
    if (points.classes[other] != points.classes[point]) continue;
    const double apart = squared_distance(points, other, start);
    if (apart == 0.0) continue;
    double along = 0.0, aside = 0.0;
    for (std::size_t i = 0; i < to.size(); ++i)
      along += (to[i] - from[i]) * (from[i] - points.places[other][i]);
    const double ahead = along / apart;
    for (std::size_t i = 0; i < to.size(); ++i)
      aside += std::pow(to[i] - from[i] - ahead * (from[i] - points.places[other][i]), 2);
    const bool is_on_line = std::sqrt(aside) < straightness;
    if (!is_on_line || ahead > farthest) continue;
    if (!best || std::abs(ahead) > std::abs(best->ahead)) best = PointBefore{other, ahead};
  }
  return best;
}

}  // namespace wingbeat
