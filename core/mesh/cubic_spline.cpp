#include "core/mesh/cubic_spline.hpp"

#include <algorithm>
#include <utility>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

// Row of the tridiagonal system for the second derivatives.
struct Row {
  double lower = 0.0, diagonal = 0.0, upper = 0.0, right = 0.0;
};

// h, slope: width of the end interval and its divided difference, both seen from the end inwards.
Row end_row(const SplineEnd& end, double h, double divided_difference, double sign) {
  if (end.kind == SplineEnd::Kind::curvature) return {0.0, 1.0, 0.0, end.value};
  return {0.0, h / 3.0, h / 6.0, sign * (divided_difference - end.value)};
}

// Solves in place; rows.front().lower and rows.back().upper are unused.
std::vector<double> solve_tridiagonal(std::vector<Row> rows) {
  const std::size_t n = rows.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = rows[i].lower / rows[i - 1].diagonal;
    rows[i].diagonal -= factor * rows[i - 1].upper;
    rows[i].right -= factor * rows[i - 1].right;
  }
  std::vector<double> solution(n);
  for (std::size_t i = n; i-- > 0;) {
    const double next = i + 1 < n ? rows[i].upper * solution[i + 1] : 0.0;
    solution[i] = (rows[i].right - next) / rows[i].diagonal;
  }
  return solution;
}

}  // namespace

CubicSpline::CubicSpline(std::vector<double> knots, std::vector<double> values, SplineEnd first,
                         SplineEnd last)
    : knots_(std::move(knots)), values_(std::move(values)) {
  const std::size_t n = knots_.size();
  ensure(n >= 4 && values_.size() == n, "a cubic spline needs at least 4 knots and a value for each");
  std::vector<double> h(n - 1), difference(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = knots_[i + 1] - knots_[i];
    ensure(h[i] > 0.0, "knots of a cubic spline must increase");
    difference[i] = (values_[i + 1] - values_[i]) / h[i];
  }
  std::vector<Row> rows(n);
  rows.front() = end_row(first, h.front(), difference.front(), 1.0);
  rows.back() = end_row(last, h.back(), difference.back(), -1.0);
  std::swap(rows.back().lower, rows.back().upper);
  for (std::size_t i = 1; i + 1 < n; ++i)
    rows[i] = {h[i - 1] / 6.0, (h[i - 1] + h[i]) / 3.0, h[i] / 6.0, difference[i] - difference[i - 1]};

  // Not a knot: m0 = m1 + (m1 - m2) h0/h1 is eliminated from the second row, and m0 found last.
  const bool free_first = first.kind == SplineEnd::Kind::not_a_knot;
  const bool free_last = last.kind == SplineEnd::Kind::not_a_knot;
  if (free_first) {
    const double ratio = h[0] / h[1];
    rows[1].diagonal += (1.0 + ratio) * rows[1].lower;
    rows[1].upper -= ratio * rows[1].lower;
    rows[1].lower = 0.0;
    rows[0] = {0.0, 1.0, 0.0, 0.0};
  }
  if (free_last) {
    const double ratio = h[n - 2] / h[n - 3];
    rows[n - 2].diagonal += (1.0 + ratio) * rows[n - 2].upper;
    rows[n - 2].lower -= ratio * rows[n - 2].upper;
    rows[n - 2].upper = 0.0;
    rows[n - 1] = {0.0, 1.0, 0.0, 0.0};
  }
  curvatures_ = solve_tridiagonal(std::move(rows));
  if (free_first) curvatures_[0] = curvatures_[1] + (curvatures_[1] - curvatures_[2]) * h[0] / h[1];
  if (free_last)
    curvatures_[n - 1] = curvatures_[n - 2] + (curvatures_[n - 2] - curvatures_[n - 3]) * h[n - 2] / h[n - 3];
}

CubicSpline::Value CubicSpline::operator()(double x) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, x);
  const std::size_t i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const double h = knots_[i + 1] - knots_[i];
  const double a = (knots_[i + 1] - x) / h, b = (x - knots_[i]) / h;
  const double ma = curvatures_[i] * h * h / 6.0, mb = curvatures_[i + 1] * h * h / 6.0;
  return {a * values_[i] + b * values_[i + 1] + (a * a - 1.0) * a * ma + (b * b - 1.0) * b * mb,
          (values_[i + 1] - values_[i] - (3.0 * a * a - 1.0) * ma + (3.0 * b * b - 1.0) * mb) / h};
}

}  // namespace wingbeat
