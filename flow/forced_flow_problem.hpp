#pragma once

#include <vector>

#include "core/algebra/newton.hpp"
#include "flow/flow_equations.hpp"
#include "flow/harmonic_preconditioner.hpp"

namespace wingbeat {

// The periodic flow about a section whose motion is prescribed: R(w) = 0 of all instances, in w alone
// (eq:time-spectral). Residuals are reported relative to that of uniform flow on the mesh at rest.
template <int Dim>
class ForcedFlowProblem final : public Problem {
 public:
  // One motion an instance; kappa is the frequency on the flow's clock. `factors` may hold factors
  // already, of matrices near those to come. Collective.
  ForcedFlowProblem(FlowEquations<Dim>& flow, std::vector<MotionState> motions, double kappa,
                    HarmonicFactors factors, double tolerance);

  double measure(std::span<const double> f) const;  // relative |R|; collective

  std::size_t local_size() const override { return flow_.state_count(); }
  bool residual(std::span<const double> u, std::span<double> f) override;
  void linearize(std::span<const double> u) override;
  const LinearOperator<double>& jacobian() const override { return jacobian_; }
  void refactor() override;
  bool is_factored() const override { return harmonic_.is_factored(); }
  // The harmonic one at any amplitude: measured, the multiplicative one takes twice the iterations and
  // stalls at several degrees, its solves an instance being poor where kappa Omega outweighs the fluxes.
  const LinearOperator<double>& preconditioner() const override { return harmonic_; }
  double step_limit(std::span<const double> u, std::span<const double> du) const override;
  double excess(std::span<const double> f) const override { return measure(f) / tolerance_; }

 private:
  class Jacobian final : public LinearOperator<double> {
   public:
    explicit Jacobian(const FlowEquations<Dim>& flow) : flow_(flow) {}
    std::size_t local_size() const override { return flow_.state_count(); }
    void apply(std::span<const double> x, std::span<double> y) const override { flow_.apply(x, y); }
    void apply_transpose(std::span<const double> x, std::span<double> y) const override {
      flow_.apply_transpose(x, y);
    }

   private:
    const FlowEquations<Dim>& flow_;
  };

  FlowEquations<Dim>& flow_;
  std::vector<MotionState> motions_;
  double kappa_;
  double tolerance_;
  double uniform_residual_;
  Jacobian jacobian_;
  HarmonicPreconditioner<Dim> harmonic_;
};

}  // namespace wingbeat
