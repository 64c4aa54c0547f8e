#include "core/mesh/airfoil_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "core/io/error.hpp"
#include "core/mesh/cubic_spline.hpp"

namespace wingbeat {

namespace {

using Point = Vec<double, 2>;

constexpr std::size_t minimum_points = 10;
constexpr double edge_tolerance = 0.01;        // of the trailing edge and its gap, chords
constexpr double nose_tolerance = 0.05;        // of the leading edge, which a change of shape may move
constexpr double repetition_tolerance = 1e-9;  // of points, chords
constexpr double cusp_tolerance = 0.03;  // interpolation error of a trailing-edge angle of zero, radians

// A point of the file and the line it stands on.
struct Ordinate {
  Point position;
  int line = 0;
};

[[noreturn]] void refuse(const std::string& file, int line, const std::string& what) {
  throw InputError(file + ":" + std::to_string(line) + ": " + what);
}

double distance(const Ordinate& a, const Ordinate& b) {
  return std::hypot(a.position[0] - b.position[0], a.position[1] - b.position[1]);
}

double spanned_area(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  const std::string_view blank = " \t\r,;";
  line = line.substr(0, line.find('#'));
  for (std::size_t begin = line.find_first_not_of(blank); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blank, begin), line.size());
    words.emplace_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blank, end);
  }
  return words;
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

Ordinate parse_ordinate(const std::vector<std::string>& words, const std::string& file, int line) {
  if (words.size() != 2)
    refuse(file, line,
           "expected two numbers, x and y in chords, found " + std::to_string(words.size()) + " words");
  Ordinate ordinate{{}, line};
  for (int d = 0; d < 2; ++d) {
    const std::string& word = words[static_cast<std::size_t>(d)];
    const auto value = number_of(word);
    if (!value) refuse(file, line, "\"" + word + "\" is not a number; expected x and y in chords");
    if (!std::isfinite(*value))
      refuse(file, line, "\"" + word + "\" is not finite; expected x and y in chords");
    ordinate.position[d] = *value;
  }
  return ordinate;
}

std::vector<Ordinate> parse(std::istream& input, const std::string& file) {
  std::vector<Ordinate> ordinates;
  std::string text;
  bool title_allowed = true;
  for (int line = 1; std::getline(input, text); ++line) {
    const auto words = words_of(text);
    if (words.empty()) continue;
    const bool title = title_allowed && !number_of(words.front());
    title_allowed = false;
    if (!title) ordinates.push_back(parse_ordinate(words, file, line));
  }
  return ordinates;
}

std::size_t foremost(const std::vector<Ordinate>& points) {
  const auto less = [](const Ordinate& a, const Ordinate& b) { return a.position[0] < b.position[0]; };
  return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), less) - points.begin());
}

// The ends first: a file in another order fails the other checks for reasons that do not help.
void check_chord(const std::vector<Ordinate>& points, const std::string& file) {
  if (points.size() < minimum_points)
    throw InputError(file + ": " + std::to_string(points.size()) + " points; a section needs at least " +
                     std::to_string(minimum_points));
  const double nose = points[foremost(points)].position[0];
  for (const Ordinate* end : {&points.front(), &points.back()})
    if (std::abs(end->position[0] - 1.0) > edge_tolerance)
      refuse(file, end->line,
             "x = " + fmt::format("{:g}", end->position[0]) +
                 " where the trailing edge, x = 1 within 1 %, is expected; order the points from "
                 "the upper trailing edge over the leading edge to the lower trailing edge, in chords");
  if (std::abs(nose) > nose_tolerance)
    refuse(file, points[foremost(points)].line,
           "leading edge at x = " + fmt::format("{:g}", nose) + "; it must lie at x = 0 within 5 % chord");
  if (distance(points.front(), points.back()) > edge_tolerance)
    refuse(file, points.back().line,
           "trailing edge open by more than 1 % chord; close it, the mesh needs a sharp edge");
}

void check_repetition(const std::vector<Ordinate>& points, const std::string& file) {
  // The two ends may coincide: that is a closed trailing edge.
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      if (distance(points[i], points[j]) < repetition_tolerance && !(i == 0 && j + 1 == points.size()))
        refuse(
            file, points[j].line,
            "repeats the point of line " + std::to_string(points[i].line) + "; each point may be given once");
}

