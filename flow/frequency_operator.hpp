#pragma once

#include <array>
#include <complex>
#include <vector>

#include "core/algebra/gmres.hpp"
#include "flow/flow_equations.hpp"

namespace wingbeat {

// dR/dw + i kappa Omega on complex vectors of one instance, at the flow's last linearization
// (eq:frequency-domain).
template <int Dim>
class FrequencyOperator final : public LinearOperator<std::complex<double>> {
 public:
  using Complex = std::complex<double>;

  FrequencyOperator(const FlowEquations<Dim>& flow, double kappa) : flow_(flow), kappa_(kappa) {}
  std::size_t local_size() const override { return flow_.state_count(); }
  void apply(std::span<const Complex> x, std::span<Complex> y) const override;
  void apply_transpose(std::span<const Complex> x, std::span<Complex> y) const override;

 private:
  void product(std::span<const Complex> x, std::span<Complex> y, bool transposed) const;

  const FlowEquations<Dim>& flow_;
  double kappa_;
};

// Throws SolveFailure where GMRES for the operator at kappa ended far from the tolerance.
void check_response(const GmresResult& result, double kappa, double tolerance);

// Amplitudes of (force_y, moment) for unit pitch (radians) and for unit plunge h (chords).
struct LoadResponse {
  std::array<std::complex<double>, 2> pitch{}, plunge{};
};

// The loads of which the states' share is given: what the motion does by itself is added.
template <int Dim>
LoadResponse with_direct_loads(const FlowEquations<Dim>& flow, LoadResponse response);

}  // namespace wingbeat
