#include "structure/growth_bracket.hpp"

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// Share of the tolerance that the error of one growth rate may use up.
constexpr double rate_share = 0.25;

// Where the line through two points has no growth, with the error that those of the rates leave.
GrowthCrossing on_line(const GrowthAtSpeed& a, const GrowthAtSpeed& b) {
  GrowthCrossing result;
  result.slope = (b.rate - a.rate) / (b.reduced_velocity - a.reduced_velocity);
  const double of_b = -a.rate / (b.rate - a.rate), of_a = 1.0 - of_b;
  result.reduced_velocity = of_a * a.reduced_velocity + of_b * b.reduced_velocity;
  result.frequency = of_a * a.frequency + of_b * b.frequency;
  result.reduced_velocity_error =
      std::hypot(of_a * a.rate_error, of_b * b.rate_error) / std::abs(result.slope);
  result.frequency_error = std::hypot(of_a * a.frequency_error, of_b * b.frequency_error);
  return result;
}

// What a third point adds to the speed found on the line through a and b: the next term of Newton's
// interpolation of V by the rate.
double bend(const GrowthAtSpeed& a, const GrowthAtSpeed& b, const GrowthAtSpeed& c) {
  const double ab = (b.reduced_velocity - a.reduced_velocity) / (b.rate - a.rate);
  const double bc = (c.reduced_velocity - b.reduced_velocity) / (c.rate - b.rate);
  return a.rate * b.rate * (bc - ab) / (c.rate - a.rate);
}

// Whether growth rises from one speed to the other by what cannot be error alone.
bool rises(const GrowthAtSpeed& a, const GrowthAtSpeed& b) {
  constexpr double clear = 5.0;
  const double rise = b.rate - a.rate;
  return rise * (b.reduced_velocity - a.reduced_velocity) > 0.0 &&
         std::abs(rise) > clear * std::hypot(a.rate_error, b.rate_error);
}

}  // namespace

GrowthBracket::GrowthBracket(double first_speed, const GrowthBracketOptions& options)
    : first_speed_(first_speed), options_(options) {
  ensure(first_speed > 0.0 && options.tolerance > 0.0, "a search needs a positive speed and tolerance");
}

void GrowthBracket::add(const GrowthAtSpeed& point) {
  ensure(std::isfinite(point.rate) && std::isfinite(point.rate_error), "growth rates are finite");
  points_.push_back(point);
}

std::optional<std::pair<GrowthAtSpeed, GrowthAtSpeed>> GrowthBracket::enclosing() const {
  std::vector<GrowthAtSpeed> by_speed = points_;
  std::ranges::stable_sort(by_speed, {}, &GrowthAtSpeed::reduced_velocity);
  const auto pair = std::ranges::adjacent_find(
      by_speed,
      [](const GrowthAtSpeed& low, const GrowthAtSpeed& high) { return low.rate <= 0.0 && high.rate > 0.0; });
  if (pair == by_speed.end()) return std::nullopt;
  return std::pair{pair[0], pair[1]};
}

GrowthAtSpeed GrowthBracket::nearest() const {
  if (const auto pair = enclosing())
    return std::abs(pair->first.rate) <= std::abs(pair->second.rate) ? pair->first : pair->second;
  const auto [low, high] = std::ranges::minmax(points_, {}, &GrowthAtSpeed::reduced_velocity);
  return low.rate > 0.0 ? low : high;
}

std::optional<GrowthCrossing> GrowthBracket::interpolated() const {
  if (points_.size() < 2) return std::nullopt;
  const GrowthAtSpeed a = nearest();
  std::vector<GrowthAtSpeed> others;
  for (const GrowthAtSpeed& p : points_)
    if (rises(a, p)) others.push_back(p);
  if (others.empty()) return std::nullopt;
  std::ranges::stable_sort(
      others, {}, [&](const GrowthAtSpeed& p) { return std::abs(p.reduced_velocity - a.reduced_velocity); });
  const auto across =
      std::ranges::find_if(others, [&](const GrowthAtSpeed& p) { return (p.rate > 0.0) != (a.rate > 0.0); });
  const bool is_enclosed = across != others.end();
  if (is_enclosed) std::rotate(others.begin(), across, across + 1);
  const GrowthAtSpeed& b = others[0];
  GrowthCrossing result = on_line(a, b);
  const double from_a = result.reduced_velocity - a.reduced_velocity,
               from_b = result.reduced_velocity - b.reduced_velocity;
  // Without a third point: a line misses a curve that bends by its own slope over its own speed.
  double missed = 2.0 * from_a * from_b / result.reduced_velocity;
  const auto third =
      std::find_if(others.begin() + 1, others.end(), [&](const GrowthAtSpeed& p) { return rises(b, p); });
  if (third != others.end()) {
    missed = bend(a, b, *third);
    const double bent = result.reduced_velocity + missed;
    if (!is_enclosed || (bent - a.reduced_velocity) * (bent - b.reduced_velocity) < 0.0)
      result.reduced_velocity = bent;
  }
  result.reduced_velocity_error = std::hypot(result.reduced_velocity_error, missed);
  return result;
}

double GrowthBracket::next() const {
  if (points_.empty()) return first_speed_;
  const bool grows = nearest().rate > 0.0;
  const bool changes_sign =
      std::ranges::any_of(points_, [&](const GrowthAtSpeed& p) { return (p.rate > 0.0) != grows; });
  const auto [low, high] = std::ranges::minmax(points_, {}, &GrowthAtSpeed::reduced_velocity);
  const double lowest = low.reduced_velocity, highest = high.reduced_velocity;
  const auto line = interpolated();
  if (const auto pair = enclosing()) {
    const double slow = pair->first.reduced_velocity, fast = pair->second.reduced_velocity;
    const bool is_between = line && line->reduced_velocity >= slow && line->reduced_velocity <= fast;
    return is_between ? line->reduced_velocity : 0.5 * (slow + fast);
  }
  if (changes_sign) return 0.5 * (lowest + highest);
  const double from = grows ? lowest : highest;
  const double least = options_.first_step * first_speed_;
  // Beyond the crossing expected by a fifth, so that it is enclosed.
  double step = 2.0 * std::max(least, highest - lowest);
  if (points_.size() == 1) step = least;
  if (line) step = std::max(1.2 * std::abs(line->reduced_velocity - from), 0.1 * least);
  step = std::min(step, options_.largest_step * from);
  return grows ? from - step : from + step;
}

std::optional<double> GrowthBracket::rate_tolerance() const {
  const auto line = interpolated();
  if (!line) return std::nullopt;
  return rate_share * options_.tolerance * line->reduced_velocity * line->slope;
}

std::optional<GrowthCrossing> GrowthBracket::crossing() const {
  const auto line = interpolated();
  if (!line) return std::nullopt;
  const GrowthAtSpeed at = nearest();
  const bool changes_sign =
      std::ranges::any_of(points_, [&](const GrowthAtSpeed& p) { return (p.rate > 0.0) != (at.rate > 0.0); });
  return changes_sign || std::abs(at.rate) <= at.rate_error ? line : std::nullopt;
}

bool GrowthBracket::is_found() const {
  const auto at = crossing();
  return at && at->reduced_velocity_error <= options_.tolerance * at->reduced_velocity;
}

bool GrowthBracket::is_exhausted() const {
  return points_.size() > 2 && std::abs(nearest().rate) <= nearest().rate_error && crossing().has_value();
}

}  // namespace wingbeat
