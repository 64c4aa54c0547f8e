#include "core/mesh/airfoil.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/io/error.hpp"
#include "core/mesh/airfoil_families.hpp"
#include "core/mesh/airfoil_file.hpp"

namespace wingbeat {

namespace {

using Point = Vec<double, 2>;

constexpr int arc_intervals = 512;  // even: the nose is a node of the table
constexpr double closure_tolerance = 1e-10;

double norm(const Point& a) { return std::hypot(a[0], a[1]); }
double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }

double table_parameter(std::size_t i) { return 2.0 * static_cast<double>(i) / arc_intervals - 1.0; }

}  // namespace

Airfoil::Airfoil(std::string name, SectionCurve curve) : name_(std::move(name)), curve_(std::move(curve)) {
  ensure(norm(at(1.0).position - at(-1.0).position) < closure_tolerance,
         "section " + name_ + " must be closed at the trailing edge");
  arc_length_.assign(1, 0.0);
  for (std::size_t i = 0; i < arc_intervals; ++i)
    arc_length_.push_back(arc_length_.back() + length_between(table_parameter(i), table_parameter(i + 1)));
}

double Airfoil::trailing_edge_angle() const {
  const Point upper = -at(1.0).tangent, lower = at(-1.0).tangent;
  return std::atan2(cross(upper, lower), dot(upper, lower));
}

double Airfoil::nose_radius() const {
  constexpr double step = 1e-3;
  const Point tangent = at(0.0).tangent;
  const Point second = (0.5 / step) * (at(step).tangent - at(-step).tangent);
  return std::pow(norm(tangent), 3) / std::abs(cross(tangent, second));
}

// Five-point Gauss-Legendre quadrature of |dx/dt|.
double Airfoil::length_between(double t0, double t1) const {
  constexpr std::array<double, 5> abscissa = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                              0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> weight = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                            0.4786286704993665, 0.2369268850561891};
  const double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0);
  double sum = 0.0;
  for (std::size_t i = 0; i < abscissa.size(); ++i)
    sum += weight[i] * norm(at(middle + half * abscissa[i]).tangent);
  return half * sum;
}

double Airfoil::length_to(double t) const {
  const double interval = std::floor(0.5 * (t + 1.0) * arc_intervals);
  const auto i = static_cast<std::size_t>(std::clamp(interval, 0.0, arc_intervals - 1.0));
  return arc_length_[i] + length_between(table_parameter(i), t);
}

double Airfoil::arc_parameter(double t) const {
  const double length = length_to(t);
  return t <= 0.0 ? 0.5 * length / lower_arc_length()
                  : 0.5 + 0.5 * (length - lower_arc_length()) / upper_arc_length();
}

double Airfoil::curve_parameter(double s) const {
  ensure(s >= 0.0 && s <= 1.0, "arc parameter of a section must lie in [0, 1]");
  const double target =
      s <= 0.5 ? 2.0 * s * lower_arc_length() : lower_arc_length() + (2.0 * s - 1.0) * upper_arc_length();
  const auto above = std::upper_bound(arc_length_.begin() + 1, arc_length_.end() - 1, target);
  const auto i = static_cast<std::size_t>(above - arc_length_.begin()) - 1;
  const double low = table_parameter(i), high = table_parameter(i + 1);
  double t = low + (high - low) * (target - arc_length_[i]) / (arc_length_[i + 1] - arc_length_[i]);
  // |dx/dt| varies little within an interval: Newton needs two or three steps.
  for (int step = 0; step < 8; ++step) {
    const double change = (target - arc_length_[i] - length_between(low, t)) / norm(at(t).tangent);
    t = std::clamp(t + change, low, high);
    if (std::abs(change) < 1e-15) break;
  }
  return t;
}

Point Airfoil::outward_normal(double s) const {
  const Point tangent = at(curve_parameter(s)).tangent;
  return (1.0 / norm(tangent)) * Point{{-tangent[1], tangent[0]}};
}

bool is_airfoil_name(std::string_view text) {
  constexpr std::string_view prefix = "naca";
  if (text == "naca64a010") return true;
  return text.starts_with(prefix) && text.size() == prefix.size() + 4 &&
         text.find_first_not_of("0123456789", prefix.size()) == std::string_view::npos;
}

Airfoil make_airfoil(const std::string& name_or_file) {
  if (is_airfoil_name(name_or_file))
    return name_or_file == "naca64a010" ? naca_64a010() : naca_four_digit(name_or_file.substr(4));
  if (!std::filesystem::is_regular_file(name_or_file))
    throw InputError(
        "airfoil \"" + name_or_file +
        "\" is neither a known section nor a file; allowed: \"naca64a010\", \"naca\" with four digits "
        "(such as \"naca0012\"), or the path of a file of ordinates");
  return read_airfoil(name_or_file);
}

}  // namespace wingbeat
