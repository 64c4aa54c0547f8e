#include "flow/runge_kutta.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/cell_vector.hpp"
#include "flow/spectral_radius.hpp"

namespace wingbeat {
namespace {

// Martinelli's five stages (eq:runge-kutta). The share of the dissipation that a stage renews: 0
// keeps the last.
struct Stage {
  double alpha;
  double renewed;
};
constexpr std::array<Stage, 5> stages{
    {{1.0 / 4.0, 1.0}, {1.0 / 6.0, 0.0}, {3.0 / 8.0, 0.56}, {1.0 / 2.0, 0.0}, {1.0, 0.44}}};

// beta of eq:inverse-modulus: the scheme is stable and damps on the imaginary axis up to its inverse.
constexpr double harmonic_limit = 0.5;

// Cells whose instances are gathered at a time: instances lie so far apart that their cells compete
// for the same lines of the cache.
constexpr std::size_t chunk = 16;

}  // namespace

template <int Dim>
RungeKutta<Dim>::RungeKutta(FlowEquations<Dim>& flow)
    : flow_(flow),
      smoothing_(flow.domain()),
      inverse_modulus_(flow.time()),
      radii_(static_cast<std::size_t>(flow.domain().owned_count()) * Dim),
      time_step_(static_cast<std::size_t>(flow.domain().owned_count())),
      harmonic_weights_(time_step_.size() * flow.instance_count()),
      start_(flow.state_count()),
      residual_(flow.state_count()),
      dissipation_(flow.state_count()),
      chunk_(flow.instance_count() * chunk) {
  for (int row = 0; row < flow.time().instances(); ++row)
    for (int column = 0; column < flow.time().instances(); ++column)
      derivative_.push_back(flow.time().derivative(row, column));
}

// The shortest step of the instances serves all: the time-spectral term couples them in a cell.
template <int Dim>
void RungeKutta<Dim>::set_time_steps(std::span<const double> w, std::span<const MotionState> motions,
                                     const RungeKuttaOptions& options) {
  const FlowDomain<Dim>& domain = flow_.domain();
  const std::size_t count = domain.state_count();
  std::fill(time_step_.begin(), time_step_.end(), 0.0);
  std::fill(radii_.begin(), radii_.end(), 0.0);
  for (std::size_t i = 0; i < flow_.instance_count(); ++i) {
    const std::vector<double> of_instance = directional_radii<Dim>(
        domain, w.subspan(i * count, count), motions[i], flow_.model().freestream.gamma);
    for (std::size_t c = 0; c < time_step_.size(); ++c) {
      double sum = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) {
        sum += of_instance[c * Dim + d];
        radii_[c * Dim + d] += of_instance[c * Dim + d];
      }
      time_step_[c] = std::max(time_step_[c], sum);
    }
  }
  for (double& value : time_step_) value = options.cfl / value;
}

// Smoothing buys longer steps. Where the highest harmonic is held back to short ones it only keeps rough
// errors of that harmonic from being damped: there it fades out, and the step with it
// (eq:smoothing-of-harmonics). The same holds where a shift makes the steps short (eq:dual-time-stage).
template <int Dim>
void RungeKutta<Dim>::set_smoothing(TimeTerm term, double ratio) {
  const auto volumes = flow_.domain().volumes();
  const double highest = harmonic_limit * term.kappa * flow_.time().harmonics();
  std::vector<double> ratios(time_step_.size());
  for (std::size_t c = 0; c < ratios.size(); ++c) {
    const double longest = time_step_[c] * volumes[c];
    ratios[c] = std::max(1.0, ratio / std::hypot(1.0 + term.shift * longest, highest * longest));
    time_step_[c] *= ratios[c] / ratio;
  }
  // Shares of the sums are those of the means.
  smoothing_.set_coefficients(radii_, 1, ratios);
}

// |I + beta dtau kappa D|^-1 of every cell.
template <int Dim>
void RungeKutta<Dim>::set_harmonic_weights(double kappa) {
  const std::size_t instances = flow_.instance_count();
  const auto volumes = flow_.domain().volumes();
  for (std::size_t c = 0; c < volumes.size(); ++c)
    inverse_modulus_.weights(harmonic_limit * kappa * time_step_[c] * volumes[c],
                             std::span<double>(harmonic_weights_).subspan(c * instances, instances));
}

