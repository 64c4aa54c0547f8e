#include "structure/mode_following.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"
#include "structure/branch_following.hpp"

namespace wingbeat {

namespace {

using Complex = std::complex<double>;

class MatchedModes {
 public:
  MatchedModes(const StructureModel& model, const SpectrumAt& spectrum, double k_min, double k_max,
               const PkOptions& options)
      : model_(model), spectrum_(spectrum), k_min_(k_min), k_max_(k_max), options_(options) {}

  bool covers(double k) const { return k >= k_min_ && k <= k_max_; }

  // The m free vibrations by frequency; their k = omega/(2V) is beyond every table.
  std::vector<PkPoint> at_rest() const {
    const int m = model_.size();
    const MotionSpectrum spectrum =
        motion_spectrum(model_.mass.llt().solve(Eigen::MatrixXd::Identity(m, m)),
                        model_.damping.cast<Complex>(), model_.stiffness.cast<Complex>());
    std::vector<PkPoint> points;
    for (int j = 0; j < 2 * m; ++j)
      points.push_back({0.0, spectrum.p[j], spectrum.modes.col(j), PkStatus::outside_table});
    std::stable_sort(points.begin(), points.end(),
                     [](const PkPoint& a, const PkPoint& b) { return a.p.imag() < b.p.imag(); });
    points.erase(points.begin(), points.begin() + m);
    return points;
  }

  // The fixed point k = Im p/(2V) nearest to a predicted p, by the secant method on Im p(k)/(2V) - k.
  PkPoint at(double velocity, Complex predicted) const {
    PkPoint point{velocity, predicted, {}, PkStatus::iteration_limit};
    double k = predicted.imag() / (2.0 * velocity);
    double previous_k = 0.0, previous_gap = 0.0;
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      const MotionSpectrum spectrum = spectrum_(velocity, k);
      Eigen::Index j = 0;
      (spectrum.p.array() - point.p).abs().minCoeff(&j);
      point.p = spectrum.p[j];
      point.mode = spectrum.modes.col(j);
      const double gap = point.p.imag() / (2.0 * velocity) - k;
      if (std::abs(gap) <= options_.tolerance * std::max(std::abs(k), k_min_)) {
        point.status = covers(std::abs(k)) ? PkStatus::converged : PkStatus::outside_table;
        return point;
      }
      // A change of Q with k shifts the gap by less than k itself does: the slope lies near -1.
      const double slope = iteration == 0 ? -1.0 : (gap - previous_gap) / (k - previous_k);
      previous_k = k;
      previous_gap = gap;
      k -= gap / (slope < -0.2 && slope > -5.0 ? slope : -1.0);
    }
    return point;
  }

  // Different solutions near the predicted ones, with the aerodynamics of the first one's frequency.
  std::vector<Complex> distinct(double velocity, const std::vector<Complex>& predicted) const {
    const Eigen::VectorXcd p = spectrum_(velocity, predicted.front().imag() / (2.0 * velocity)).p;
    const std::vector<Complex> candidates(p.begin(), p.end());
    std::vector<Complex> found;
    for (const int j : match_branches(predicted, candidates).candidate)
      found.push_back(candidates[static_cast<std::size_t>(j)]);
    return found;
  }

 private:
  const StructureModel& model_;
  const SpectrumAt& spectrum_;
  double k_min_, k_max_;
  PkOptions options_;
};

// All modes at one speed, with dp/dV where two speeds are known.
struct Station {
  double velocity = 0.0;
  std::vector<PkPoint> points;
  std::vector<Complex> slope;
};

// All modes at a speed, sought from where they were predicted.
Station station_at(const MatchedModes& modes, const Station& here, double velocity,
                   const std::vector<Complex>& predicted) {
  Station next{velocity, {}, {}};
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    next.points.push_back(modes.at(velocity, predicted[i]));
    next.slope.push_back((next.points[i].p - here.points[i].p) / (velocity - here.velocity));
  }
  return next;
}

bool follows_clearly(const Station& station, const std::vector<Complex>& predicted) {
  std::vector<Complex> solved;
  for (const PkPoint& point : station.points) solved.push_back(point.p);
  const BranchMatch match = match_branches(predicted, solved);
  for (std::size_t i = 0; i < solved.size(); ++i)
    if (match.candidate[i] != static_cast<int>(i)) return false;
  return match.is_clear;
}

// The next station, or the longest shorter one whose branches follow clearly from `here`. Modes that coincide
// never do: they are then started from different solutions at the target.
Station advance(const MatchedModes& modes, const Station& here, double target) {
  constexpr int max_halvings = 20;
  std::vector<Complex> predicted;
  const auto predict = [&](double step) {
    predicted.clear();
    for (std::size_t i = 0; i < here.points.size(); ++i)
      predicted.push_back(here.points[i].p + step * here.slope[i]);
  };
  double step = target - here.velocity;
  for (int halving = 0; halving <= max_halvings; ++halving, step *= 0.5) {
    predict(step);
    Station next = station_at(modes, here, halving == 0 ? target : here.velocity + step, predicted);
    if (follows_clearly(next, predicted)) return next;
  }
  predict(target - here.velocity);
  return station_at(modes, here, target, modes.distinct(target, predicted));
}

