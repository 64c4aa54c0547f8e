#pragma once

#include <optional>
#include <vector>

#include "core/spectral/time_spectral.hpp"
#include "flow/flow_jacobian.hpp"
#include "flow/flux_balance.hpp"
#include "flow/loads.hpp"
#include "flow/time_term.hpp"

namespace wingbeat {

// The flow equations R of all instances of a rank's cells (eq:time-spectral):
//   R_n = kappa sum_m D_nm Omega w_m + balance(w_n, motion_n),
// and of a step in time (eq:dual-time), whose time term is shift Omega w_n instead. State vectors hold
// [instance][owned cell][variable]. Steady flow is N_H = 0 without a shift.
template <int Dim>
class FlowEquations {
 public:
  static constexpr int n = state_size<Dim>;

  FlowEquations(const FlowDomain<Dim>& domain, const FlowModel<Dim, double>& model, const TimeSpectral& time);

  const FlowDomain<Dim>& domain() const { return domain_; }
  const FlowModel<Dim, double>& model() const { return model_; }
  const TimeSpectral& time() const { return time_; }
  const WallLoads<Dim>& walls() const { return walls_; }
  std::size_t state_count() const { return instance_count() * domain_.state_count(); }
  std::size_t instance_count() const { return static_cast<std::size_t>(time_.instances()); }

  std::vector<double> uniform_state() const;
  // L2 norm of R over cells, equations and instances of uniform flow on the mesh at rest: the
  // scale of reported flow residuals. Collective.
  double uniform_residual();

  // The following are collective. One motion an instance.
  void residual(std::span<const double> w, std::span<const MotionState> motions, TimeTerm term,
                std::span<double> r);
  // r = R less its time derivative, with a dissipation that moves by the share `renewed` to that of w
  // (FluxBalance::evaluate_stage).
  void stage_balance(std::span<const double> w, std::span<const MotionState> motions, double renewed,
                     std::span<double> dissipation, std::span<double> r);
  // sum_m D_nm Omega w_m: the derivative of R with respect to kappa alone.
  void add_time_derivative(double scale, std::span<const double> w, std::span<double> r) const;
  std::vector<Loads<double>> loads(std::span<const double> w, std::span<const MotionState> motions);

  // Makes jacobians() those of the given state.
  void linearize_state(std::span<const double> w, std::span<const MotionState> motions, TimeTerm term);
  // The same, and motion_gradients(), load_gradients() and linearized_loads().
  void linearize(std::span<const double> w, std::span<const MotionState> motions, TimeTerm term);

  const std::vector<BlockSparse<n>>& jacobians() const { return jacobians_; }
  // Columns d R_n / d (pitch, pitch_rate, plunge_rate) of instance n.
  const std::array<std::vector<double>, 3>& motion_gradients(std::size_t instance) const {
    return motion_gradients_[instance];
  }
  const LoadGradients& load_gradients(std::size_t instance) const { return load_gradients_[instance]; }
  // Loads with their gradients with respect to the same three.
  const Loads<Dual<double, 3>>& linearized_loads(std::size_t instance) const {
    return linearized_loads_[instance];
  }

  // y = (dR/dw) x and y = (dR/dw)^T x, at the last linearization.
  void apply(std::span<const double> x, std::span<double> y) const;
  void apply_transpose(std::span<const double> x, std::span<double> y) const;

 private:
  void add_time_term(TimeTerm term, std::span<const double> w, std::span<double> r) const;
  void fetch_ghosts(std::span<const double> w) const;
  std::span<const double> ghosts_of(std::size_t instance) const;

  const FlowDomain<Dim>& domain_;
  FlowModel<Dim, double> model_;
  TimeSpectral time_;
  FluxBalance<Dim, double> balance_;
  // Made at the first linearization: what only evaluates residuals does not pay for them.
  std::optional<FluxBalance<Dim, Dual<double, 3>>> motion_balance_;
  std::optional<FlowJacobian<Dim>> assembler_;
  WallLoads<Dim> walls_;
  TimeTerm term_;  // of the last linearization
  std::vector<BlockSparse<n>> jacobians_;
  std::vector<std::array<std::vector<double>, 3>> motion_gradients_;
  std::vector<LoadGradients> load_gradients_;
  std::vector<Loads<Dual<double, 3>>> linearized_loads_;
  mutable std::vector<double> ghosts_;  // [instance][ghost cell][variable]
};

}  // namespace wingbeat
