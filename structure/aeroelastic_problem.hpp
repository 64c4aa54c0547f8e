#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/algebra/newton.hpp"
#include "flow/flow_equations.hpp"
#include "flow/harmonic_preconditioner.hpp"
#include "structure/aeroelastic_linearization.hpp"
#include "structure/bordered_preconditioner.hpp"
#include "structure/conditions.hpp"
#include "structure/section_kinematics.hpp"
#include "structure/structural_equation.hpp"

namespace wingbeat {

// Residuals as reported: flow is the L2 norm of R relative to that of uniform flow, structure and
// phase are L2 norms of S/s and Y/s, energy is |E|.
struct AeroelasticResiduals {
  double flow = 0.0;
  double structure = 0.0;
  double phase = 0.0;
  double energy = 0.0;
};

struct AeroelasticTolerances {
  double flow = 1e-10;
  double structure = 1e-9;  // also phase and energy
};

// A state in physical terms. y, omega and r are the same on all ranks.
struct AeroelasticState {
  std::vector<double> w;  // [instance][owned cell][variable]
  std::vector<double> y;  // [instance][2 modes]
  double omega = 0.0;
  double r = 1.0;
};

// Multipliers of the rows in physical terms: of R, S, Y and the cycle's row. The last three are the same on
// all ranks.
struct AeroelasticMultipliers {
  std::vector<double> flow;
  std::vector<double> structure;
  double phase = 0.0;
  double cycle = 0.0;
};

// The flutter or limit-cycle problem of a rigid section, F = (R/s, S/s, Y/s, E) in the unknowns
// (w^, y^, omega, r) with w = w_s + s w^, y = y_s + s y^, s = sqrt(E_0): every block is O(1) however
// small the amplitude (eq:closed-system); E is the row of `cycle` (eq:cycle-row). Without one it is static
// aeroelastic equilibrium, F = (R, S) in (w, y) at given r, with N_H = 0 and s = 1. Vectors hold w^ of the
// rank's cells; on rank 0, y^ (and omega, r) follow.
template <int Dim>
class AeroelasticProblem final : public Problem {
 public:
  // `base`: w_s and y_s, one instance of each, that w^ and y^ are measured from; its r holds in
  // static equilibrium. `factors` may hold factors already, of matrices near those to come.
  AeroelasticProblem(FlowEquations<Dim>& flow, StructuralEquation structure,
                     const SectionKinematics& kinematics, std::optional<CycleCondition> cycle,
                     AeroelasticState base, HarmonicFactors factors, const AeroelasticTolerances& tolerances);

  std::vector<double> unknowns(const AeroelasticState& state) const;
  AeroelasticState state(std::span<const double> u) const;        // collective
  AeroelasticResiduals measure(std::span<const double> f) const;  // collective
  std::vector<MotionState> motions(const AeroelasticState& state) const;
  std::vector<double> forces(const AeroelasticState& state);  // f = (-C_l, 2 C_m) of every instance

  // How derivatives read in the problem's scaled layout, and multipliers outside of it. `by_state` holds
  // dJ/d(w, y, omega, r), `flow` and `structure` changes of R and S.
  std::vector<double> by_unknowns(const AeroelasticState& by_state) const;
  std::vector<double> rows(std::span<const double> flow, std::span<const double> structure,
                           double cycle) const;
  AeroelasticMultipliers multipliers(std::span<const double> lambda) const;  // collective

  FlowEquations<Dim>& flow() const { return flow_; }
  const StructuralEquation& structure() const { return structure_; }
  const SectionKinematics& kinematics() const { return linearization_.kinematics; }
  const std::optional<CycleCondition>& cycle() const { return cycle_; }

  std::size_t local_size() const override;
  bool residual(std::span<const double> u, std::span<double> f) override;
  void linearize(std::span<const double> u) override;
  const LinearOperator<double>& jacobian() const override { return jacobian_; }
  void refactor() override;
  bool is_factored() const override { return harmonic_.is_factored(); }
  const LinearOperator<double>& preconditioner() const override { return preconditioner_; }
  double step_limit(std::span<const double> u, std::span<const double> du) const override;
  double excess(std::span<const double> f) const override;

 private:
  bool is_periodic() const { return cycle_.has_value(); }
  void linearize_tail(const AeroelasticState& state, const std::vector<double>& f);
  void linearize_flow_by_frequency(const AeroelasticState& state, std::span<const double> u);

  FlowEquations<Dim>& flow_;
  StructuralEquation structure_;
  std::optional<CycleCondition> cycle_;
  HarmonicCondition phase_;
  AeroelasticState base_;
  AeroelasticTolerances tolerances_;
  double scale_;  // s
  double uniform_residual_;
  double omega_ = 0.0;  // of the last linearization

  AeroelasticLinearization<Dim> linearization_;
  AeroelasticJacobian<Dim> jacobian_;
  HarmonicPreconditioner<Dim> harmonic_;
  BorderedPreconditioner<Dim> preconditioner_;
};

}  // namespace wingbeat
