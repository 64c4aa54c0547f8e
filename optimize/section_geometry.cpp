#include "optimize/section_geometry.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/io/error.hpp"
#include "core/number/dual.hpp"

namespace wingbeat {
namespace {

using Point = Vec<double, 2>;

constexpr double blunt_part = 0.02;    // of the chord, that is not searched for the greatest thickness
constexpr std::size_t nose_nodes = 5;  // that the parabola of the leading edge fits

// Positions are taken from the trailing edge on, to keep digits.
SectionMeasure area(std::span<const Point> x) {
  const std::size_t n = x.size();
  SectionMeasure result{0.0, std::vector<Point>(n)};
  for (std::size_t w = 0; w < n; ++w) {
    const Point across = x[(w + 1) % n] - x[(w + n - 1) % n];
    const Point from = x[w] - x[0];
    // The wall runs clockwise.
    result.value -= 0.5 * from[0] * across[1];
    result.by_wall[w] = {{-0.5 * across[1], 0.5 * across[0]}};
  }
  return result;
}

// Entries of the wall by x, without the nose.
struct Surfaces {
  std::vector<std::size_t> lower, upper;
};

Surfaces surfaces_of(const SectionWall& wall) {
  double nose = wall.positions[0][0];
  for (const Point& x : wall.positions) nose = std::min(nose, x[0]);
  const double first = nose + blunt_part * wall.chord();
  Surfaces surfaces;
  for (std::size_t w = 1; w < wall.size(); ++w)
    if (wall.positions[w][0] >= first) (wall.s[w] < 0.5 ? surfaces.lower : surfaces.upper).push_back(w);
  std::ranges::reverse(surfaces.lower);
  for (auto* surface : {&surfaces.lower, &surfaces.upper}) {
    surface->push_back(0);
    ensure(surface->size() >= 4, "too few nodes on a surface of the section to measure its thickness");
  }
  return surfaces;
}

// Four neighbouring nodes of a surface; the cubic is that between nodes `left` and `left` + 1 of them.
template <class T>
struct Stencil {
  std::array<Vec<T, 2>, 4> nodes;
  std::size_t left = 1;
};

// At node k of the parabola through it and its neighbours; at an end, through the nearest three.
template <class T>
T slope_at(const std::array<Vec<T, 2>, 4>& p, std::size_t k) {
  const std::size_t first = k == 0 ? 0 : std::min<std::size_t>(k - 1, 1);
  const Vec<T, 2>&a = p[first], &b = p[first + 1], &c = p[first + 2];
  const T low = (b[1] - a[1]) / (b[0] - a[0]), high = (c[1] - b[1]) / (c[0] - b[0]);
  return low + (high - low) / (c[0] - a[0]) * ((p[k][0] - a[0]) + (p[k][0] - b[0]));
}

// y = y_0 + m d + p d^2 + q d^3 between two nodes, d = x - x_0.
template <class T>
struct Cubic {
  T x0, y0, m, p, q;

  Cubic(const T& xa, const T& ya, const T& ma, const T& xb, const T& yb, const T& mb)
      : x0(xa), y0(ya), m(ma), p(), q() {
    const T h = xb - xa, mean = (yb - ya) / h;
    p = (3.0 * mean - 2.0 * ma - mb) / h;
    q = (ma + mb - 2.0 * mean) / (h * h);
  }
  T value(double x) const {
    const T d = x - x0;
    return y0 + d * (m + d * (p + d * q));
  }
  T slope(double x) const {
    const T d = x - x0;
    return m + d * (2.0 * p + 3.0 * (d * q));
  }
};

template <class T>
Cubic<T> cubic_of(const Stencil<T>& stencil) {
  const auto& p = stencil.nodes;
  const std::size_t a = stencil.left, b = a + 1;
  return {p[a][0], p[a][1], slope_at(p, a), p[b][0], p[b][1], slope_at(p, b)};
}

// One surface of the displaced wall as a function of x.
class SurfaceCurve {
 public:
  SurfaceCurve(std::span<const Point> wall, const std::vector<std::size_t>& entries) : entries_(entries) {
    for (const std::size_t w : entries) nodes_.push_back(wall[w]);
  }

  double first() const { return nodes_.front()[0]; }
  double last() const { return nodes_.back()[0]; }
  const std::vector<Point>& nodes() const { return nodes_; }

  std::pair<double, double> value_and_slope(double x) const {
    const auto [begin, left] = place(x);
    Stencil<double> stencil{{}, left};
    std::copy_n(nodes_.begin() + static_cast<std::ptrdiff_t>(begin), 4, stencil.nodes.begin());
    const Cubic<double> cubic = cubic_of(stencil);
    return {cubic.value(x), cubic.slope(x)};
  }

  // Adds `factor` times the derivative of the value at x, which stays, to that of each entry of the wall.
  void add_derivative(double x, double factor, std::vector<Point>& by_wall) const {
    using Number = Dual<double, 8>;
    const auto [begin, left] = place(x);
    Stencil<Number> stencil{{}, left};
    for (std::size_t k = 0; k < 4; ++k)
      for (int d = 0; d < 2; ++d)
        stencil.nodes[k][d] = Number::seed(nodes_[begin + k][d], 2 * static_cast<int>(k) + d);
    const Number value = cubic_of(stencil).value(x);
    for (std::size_t k = 0; k < 4; ++k)
      for (int d = 0; d < 2; ++d)
        by_wall[entries_[begin + k]][d] += factor * value.gradient[2 * static_cast<int>(k) + d];
  }

