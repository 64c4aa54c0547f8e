#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace wingbeat {

// Growth rate and frequency of small motion at one speed.
struct GrowthAtSpeed {
  double reduced_velocity = 0.0;
  double rate = 0.0;
  double rate_error = 0.0;
  double frequency = 0.0;
  double frequency_error = 0.0;
};

// The speed at which small motion neither grows nor decays.
struct GrowthCrossing {
  double reduced_velocity = 0.0;
  double reduced_velocity_error = 0.0;
  double frequency = 0.0;
  double frequency_error = 0.0;
  double slope = 0.0;  // d rate / dV
};

struct GrowthBracketOptions {
  double tolerance = 1e-4;   // on the error of the speed, relative
  double first_step = 0.03;  // of the speed, relative, from the first guess
  double largest_step = 0.3;
};

// The search for the flutter speed from growth rates alone (eq:growth-bracket): steps downwards from growth
// and upwards from decay until the boundary lies between two speeds, then between these by interpolation.
class GrowthBracket {
 public:
  GrowthBracket(double first_speed, const GrowthBracketOptions& options);

  // The speed to march at next.
  double next() const;
  // How well its growth rate should be known: a share of the change that the tolerance allows. Nothing
  // before a slope is known.
  std::optional<double> rate_tolerance() const;
  void add(const GrowthAtSpeed& point);
  // The crossing as far as it is known: needs growth at one speed and decay at another, or a point whose
  // rate is zero within its error.
  std::optional<GrowthCrossing> crossing() const;
  bool is_found() const;
  // The slowest motion's rate is zero within its error: more marches like it would add nothing.
  bool is_exhausted() const;
  const std::vector<GrowthAtSpeed>& points() const { return points_; }

 private:
  // Two neighbouring speeds between which decay turns into growth, the slowest such.
  std::optional<std::pair<GrowthAtSpeed, GrowthAtSpeed>> enclosing() const;
  // The point nearest to the boundary: the slower of two neighbouring speeds between which decay turns into
  // growth, else the last before growth or decay sets in.
  GrowthAtSpeed nearest() const;
  // From that point, the next across the boundary (on any side, where there is none) and, for the bend, the
  // next that is left. Points count whose rates differ by more than their errors.
  std::optional<GrowthCrossing> interpolated() const;

  double first_speed_;
  GrowthBracketOptions options_;
  std::vector<GrowthAtSpeed> points_;  // as they came
};

}  // namespace wingbeat
