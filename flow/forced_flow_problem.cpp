#include "flow/forced_flow_problem.hpp"

#include <cmath>

#include "flow/step_limit.hpp"

namespace wingbeat {

template <int Dim>
ForcedFlowProblem<Dim>::ForcedFlowProblem(FlowEquations<Dim>& flow, std::vector<MotionState> motions,
                                          double kappa, HarmonicFactors factors, double tolerance)
    : flow_(flow),
      motions_(std::move(motions)),
      kappa_(kappa),
      tolerance_(tolerance),
      uniform_residual_(flow.uniform_residual()),
      jacobian_(flow),
      harmonic_(flow.domain(), flow.time(), std::move(factors)) {}

template <int Dim>
double ForcedFlowProblem<Dim>::measure(std::span<const double> f) const {
  double sum = 0.0;
  for (double value : f) sum += value * value;
  return std::sqrt(flow_.domain().comm().sum(sum)) / uniform_residual_;
}

template <int Dim>
bool ForcedFlowProblem<Dim>::residual(std::span<const double> u, std::span<double> f) {
  if (flow_.domain().comm().any(!is_physical<Dim>(u, flow_.model().freestream.gamma))) return false;
  flow_.residual(u, motions_, kappa_, f);
  return true;
}

template <int Dim>
void ForcedFlowProblem<Dim>::linearize(std::span<const double> u) {
  flow_.linearize_state(u, motions_, kappa_);
}

template <int Dim>
void ForcedFlowProblem<Dim>::refactor() {
  if (is_factored())
    harmonic_.factor(flow_, kappa_);
  else
    harmonic_.factor_missing(flow_, kappa_);
}

template <int Dim>
double ForcedFlowProblem<Dim>::step_limit(std::span<const double> u, std::span<const double> du) const {
  return largest_step<Dim>(u, du, flow_.model().freestream.gamma, 0.25);
}

template class ForcedFlowProblem<2>;
template class ForcedFlowProblem<3>;

}  // namespace wingbeat