 private:
  // Where the stencil of the cubic at x begins, and the node of it that lies left of x.
  std::pair<std::size_t, std::size_t> place(double x) const {
    const auto above = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, x,
                                        [](double value, const Point& node) { return value < node[0]; });
    const auto left = static_cast<std::size_t>(above - nodes_.begin()) - 1;
    const std::size_t begin = std::min(left == 0 ? 0 : left - 1, nodes_.size() - 4);
    return {begin, left - begin};
  }

  const std::vector<std::size_t>& entries_;
  std::vector<Point> nodes_;
};

// Where the cubic is greatest inside (a, b), if it is not at an end.
double crest(const Cubic<double>& cubic, double a, double b) {
  const double square = cubic.p * cubic.p - 3.0 * cubic.q * cubic.m;
  if (square <= 0.0) return a;
  // Of the two zeros of the slope, the one where it falls.
  const double root = std::sqrt(square);
  const double d = cubic.p < 0.0 ? cubic.m / (root - cubic.p) : -(cubic.p + root) / (3.0 * cubic.q);
  const double x = cubic.x0 + d;
  return x > a && x < b ? x : a;
}

SectionMeasure thickness(const Surfaces& surfaces, std::span<const Point> wall) {
  const SurfaceCurve lower(wall, surfaces.lower), upper(wall, surfaces.upper);
  const double begin = std::max(lower.first(), upper.first()), end = std::min(lower.last(), upper.last());
  // Between these both surfaces are cubics.
  std::vector<double> stations{begin, end};
  for (const SurfaceCurve* curve : {&lower, &upper})
    for (const Point& node : curve->nodes())
      if (node[0] > begin && node[0] < end) stations.push_back(node[0]);
  std::ranges::sort(stations);

  const auto distance = [&](double x) {
    const auto above = upper.value_and_slope(x), below = lower.value_and_slope(x);
    return std::pair(above.first - below.first, above.second - below.second);
  };
  double best = begin, greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const double a = stations[i], b = stations[i + 1];
    // Nodes of a symmetric section stand above each other but for round-off.
    if (b - a < 1e-10 * (end - begin)) continue;
    const auto left = distance(a), right = distance(b);
    const double x = crest({a, left.first, left.second, b, right.first, right.second}, a, b);
    if (const double found = distance(x).first; found > greatest) greatest = found, best = x;
  }
  SectionMeasure result{greatest, std::vector<Point>(wall.size())};
  upper.add_derivative(best, 1.0, result.by_wall);
  lower.add_derivative(best, -1.0, result.by_wall);
  return result;
}

// Entries of the wall nearest to its leading edge; with those as far as the last one.
std::vector<std::size_t> nose_of(const SectionWall& wall) {
  constexpr double alike = 1e-6;  // relative
  ensure(wall.size() > nose_nodes, "too few nodes to measure the radius of the leading edge");
  std::vector<double> distances;
  for (const double s : wall.s) distances.push_back(std::abs(s - 0.5));
  std::vector<double> sorted = distances;
  std::ranges::sort(sorted);
  const double farthest = (1.0 + alike) * sorted[nose_nodes - 1];
  std::vector<std::size_t> nose;
  for (std::size_t w = 1; w < wall.size(); ++w)
    if (distances[w] <= farthest) nose.push_back(w);
  return nose;
}

// x = c_0 + c_1 u + c_2 u^2 in u = (y - middle)/unit, both of which stay: they only keep the fit well
// conditioned, and R does not depend on them.
SectionMeasure leading_edge_radius(const SectionWall& undeformed, std::span<const Point> wall) {
  const std::vector<std::size_t> nose = nose_of(undeformed);
  const double low = undeformed.positions[nose.front()][1], high = undeformed.positions[nose.back()][1];
  const double middle = 0.5 * (low + high), unit = 0.5 * std::abs(high - low);

  const auto rows = static_cast<Eigen::Index>(nose.size());
  Eigen::MatrixX3d basis(rows, 3);
  Eigen::VectorXd x(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Point& p = wall[nose[static_cast<std::size_t>(i)]];
    const double u = (p[1] - middle) / unit;
    basis.row(i) << 1.0, u, u * u;
    x[i] = p[0];
  }
  const Eigen::LDLT<Eigen::Matrix3d> normal(basis.transpose() * basis);
  const Eigen::Vector3d c = normal.solve(basis.transpose() * x);
  const Eigen::Vector3d g = normal.solve(Eigen::Vector3d::Unit(2));

  SectionMeasure result{0.5 * unit * unit / c[2], std::vector<Point>(wall.size())};
  const double by_c2 = -result.value / c[2];
  for (Eigen::Index i = 0; i < rows; ++i) {
    // d(A^T A c) = d(A^T x), solved for the last of c.
    const double u = basis(i, 1), weight = basis.row(i).dot(g), rest = x[i] - basis.row(i).dot(c);
    const double by_u = (g[1] + 2.0 * u * g[2]) * rest - weight * (c[1] + 2.0 * u * c[2]);
    result.by_wall[nose[static_cast<std::size_t>(i)]] = {{by_c2 * weight, by_c2 * by_u / unit}};
  }
  return result;
}

}  // namespace

SectionMeasures measure_section(const SectionWall& wall, std::span<const Vec<double, 2>> displacement) {
  ensure(displacement.size() == wall.size(), "one displacement a node of the wall");
  std::vector<Point> moved = wall.positions;
  for (std::size_t w = 0; w < moved.size(); ++w) moved[w] += displacement[w];
  return {area(moved), thickness(surfaces_of(wall), moved), leading_edge_radius(wall, moved)};
}

}  // namespace wingbeat
