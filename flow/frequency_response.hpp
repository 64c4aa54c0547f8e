#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "core/algebra/gmres.hpp"
#include "core/algebra/schwarz.hpp"
#include "flow/frequency_operator.hpp"

namespace wingbeat {

// Harmonic response of a steady flow to small rigid motions (linearized frequency domain):
//   (dR/dw + i kappa Omega) w^ = -(dR/dm) m^,  m = (pitch, pitch_rate, plunge_rate)  (eq:frequency-domain).
struct HarmonicResponse {
  // State amplitudes for unit pitch (radians) and for unit plunge h (chords): [owned cell][variable].
  std::vector<std::complex<double>> pitch, plunge;
  LoadResponse loads;
};

template <int Dim>
class FrequencyResponse {
 public:
  // `flow`: one instance, linearized at the steady state, kept alive and linearized there. `gmres` gives
  // lengths; its tolerance does not count.
  FrequencyResponse(const FlowEquations<Dim>& flow,
                    std::shared_ptr<SchwarzSolver<std::complex<double>>> solver, double tolerance = 1e-10,
                    const GmresOptions& gmres = {});

  // At frequency kappa on the flow's clock. The factors of a near frequency serve while GMRES stays
  // short with them, and its solution is the start. Collective. Throws SolveFailure where the
  // linear solve fails.
  const HarmonicResponse& at(double kappa);

  int factorization_count() const { return factorizations_; }
  int linear_iterations() const { return linear_iterations_; }

 private:
  void solve(double kappa, std::span<const std::complex<double>> rhs, std::vector<std::complex<double>>& x);
  void factor(double kappa);

  const FlowEquations<Dim>& flow_;
  std::shared_ptr<SchwarzSolver<std::complex<double>>> solver_;
  GmresOptions gmres_;
  double factored_kappa_ = -1.0;
  double solved_kappa_ = -1.0;
  HarmonicResponse response_;
  int factorizations_ = 0;
  int linear_iterations_ = 0;
};

}  // namespace wingbeat
