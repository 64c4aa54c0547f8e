#include "structure/flutter_roots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/io/error.hpp"
#include "structure/branch_following.hpp"
#include "structure/velocity_eigenvalues.hpp"

namespace wingbeat {

namespace {

using Complex = std::complex<double>;

// The eigenvalues at one k in the order of their branches, with slopes.
struct Station {
  double k = 0.0;
  std::vector<Complex> lambda;
  std::vector<Complex> slope;
};

Station station_at(const StructureModel& model, const AerodynamicTable& table, double k) {
  const VelocityEigenvalues eigen = velocity_eigenvalues(model, k, table(k));
  const Eigen::MatrixXcd q_slope = table.derivative(k);
  Station station{k, {}, {}};
  for (int j = 0; j < 2 * model.size(); ++j) {
    station.lambda.push_back(eigen.inverse_velocity[j]);
    station.slope.push_back(eigen.slope(model, k, q_slope, j));
  }
  return station;
}

// Cubic Hermite interpolation of branch i, t in [0, 1].
Complex between(const Station& a, const Station& b, std::size_t i, double t) {
  const double h = b.k - a.k;
  const double s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * a.lambda[i] + t * t * (1.0 + 2.0 * s) * b.lambda[i] +
         h * s * t * (s * a.slope[i] - t * b.slope[i]);
}

// A mode without aerodynamic damping stays on the axis but for round-off: that is no crossing.
constexpr double neutral = 1e-11;

bool may_flutter(const Station& a, const Station& b, std::size_t i) {
  const bool is_neutral = std::abs(a.lambda[i].imag()) <= neutral * std::abs(a.lambda[i]) &&
                          std::abs(b.lambda[i].imag()) <= neutral * std::abs(b.lambda[i]);
  return a.lambda[i].real() > 0.0 && b.lambda[i].real() > 0.0 && !is_neutral;
}

bool crosses(const Station& a, const Station& b, std::size_t i) {
  return may_flutter(a, b, i) && std::signbit(a.lambda[i].imag()) != std::signbit(b.lambda[i].imag());
}

// A hump mode: Im lambda has one sign at both ends, and another in between.
bool hides_crossings(const Station& a, const Station& b, std::size_t i) {
  if (!may_flutter(a, b, i) || crosses(a, b, i)) return false;
  constexpr int probes = 8;
  for (int j = 1; j < probes; ++j)
    if (std::signbit(between(a, b, i, static_cast<double>(j) / probes).imag()) !=
        std::signbit(a.lambda[i].imag()))
      return true;
  return false;
}

int nearest(const VelocityEigenvalues& eigen, Complex lambda) {
  Eigen::Index j = 0;
  (eigen.inverse_velocity.array() - lambda).abs().minCoeff(&j);
  return static_cast<int>(j);
}

FlutterRoot root_of(const StructureModel& model, double k, const Eigen::MatrixXcd& q,
                    const Eigen::MatrixXcd& q_slope, const VelocityEigenvalues& eigen, int j) {
  const Complex lambda = eigen.inverse_velocity[j];
  FlutterRoot root;
  root.reduced_velocity = 1.0 / lambda.real();
  root.reduced_frequency = k;
  root.frequency = 2.0 * k * root.reduced_velocity;
  root.mode = eigen.right.col(j);
  root.growth_slope = eigen.growth_slope(model, k, q, q_slope, j);
  root.residual = std::abs(lambda.imag()) / std::abs(lambda);
  return root;
}

// The zero of Im lambda of branch i between two stations, by regula falsi with the Illinois rule.
FlutterRoot locate(const StructureModel& model, const AerodynamicTable& table, const Station& a,
                   const Station& b, std::size_t i, const FlutterOptions& options) {
  double low = 0.0, high = 1.0;
  double at_low = a.lambda[i].imag(), at_high = b.lambda[i].imag();
  FlutterRoot root;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double t =
        at_high == at_low ? high : std::clamp((low * at_high - high * at_low) / (at_high - at_low), 0.0, 1.0);
    const double k = std::clamp(a.k + t * (b.k - a.k), a.k, b.k);
    const Eigen::MatrixXcd q = table(k);
    const VelocityEigenvalues eigen = velocity_eigenvalues(model, k, q);
    const int j = nearest(eigen, between(a, b, i, t));
    root = root_of(model, k, q, table.derivative(k), eigen, j);
    if (root.residual <= 1e-3 * options.tolerance) break;
    const double value = eigen.inverse_velocity[j].imag();
    if (std::signbit(value) == std::signbit(at_high)) {
      at_low *= 0.5;
    } else {
      low = high;
      at_low = at_high;
    }
    high = t;
    at_high = value;
  }
  root.is_converged = root.residual <= options.tolerance;
  return root;
}

// exact - table through every point where the exact matrix is known, by divided differences.
class Correction {
 public:
  void add(double k, const Eigen::MatrixXcd& difference) {
    Eigen::MatrixXcd divided = difference;
    for (std::size_t j = 0; j < points_.size(); ++j) divided = (divided - terms_[j]) / (k - points_[j]);
    points_.push_back(k);
    terms_.push_back(std::move(divided));
  }
  // The value and slope at k.
  std::pair<Eigen::MatrixXcd, Eigen::MatrixXcd> operator()(double k) const {
    Eigen::MatrixXcd value = terms_.back();
    Eigen::MatrixXcd slope = Eigen::MatrixXcd::Zero(value.rows(), value.cols());
    for (std::size_t j = terms_.size() - 1; j-- > 0;) {
      slope = (slope * (k - points_[j]) + value).eval();
      value = (value * (k - points_[j]) + terms_[j]).eval();
    }
    return {value, slope};
  }

