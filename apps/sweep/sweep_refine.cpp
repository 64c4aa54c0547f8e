#include "apps/sweep/sweep_refine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace wingbeat {
namespace {

std::vector<double> ranges_of(std::span<const CurvePoint> points) {
  std::vector<double> least, greatest;
  for (const CurvePoint& point : points)
    for (std::size_t v = 0; v < point.values.size(); ++v) {
      if (v == least.size()) {
        least.push_back(point.values[v]);
        greatest.push_back(point.values[v]);
      }
      least[v] = std::min(least[v], point.values[v]);
      greatest[v] = std::max(greatest[v], point.values[v]);
    }
  for (std::size_t v = 0; v < least.size(); ++v) greatest[v] -= least[v];
  return greatest;
}

// At the middle one of three points.
double bend(const CurvePoint& before, const CurvePoint& point, const CurvePoint& after,
            std::span<const double> ranges) {
  const bool has_gap = before.values.empty() || point.values.empty() || after.values.empty();
  if (has_gap) return before.values.empty() && point.values.empty() && after.values.empty() ? 0.0 : 1.0;
  const double share = (point.place - before.place) / (after.place - before.place);
  double largest = 0.0;
  for (std::size_t v = 0; v < point.values.size(); ++v) {
    const double straight = before.values[v] + share * (after.values[v] - before.values[v]);
    if (ranges[v] > 0.0) largest = std::max(largest, std::abs(point.values[v] - straight) / ranges[v]);
  }
  return largest;
}

}  // namespace

std::vector<double> refined_places(std::span<const CurvePoint> points, double tolerance, double least_width,
                                   int count) {
  if (points.size() < 3) return {};
  const std::vector<double> ranges = ranges_of(points);
  std::vector<double> bends(points.size() - 1, 0.0);  // of intervals
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double own = bend(points[i - 1], points[i], points[i + 1], ranges);
    bends[i - 1] = std::max(bends[i - 1], own);
    bends[i] = std::max(bends[i], own);
  }
  std::vector<std::size_t> order(bends.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return bends[i]; });
  std::vector<double> places;
  for (const std::size_t i : order) {
    const double width = points[i + 1].place - points[i].place;
    if (static_cast<int>(places.size()) == count || bends[i] <= tolerance) break;
    // Half of it must not be narrower than allowed, but for round-off.
    if (0.5 * width >= least_width * (1.0 - 1e-9)) places.push_back(points[i].place + 0.5 * width);
  }
  std::ranges::sort(places);
  return places;
}

}  // namespace wingbeat
