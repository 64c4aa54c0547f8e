#include "flow/frequency_response.hpp"

#include <algorithm>
#include <cmath>

#include "flow/harmonic_preconditioner.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

Complex dot(std::span<const double> gradient, std::span<const Complex> x) {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += gradient[i] * x[i];
  return sum;
}

}  // namespace

template <int Dim>
FrequencyResponse<Dim>::FrequencyResponse(const FlowEquations<Dim>& flow,
                                          std::shared_ptr<SchwarzSolver<Complex>> solver, double tolerance,
                                          const GmresOptions& gmres)
    : flow_(flow), solver_(std::move(solver)), gmres_(gmres) {
  gmres_.relative_tolerance = tolerance;
}

template <int Dim>
void FrequencyResponse<Dim>::factor(double kappa) {
  solver_->factor(flow_.jacobians()[0],
                  std::span<const Complex>(harmonic_shift(flow_.domain().volumes(), kappa)));
  factored_kappa_ = kappa;
  ++factorizations_;
}

template <int Dim>
void FrequencyResponse<Dim>::solve(double kappa, std::span<const Complex> rhs, std::vector<Complex>& x) {
  constexpr int patience = 20;       // iterations that cost about as much as a factorization
  constexpr double nearness = 0.25;  // relative distance over which factors are worth trying
  x.resize(rhs.size());
  if (std::abs(kappa - factored_kappa_) > nearness * kappa) factor(kappa);
  const FrequencyOperator<Dim> op(flow_, kappa);
  const Comm& comm = flow_.domain().comm();
  GmresOptions options = gmres_;
  if (factored_kappa_ != kappa) options.max_iterations = std::min(options.max_iterations, patience);
  GmresResult result = gmres<Complex>(comm, op, *solver_, rhs, x, options);
  linear_iterations_ += result.iterations;
  if (result.status != GmresStatus::converged && factored_kappa_ != kappa) {
    factor(kappa);
    result = gmres<Complex>(comm, op, *solver_, rhs, x, gmres_);
    linear_iterations_ += result.iterations;
  }
  check_response(result, kappa, gmres_.relative_tolerance);
}

template <int Dim>
const HarmonicResponse& FrequencyResponse<Dim>::at(double kappa) {
  if (kappa == solved_kappa_) return response_;
  const auto& [by_pitch, by_pitch_rate, by_plunge_rate] = flow_.motion_gradients(0);
  const std::size_t count = flow_.state_count();
  std::vector<Complex> pitch_rhs(count), plunge_rhs(count);
  const Complex rate(0.0, kappa);
  for (std::size_t i = 0; i < count; ++i) {
    pitch_rhs[i] = -(by_pitch[i] + rate * by_pitch_rate[i]);
    plunge_rhs[i] = -rate * by_plunge_rate[i];
  }
  solve(kappa, pitch_rhs, response_.pitch);
  solve(kappa, plunge_rhs, response_.plunge);
  solved_kappa_ = kappa;

  const LoadGradients& gradients = flow_.load_gradients(0);
  std::array<Complex, 4> sums{dot(gradients.force_y, response_.pitch), dot(gradients.moment, response_.pitch),
                              dot(gradients.force_y, response_.plunge),
                              dot(gradients.moment, response_.plunge)};
  flow_.domain().comm().sum(sums);
  response_.loads = with_direct_loads(flow_, {{sums[0], sums[1]}, {sums[2], sums[3]}});
  return response_;
}

template class FrequencyResponse<2>;
template class FrequencyResponse<3>;

}  // namespace wingbeat