// residual_ = -alpha dtau r / (1 + alpha dtau shift) with r = residual_ + kappa Omega D w + shift Omega
// start_ - source. Returns the sum of squares of r.
template <int Dim>
double RungeKutta<Dim>::form_changes(std::span<const double> w, TimeTerm term, std::span<const double> source,
                                     double alpha) {
  const std::size_t instances = flow_.instance_count(), count = flow_.domain().state_count();
  const std::span<const double> steps(time_step_), volumes = flow_.domain().volumes();
  const std::span<const double> derivative(derivative_);
  const std::span<CellVector<n>> states(chunk_);
  double* const residual = residual_.data();
  CellVector<n> squares(0.0);
  const auto finish = [&](std::size_t at, std::size_t cell, CellVector<n> r) {
    const double shift = term.shift * volumes[cell];
    if (shift != 0.0) r += shift * load_cell<n>(start_.data() + at);
    if (!source.empty()) r -= load_cell<n>(source.data() + at);
    squares += r * r;
    const double step = alpha * steps[cell];
    store_cell<n>(-step / (1.0 + step * shift) * r, residual + at);
  };
  if (term.kappa == 0.0) {
    for (std::size_t i = 0, at = 0; i < instances; ++i)
      for (std::size_t c = 0; c < steps.size(); ++c, at += n) finish(at, c, load_cell<n>(residual + at));
    return std::experimental::reduce(squares);
  }
  for (std::size_t first = 0; first < steps.size(); first += chunk) {
    const std::size_t last = std::min(first + chunk, steps.size());
    for (std::size_t j = 0; j < instances; ++j)
      for (std::size_t c = first; c < last; ++c)
        states[j * chunk + c - first] = term.kappa * volumes[c] * load_cell<n>(w.data() + j * count + c * n);
    for (std::size_t i = 0; i < instances; ++i)
      for (std::size_t c = first; c < last; ++c) {
        CellVector<n> r = load_cell<n>(residual + i * count + c * n);
        for (std::size_t j = 0; j < instances; ++j)
          r += derivative[i * instances + j] * states[j * chunk + c - first];
        finish(i * count + c * n, c, r);
      }
  }
  return std::experimental::reduce(squares);
}

// w = start_ + residual_, the harmonics of residual_ held back.
template <int Dim>
void RungeKutta<Dim>::advance(std::span<double> w, double kappa) {
  const std::size_t instances = flow_.instance_count(), count = flow_.domain().state_count();
  if (kappa == 0.0) {
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = start_[i] + residual_[i];
    return;
  }
  const std::span<CellVector<n>> changes(chunk_);
  const double *start = start_.data(), *residual = residual_.data();
  for (std::size_t first = 0; first < time_step_.size(); first += chunk) {
    const std::size_t last = std::min(first + chunk, time_step_.size());
    for (std::size_t j = 0; j < instances; ++j)
      for (std::size_t c = first; c < last; ++c)
        changes[j * chunk + c - first] = load_cell<n>(residual + j * count + c * n);
    for (std::size_t i = 0; i < instances; ++i)
      for (std::size_t c = first; c < last; ++c) {
        const double* weights = harmonic_weights_.data() + c * instances;  // even in the distance
        CellVector<n> value = load_cell<n>(start + i * count + c * n);
        for (std::size_t j = 0; j < i; ++j) value += weights[i - j] * changes[j * chunk + c - first];
        for (std::size_t j = i; j < instances; ++j) value += weights[j - i] * changes[j * chunk + c - first];
        store_cell<n>(value, w.data() + i * count + c * n);
      }
  }
}

template <int Dim>
double RungeKutta<Dim>::step(std::span<double> w, std::span<const MotionState> motions, TimeTerm term,
                             std::span<const double> source, const RungeKuttaOptions& options) {
  if (flow_.instance_count() == 1) term.kappa = 0.0;  // a single instance has no derivative
  std::copy(w.begin(), w.end(), start_.begin());
  set_time_steps(w, motions, options);
  if (options.smoothing > 1.0) set_smoothing(term, options.smoothing);
  if (term.kappa != 0.0) set_harmonic_weights(term.kappa);
  double first_sum_of_squares = 0.0;
  for (const Stage& stage : stages) {
    flow_.stage_balance(w, motions, stage.renewed, dissipation_, residual_);
    const double sum_of_squares = form_changes(w, term, source, stage.alpha);
    if (&stage == &stages.front()) first_sum_of_squares = sum_of_squares;
    if (options.smoothing > 1.0) smoothing_.apply(residual_, flow_.time().instances());
    advance(w, term.kappa);
  }
  return first_sum_of_squares;
}

template class RungeKutta<2>;
template class RungeKutta<3>;

}  // namespace wingbeat