// A mode without aerodynamic damping has Re p = 0 but for round-off: that is no crossing.
bool is_neutral(const PkPoint& point) { return std::abs(point.p.real()) <= 1e-11 * std::abs(point.p); }

bool crosses(const PkPoint& a, const PkPoint& b) {
  return a.status == PkStatus::converged && b.status == PkStatus::converged &&
         a.p.real() * b.p.real() < 0.0 && !(is_neutral(a) && is_neutral(b));
}

// Re p = 0 on branch i between two stations, by regula falsi with the Illinois rule.
PkCrossing locate(const MatchedModes& modes, const Station& a, const Station& b, std::size_t i,
                  const PkOptions& options) {
  PkPoint low = a.points[i], high = b.points[i];
  double at_low = low.p.real(), at_high = high.p.real();
  const bool rises = at_high > at_low;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    const double t = at_low / (at_low - at_high);
    const double velocity = low.reduced_velocity + t * (high.reduced_velocity - low.reduced_velocity);
    const PkPoint middle = modes.at(velocity, low.p + t * (high.p - low.p));
    if (std::signbit(middle.p.real()) == std::signbit(at_high)) {
      at_low *= 0.5;
    } else {
      low = high;
      at_low = at_high;
    }
    high = middle;
    at_high = middle.p.real();
    if (std::abs(at_high) <= options.tolerance * std::abs(middle.p)) break;
  }
  return {static_cast<int>(i), high, rises};
}

void check_request(const StructureModel& model, double k_min, double k_max,
                   std::span<const double> velocities) {
  check(model);
  if (!(k_min >= 0.0) || !(k_max > k_min))
    throw InputError(
        fmt::format("p-k: reduced frequencies {} to {}; must be 0 <= first < last", k_min, k_max));
  double previous = 0.0;
  for (const double velocity : velocities) {
    if (!(velocity > previous) || !std::isfinite(velocity))
      throw InputError(fmt::format("p-k: reduced velocity {} after {}; speeds must be > 0 and ascend",
                                   velocity, previous));
    previous = velocity;
  }
}

}  // namespace

MotionSpectrum motion_spectrum(const Eigen::MatrixXd& inverse_mass, const Eigen::MatrixXcd& damping,
                               const Eigen::MatrixXcd& stiffness) {
  const Eigen::Index m = inverse_mass.rows();
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(2 * m, 2 * m);
  companion.topRightCorner(m, m).setIdentity();
  companion.bottomLeftCorner(m, m) = -inverse_mass * stiffness;
  companion.bottomRightCorner(m, m) = -inverse_mass * damping;
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(companion);
  ensure(solver.info() == Eigen::Success, "p-k: the eigenvalue solver did not converge");
  return {solver.eigenvalues(), solver.eigenvectors().topRows(m).colwise().normalized()};
}

Eigen::MatrixXcd held(const AerodynamicMatrix& q, double k, double k_min, double k_max) {
  const Eigen::MatrixXcd value = q(std::clamp(std::abs(k), k_min, k_max));
  return k < 0.0 ? value.conjugate() : value;
}

PkResult follow_modes(const StructureModel& model, const SpectrumAt& spectrum, double k_min, double k_max,
                      std::span<const double> reduced_velocities, const PkOptions& options) {
  check_request(model, k_min, k_max, reduced_velocities);
  const MatchedModes modes(model, spectrum, k_min, k_max, options);
  Station here{0.0, modes.at_rest(), std::vector<Complex>(static_cast<std::size_t>(model.size()))};
  PkResult result;
  result.branches.resize(here.points.size());
  for (const double velocity : reduced_velocities) {
    while (here.velocity < velocity) {
      Station next = advance(modes, here, velocity);
      for (std::size_t i = 0; i < next.points.size(); ++i) {
        if (!crosses(here.points[i], next.points[i])) continue;
        PkCrossing found = locate(modes, here, next, i, options);
        if (found.point.status == PkStatus::converged) result.crossings.push_back(std::move(found));
      }
      here = std::move(next);
    }
    for (std::size_t i = 0; i < here.points.size(); ++i) result.branches[i].push_back(here.points[i]);
  }
  std::stable_sort(result.crossings.begin(), result.crossings.end(),
                   [](const PkCrossing& a, const PkCrossing& b) {
                     return a.point.reduced_velocity < b.point.reduced_velocity;
                   });
  return result;
}

}  // namespace wingbeat
