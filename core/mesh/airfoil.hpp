#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/number/vec.hpp"

namespace wingbeat {

// A point of a section and the derivative of its position with respect to the curve parameter.
struct SectionPoint {
  Vec<double, 2> position;
  Vec<double, 2> tangent;
};

// Closed curve over t in [-1, 1]: lower trailing edge at -1, nose at 0, upper trailing edge at 1.
// Regular at the nose (t behaves as +-sqrt(x)), so that a finite nose radius is smooth in t.
using SectionCurve = std::function<SectionPoint(double)>;

// Section of a wing: unit chord, leading edge near x = 0, sharp closed trailing edge near x = 1.
// Traversed from the lower trailing edge over the leading edge to the upper trailing edge,
// by the curve parameter t or by the arc parameter s in [0, 1].
class Airfoil {
 public:
  Airfoil(std::string name, SectionCurve curve);

  const std::string& name() const { return name_; }

  // Position and derivative at curve parameter t in [-1, 1].
  SectionPoint at(double t) const { return curve_(t); }
  // Angle inside the section between the two surfaces at the trailing edge, radians; 0 for a cusp.
  double trailing_edge_angle() const;
  // Radius of curvature at t = 0, chords.
  double nose_radius() const;

  // Arc parameter: arc length from the trailing edge, scaled on each surface so that s = 1/2 is the
  // nose (t = 0); on a symmetric section, the fraction of the whole arc.
  double curve_parameter(double s) const;
  double arc_parameter(double t) const;
  Vec<double, 2> point(double s) const { return at(curve_parameter(s)).position; }
  // Unit normal out of the section; one-sided at the trailing edge.
  Vec<double, 2> outward_normal(double s) const;
  double lower_arc_length() const { return arc_length_[arc_length_.size() / 2]; }
  double upper_arc_length() const { return arc_length_.back() - lower_arc_length(); }

 private:
  double length_between(double t0, double t1) const;
  double length_to(double t) const;

  std::string name_;
  SectionCurve curve_;
  std::vector<double> arc_length_;  // from t = -1 to equidistant values of t
};

// Whether the text names a built-in section, "naca64a010" or "naca" and four digits, rather than a file.
bool is_airfoil_name(std::string_view text);

// The section that a case names: "naca64a010", "naca" and four digits (NACA 0012, 2412, ...), or a
// file of ordinates (read_airfoil). Throws InputError for anything else.
Airfoil make_airfoil(const std::string& name_or_file);

}  // namespace wingbeat