// Both ends to their midpoint.
void close_trailing_edge(std::vector<Ordinate>& points) {
  const Point first = points.front().position, last = points.back().position;
  const double nose = points[foremost(points)].position[0];
  const Point middle = 0.5 * (first + last);
  const std::size_t leading = foremost(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& end = i < leading ? first : last;
    Point& p = points[i].position;
    p += ((p[0] - nose) / (end[0] - nose)) * (middle - end);
  }
  points.front().position = points.back().position = middle;
}

bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  return spanned_area(b - a, c - a) * spanned_area(b - a, d - a) < 0.0 &&
         spanned_area(d - c, a - c) * spanned_area(d - c, b - c) < 0.0;
}

void check_crossing(const std::vector<Ordinate>& points, const std::string& file) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < points.size(); ++j)
      if (segments_cross(points[i].position, points[i + 1].position, points[j].position,
                         points[j + 1].position))
        refuse(file, points[j].line,
               "the surface crosses itself: this point and the next against lines " +
                   std::to_string(points[i].line) + " and " + std::to_string(points[i + 1].line));
}

void order_from_lower_trailing_edge(std::vector<Ordinate>& points) {
  double twice_area = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    twice_area += spanned_area(points[i].position, points[i + 1].position);
  if (twice_area > 0.0) std::reverse(points.begin(), points.end());
}

// Vertex of the parabola x(y) through the foremost point and its neighbours: the nose lies between
// points as a rule, and its square-root parameter must not vanish at two of them.
Point nose_vertex(const std::vector<Ordinate>& points) {
  const std::size_t k = foremost(points);
  const Point a = points[k - 1].position, b = points[k].position, c = points[k + 1].position;
  if (!(a[1] < b[1] && b[1] < c[1])) return b;
  const double low = (b[0] - a[0]) / (b[1] - a[1]), high = (c[0] - b[0]) / (c[1] - b[1]);
  const double curvature = (high - low) / (c[1] - a[1]);
  if (curvature <= 0.0) return b;
  const double y = 0.5 * (a[1] + b[1] - low / curvature);
  return {{std::min(b[0], a[0] + (y - a[1]) * (low + curvature * (y - b[1]))), y}};
}

std::vector<double> curve_parameters(const std::vector<Ordinate>& points, const std::string& file) {
  const Point nose = nose_vertex(points);
  const std::size_t leading = foremost(points);
  const double chord = points.back().position[0] - nose[0];
  std::vector<double> parameters;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i].position;
    const bool lower = i < leading || (i == leading && p[1] < nose[1]);
    const double root = std::sqrt((p[0] - nose[0]) / chord);
    parameters.push_back(lower ? -root : root);
    if (i > 0 && !(parameters[i] > parameters[i - 1]))
      refuse(file, points[i].line,
             "x must fall from the trailing edge to the leading edge and rise again to the "
             "trailing edge; here it turns back");
  }
  return parameters;
}

}  // namespace

Airfoil read_airfoil(const std::filesystem::path& path) {
  std::ifstream input(path);
  if (!input) throw InputError(path.string() + ": cannot open this file of ordinates; check the path");
  return read_airfoil(input, path.string());
}

Airfoil read_airfoil(std::istream& input, const std::string& name) {
  std::vector<Ordinate> points = parse(input, name);
  check_chord(points, name);
  check_repetition(points, name);
  check_crossing(points, name);
  close_trailing_edge(points);
  order_from_lower_trailing_edge(points);
  const std::vector<double> parameters = curve_parameters(points, name);
  std::vector<double> x, y;
  for (const auto& point : points) x.push_back(point.position[0]), y.push_back(point.position[1]);
  const CubicSpline spline_x(parameters, x), spline_y(parameters, y);

  Airfoil airfoil(name, [spline_x, spline_y](double t) {
    const auto [px, dx] = spline_x(t);
    const auto [py, dy] = spline_y(t);
    return SectionPoint{{{px, py}}, {{dx, dy}}};
  });
  if (airfoil.trailing_edge_angle() < -cusp_tolerance)
    throw InputError(name + ": the surfaces cross next to the trailing edge (angle " +
                     fmt::format("{:.3g}", airfoil.trailing_edge_angle()) + " rad); correct the last points");
  return airfoil;
}

}  // namespace wingbeat