 private:
  std::vector<double> points_;
  std::vector<Eigen::MatrixXcd> terms_;
};

// The root of table + correction near (k, lambda), by Newton on Im lambda(k); nothing outside the table.
std::optional<std::pair<double, Complex>> root_of_model(const StructureModel& model,
                                                        const AerodynamicTable& table,
                                                        const Correction& correction, double k,
                                                        Complex lambda) {
  for (int iteration = 0; iteration < 30; ++iteration) {
    const auto [value, slope] = correction(k);
    const VelocityEigenvalues eigen = velocity_eigenvalues(model, k, table(k) + value);
    const int j = nearest(eigen, lambda);
    const Complex rate = eigen.slope(model, k, table.derivative(k) + slope, j);
    lambda = eigen.inverse_velocity[j];
    if (rate.imag() == 0.0) return std::nullopt;
    const double step = -lambda.imag() / rate.imag();
    if (!(k + step >= table.k_min()) || !(k + step <= table.k_max())) return std::nullopt;
    k += step;
    lambda += step * rate;
    if (std::abs(step) <= 1e-14 * k) return std::pair{k, lambda};
  }
  return std::nullopt;
}

// The root at k with Q = table + correction.
FlutterRoot root_with(const StructureModel& model, const AerodynamicTable& table,
                      const Correction& correction, double k, Complex lambda) {
  const auto [value, slope] = correction(k);
  const Eigen::MatrixXcd q = table(k) + value;
  const VelocityEigenvalues eigen = velocity_eigenvalues(model, k, q);
  return root_of(model, k, q, table.derivative(k) + slope, eigen, nearest(eigen, lambda));
}

void sort_by_velocity(std::vector<FlutterRoot>& roots) {
  std::stable_sort(roots.begin(), roots.end(), [](const FlutterRoot& a, const FlutterRoot& b) {
    return a.reduced_velocity < b.reduced_velocity;
  });
}

}  // namespace

