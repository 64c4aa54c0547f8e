#pragma once

#include <span>
#include <vector>

#include "core/spectral/inverse_modulus.hpp"
#include "flow/cell_vector.hpp"
#include "flow/flow_equations.hpp"
#include "flow/residual_smoothing.hpp"

namespace wingbeat {

struct RungeKuttaOptions {
  double cfl = 5.0;
  double smoothing = 2.0;  // CFL number over that of unsmoothed residuals; 0: no smoothing
};

// Five-stage Runge-Kutta steps in pseudo-time of all instances at once (eq:runge-kutta):
//   Omega dw/dtau = -(R(w) - source),
// with local time steps, dissipation renewed at stages 1, 3 and 5, residuals smoothed implicitly,
// and every harmonic held back in each cell as its own frequency demands (eq:inverse-modulus), so
// that neither frequency nor number of harmonics restricts the step of the others. The shift of a
// step in time is taken at the stage sought (eq:dual-time-stage): however short or long that step,
// pseudo-time is stable.
template <int Dim>
class RungeKutta {
 public:
  explicit RungeKutta(FlowEquations<Dim>& flow);

  // Advances w by one step; `source` is empty (none) or has the size of w. Returns this rank's sum
  // of squares of R(w) - source before the step. Collective.
  double step(std::span<double> w, std::span<const MotionState> motions, TimeTerm term,
              std::span<const double> source, const RungeKuttaOptions& options);

 private:
  static constexpr int n = state_size<Dim>;

  void set_time_steps(std::span<const double> w, std::span<const MotionState> motions,
                      const RungeKuttaOptions& options);
  void set_smoothing(TimeTerm term, double ratio);
  void set_harmonic_weights(double kappa);
  // residual_ = R before its time term -> change of a stage. Returns the sum of squares of R - source,
  // the shift in it taken at the start of the step.
  double form_changes(std::span<const double> w, TimeTerm term, std::span<const double> source, double alpha);
  void advance(std::span<double> w, double kappa);

  FlowEquations<Dim>& flow_;
  ResidualSmoothing<Dim> smoothing_;
  InverseModulus inverse_modulus_;
  std::vector<double> radii_;             // sums over the instances: [owned cell][direction]
  std::vector<double> time_step_;         // dtau / Omega: [owned cell], the same at all instances
  std::vector<double> harmonic_weights_;  // of InverseModulus: [owned cell][distance of instances]
  std::vector<double> start_;             // w at the start of the step
  std::vector<double> residual_, dissipation_;
  std::vector<double> derivative_;    // D: [instance][instance]
  std::vector<CellVector<n>> chunk_;  // [instance][cell of a chunk]
};

}  // namespace wingbeat
