#include "flow/frequency_operator.hpp"

#include <fmt/format.h>

#include "core/algebra/newton.hpp"

namespace wingbeat {

template <int Dim>
void FrequencyOperator<Dim>::product(std::span<const Complex> x, std::span<Complex> y,
                                     bool transposed) const {
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

template <int Dim>
void FrequencyOperator<Dim>::apply(std::span<const Complex> x, std::span<Complex> y) const {
  product(x, y, false);
}
template <int Dim>
void FrequencyOperator<Dim>::apply_transpose(std::span<const Complex> x, std::span<Complex> y) const {
  product(x, y, true);
}

void check_response(const GmresResult& result, double kappa, double tolerance) {
  if (result.status == GmresStatus::converged || result.relative_residual <= 100.0 * tolerance) return;
  throw SolveFailure(
      SolveStatus::stalled,
      fmt::format("linearized flow at kappa = {:.4g}: GMRES ended with {} at relative residual {:.1e}; "
                  "raise solver.overlap, use fewer ranks, or raise solver.ilu_fill where "
                  "solver.subdomain = ilu",
                  kappa, to_string(result.status), result.relative_residual));
}

template <int Dim>
LoadResponse with_direct_loads(const FlowEquations<Dim>& flow, LoadResponse response) {
  const auto& loads = flow.linearized_loads(0);
  response.pitch[0] += loads.force_y.gradient[0];
  response.pitch[1] += loads.moment.gradient[0];
  return response;
}

template class FrequencyOperator<2>;
template class FrequencyOperator<3>;
template LoadResponse with_direct_loads<2>(const FlowEquations<2>&, LoadResponse);
template LoadResponse with_direct_loads<3>(const FlowEquations<3>&, LoadResponse);

}  // namespace wingbeat