std::vector<FlutterRoot> scan_flutter_roots(const StructureModel& model, const AerodynamicTable& table,
                                            const FlutterOptions& options) {
  check(model);
  // At k = 0 every real eigenvalue lies on the axis: that is divergence, not flutter.
  const double first = table.k_min() > 0.0 ? table.k_min() : 1e-3 * table.sampled_k()[1];
  const double longest = (table.k_max() - first) / options.scan_steps;
  const double shortest = 1e-6 * longest;
  std::vector<FlutterRoot> roots;
  Station here = station_at(model, table, first);
  const std::size_t branches = here.lambda.size();
  for (double step = longest; here.k < table.k_max();) {
    const Station next = station_at(model, table, std::min(here.k + step, table.k_max()));
    std::vector<Complex> predicted(branches);
    for (std::size_t i = 0; i < branches; ++i)
      predicted[i] = here.lambda[i] + (next.k - here.k) * here.slope[i];
    const BranchMatch match = match_branches(predicted, next.lambda);
    Station there{next.k, {}, {}};
    bool is_resolved = match.is_clear;
    for (std::size_t i = 0; i < branches; ++i) {
      there.lambda.push_back(next.lambda[static_cast<std::size_t>(match.candidate[i])]);
      there.slope.push_back(next.slope[static_cast<std::size_t>(match.candidate[i])]);
      is_resolved = is_resolved && !hides_crossings(here, there, i);
    }
    if (!is_resolved && step > shortest) {
      step *= 0.5;
      continue;
    }
    for (std::size_t i = 0; i < branches; ++i)
      if (crosses(here, there, i)) roots.push_back(locate(model, table, here, there, i, options));
    here = std::move(there);
    step = std::min(2.0 * step, longest);
  }
  std::erase_if(roots, [&](const FlutterRoot& root) { return root.reduced_velocity > options.velocity_max; });
  sort_by_velocity(roots);
  return roots;
}

FlutterRoot polish_flutter_root(const StructureModel& model, const AerodynamicMatrix& exact,
                                const AerodynamicTable& table, const FlutterRoot& start,
                                const FlutterOptions& options) {
  ensure(options.max_evaluations >= 1, "a polish needs an evaluation");
  Correction correction;
  double k = start.reduced_frequency;
  Complex lambda = 1.0 / start.reduced_velocity;
  double previous = 1.0;
  FlutterRoot root;
  for (int evaluation = 1; evaluation <= options.max_evaluations; ++evaluation) {
    correction.add(k, exact(k) - table(k));
    root = root_with(model, table, correction, k, lambda);
    root.evaluations = evaluation;
    root.is_converged = root.residual <= options.tolerance;
    if (root.is_converged) break;
    const auto next = root_of_model(model, table, correction, k, lambda);
    if (!next || next->first == k) break;
    std::tie(k, lambda) = *next;
    // The interpolation gains at least the last reduction again: no evaluation is spent on proving it.
    const double expected = root.residual * (root.residual / previous);
    if (evaluation > 1 && expected <= options.tolerance) {
      root = root_with(model, table, correction, k, lambda);
      root.evaluations = evaluation;
      root.residual = expected;
      root.is_converged = true;
      break;
    }
    previous = root.residual;
  }
  return root;
}

std::vector<FlutterRoot> flutter_roots(const StructureModel& model, const AerodynamicMatrix& exact,
                                       const AerodynamicTable& table, const FlutterOptions& options) {
  std::vector<FlutterRoot> roots;
  for (const FlutterRoot& start : scan_flutter_roots(model, table, options))
    roots.push_back(polish_flutter_root(model, exact, table, start, options));
  sort_by_velocity(roots);
  return roots;
}

std::vector<double> divergence_speeds(const StructureModel& model, const Eigen::MatrixXd& steady_matrix) {
  check(model);
  ensure(steady_matrix.rows() == model.size() && steady_matrix.cols() == model.size(),
         "aerodynamic matrix and structure differ in size");
  const Eigen::LLT<Eigen::MatrixXd> stiffness(model.stiffness);
  if (stiffness.info() != Eigen::Success)
    throw InputError("structure: the stiffness matrix is not positive definite; divergence has no meaning");
  const Eigen::MatrixXd flexibility = model.load_factor * stiffness.solve(steady_matrix);
  const Eigen::VectorXcd inverse_squared = flexibility.eigenvalues();
  std::vector<double> speeds;
  for (const Complex& value : inverse_squared)
    if (value.real() > 1e-12 * flexibility.norm() && std::abs(value.imag()) <= 1e-12 * std::abs(value))
      speeds.push_back(1.0 / std::sqrt(value.real()));
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

}  // namespace wingbeat
