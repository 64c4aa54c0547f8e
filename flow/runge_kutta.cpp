#include "flow/runge_kutta.hpp"

#include <algorithm>
#include <array>

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

}  // namespace

template <int Dim>
RungeKutta<Dim>::RungeKutta(FlowEquations<Dim>& flow)
    : flow_(flow),
      smoothing_(flow.domain()),
      inverse_modulus_(flow.time()),
      time_step_(static_cast<std::size_t>(flow.domain().owned_count())),
      start_(flow.state_count()),
      residual_(flow.state_count()),
      dissipation_(flow.state_count()),
      renewed_(flow.state_count()) {}

// The shortest step of the instances serves all: the time-spectral term couples them in a cell.
template <int Dim>
void RungeKutta<Dim>::set_time_steps(std::span<const double> w, std::span<const MotionState> motions,
                                     const RungeKuttaOptions& options) {
  const FlowDomain<Dim>& domain = flow_.domain();
  const std::size_t count = domain.state_count();
  std::fill(time_step_.begin(), time_step_.end(), 0.0);
  std::vector<double> radii;
  radii.reserve(flow_.instance_count() * time_step_.size() * Dim);
  for (std::size_t i = 0; i < flow_.instance_count(); ++i) {
    const std::vector<double> of_instance = directional_radii<Dim>(
        domain, w.subspan(i * count, count), motions[i], flow_.model().freestream.gamma);
    for (std::size_t c = 0; c < time_step_.size(); ++c) {
      double sum = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) sum += of_instance[c * Dim + d];
      time_step_[c] = std::max(time_step_[c], sum);
    }
    radii.insert(radii.end(), of_instance.begin(), of_instance.end());
  }
  for (double& value : time_step_) value = options.cfl / value;
  if (options.smoothing > 0.0)
    smoothing_.set_coefficients(radii, flow_.time().instances(), options.smoothing);
}

// residual_ = R - source, with the dissipation of this stage.
template <int Dim>
void RungeKutta<Dim>::evaluate_stage(std::size_t stage, std::span<const double> w,
                                     std::span<const MotionState> motions, double kappa,
                                     std::span<const double> source) {
  const double renewed = stages[stage].renewed;
  if (renewed == 0.0) {
    flow_.balance_parts(w, motions, residual_, {});
  } else if (renewed == 1.0) {
    flow_.balance_parts(w, motions, residual_, dissipation_);
  } else {
    flow_.balance_parts(w, motions, residual_, renewed_);
    for (std::size_t i = 0; i < dissipation_.size(); ++i)
      dissipation_[i] += renewed * (renewed_[i] - dissipation_[i]);
  }
  for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] -= dissipation_[i];
  if (kappa != 0.0) flow_.add_time_derivative(kappa, w, residual_);
  for (std::size_t i = 0; i < source.size(); ++i) residual_[i] -= source[i];
}

// residual_ = |I + beta dtau kappa D|^-1 residual_ in each cell.
template <int Dim>
void RungeKutta<Dim>::limit_harmonics(double kappa) {
  constexpr std::size_t n = state_size<Dim>;
  const std::size_t instances = flow_.instance_count(), count = flow_.domain().state_count();
  const auto volumes = flow_.domain().volumes();
  std::vector<double> weights(instances), cell(instances * n);
  for (std::size_t c = 0; c < volumes.size(); ++c) {
    inverse_modulus_.weights(harmonic_limit * kappa * time_step_[c] * volumes[c], weights);
    double* const first = residual_.data() + c * n;
    for (std::size_t i = 0; i < instances; ++i) std::copy_n(first + i * count, n, cell.data() + i * n);
    for (std::size_t i = 0; i < instances; ++i) {
      std::array<double, n> sum{};
      for (std::size_t j = 0; j < instances; ++j) {
        const double weight = weights[(i + instances - j) % instances];
        for (std::size_t v = 0; v < n; ++v) sum[v] += weight * cell[j * n + v];
      }
      std::copy_n(sum.data(), n, first + i * count);
    }
  }
}

template <int Dim>
double RungeKutta<Dim>::step(std::span<double> w, std::span<const MotionState> motions, double kappa,
                             std::span<const double> source, const RungeKuttaOptions& options) {
  constexpr std::size_t n = state_size<Dim>;
  std::copy(w.begin(), w.end(), start_.begin());
  set_time_steps(w, motions, options);
  double sum_of_squares = 0.0;
  for (std::size_t stage = 0; stage < stages.size(); ++stage) {
    evaluate_stage(stage, w, motions, kappa, source);
    if (stage == 0)
      for (double value : residual_) sum_of_squares += value * value;
    const double alpha = stages[stage].alpha;
    for (std::size_t i = 0; i < residual_.size(); ++i)
      residual_[i] *= -alpha * time_step_[i / n % time_step_.size()];
    if (options.smoothing > 0.0) smoothing_.apply(residual_, flow_.time().instances());
    if (kappa != 0.0) limit_harmonics(kappa);
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = start_[i] + residual_[i];
  }
  return sum_of_squares;
}

template class RungeKutta<2>;
template class RungeKutta<3>;

}  // namespace wingbeat
