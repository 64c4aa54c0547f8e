#include "flow/frequency_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/algebra/newton.hpp"
#include "flow/harmonic_preconditioner.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

// dR/dw + i kappa Omega on complex vectors of one instance.
template <int Dim>
class FrequencyOperator final : public LinearOperator<Complex> {
 public:
  FrequencyOperator(const FlowEquations<Dim>& flow, double kappa) : flow_(flow), kappa_(kappa) {}
  std::size_t local_size() const override { return flow_.state_count(); }
  void apply(std::span<const Complex> x, std::span<Complex> y) const override { product(x, y, false); }
  void apply_transpose(std::span<const Complex> x, std::span<Complex> y) const override {
    product(x, y, true);
  }

 private:
  void product(std::span<const Complex> x, std::span<Complex> y, bool transposed) const {
    std::vector<double> part(x.size()), real(x.size()), imaginary(x.size());
    const auto multiply = [&](std::vector<double>& out) {
      if (transposed)
        flow_.apply_transpose(part, out);
      else
        flow_.apply(part, out);
    };
    for (std::size_t i = 0; i < x.size(); ++i) part[i] = x[i].real();
    multiply(real);
    for (std::size_t i = 0; i < x.size(); ++i) part[i] = x[i].imag();
    multiply(imaginary);
    const auto volumes = flow_.domain().volumes();
    for (std::size_t i = 0; i < x.size(); ++i)
      y[i] = Complex(real[i], imaginary[i]) + Complex(0.0, kappa_ * volumes[i / state_size<Dim>]) * x[i];
  }
  const FlowEquations<Dim>& flow_;
  double kappa_;
};

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
  if (result.status != GmresStatus::converged && result.relative_residual > 100 * gmres_.relative_tolerance)
    throw SolveFailure(
        SolveStatus::stalled,
        fmt::format(
            "linearized flow at kappa = {:.4g}: GMRES ended with {} at relative residual {:.1e}; "
            "raise solver.overlap, use fewer ranks, or raise solver.ilu_fill where solver.subdomain = "
            "ilu",
            kappa, to_string(result.status), result.relative_residual));
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
  const auto& loads = flow_.linearized_loads(0);
  response_.pitch_loads = {sums[0] + loads.force_y.gradient[0], sums[1] + loads.moment.gradient[0]};
  response_.plunge_loads = {sums[2], sums[3]};
  return response_;
}

template class FrequencyResponse<2>;
template class FrequencyResponse<3>;

}  // namespace wingbeat
