#include "flow/forced_flow.hpp"

#include "flow/forced_flow_problem.hpp"
#include "flow/frequency_response.hpp"

namespace wingbeat {

template <int Dim>
ForcedFlowStart steady_start(const FlowLevel<Dim>& level, const TimeSpectral& time) {
  ForcedFlowStart start;
  for (int n = 0; n < time.instances(); ++n) start.w.insert(start.w.end(), level.w.begin(), level.w.end());
  start.factors = unfactored(level.comm(), level.subdomain, state_size<Dim>, time.harmonics());
  if (level.solver->is_factored()) start.factors.mean = level.solver;
  return start;
}

template <int Dim>
ForcedFlowStart linear_start(FlowLevel<Dim>& level, const TimeSpectral& time, const ForcedMotion& motion,
                             double kappa, const GmresOptions& gmres) {
  constexpr double tolerance = 1e-3;  // of a start whose error is of second order in the motion
  using Complex = std::complex<double>;
  ForcedFlowStart start = steady_start<Dim>(level, time);
  const MotionState rest{motion.mean_pitch, 0.0, 0.0};
  level.steady.linearize(level.w, {&rest, 1}, 0.0);
  const std::size_t count = level.w.size();
  for (int h = 1; h <= motion.harmonics(); ++h) {
    const Complex pitch = motion.pitch_harmonic(h), plunge = motion.plunge_harmonic(h);
    if (pitch == 0.0 && plunge == 0.0) continue;
    FrequencyResponse<Dim> response(level.steady, start.factors.harmonics[static_cast<std::size_t>(h - 1)],
                                    tolerance, gmres);
    const HarmonicResponse& unit = response.at(h * kappa);
    for (int n = 0; n < time.instances(); ++n) {
      const Complex turn = std::polar(1.0, h * time.phase(n));
      const Complex by_pitch = turn * pitch, by_plunge = turn * plunge;
      double* const w = start.w.data() + static_cast<std::size_t>(n) * count;
      for (std::size_t i = 0; i < count; ++i)
        w[i] += (by_pitch * unit.pitch[i] + by_plunge * unit.plunge[i]).real();
    }
  }
  const double gamma = level.steady.model().freestream.gamma;
  if (level.comm().any(!is_physical<Dim>(start.w, gamma))) start.w = steady_start<Dim>(level, time).w;
  return start;
}

template <int Dim>
ForcedFlowResult solve_forced_flow(FlowEquations<Dim>& flow, HarmonicFactors factors,
                                   const std::vector<MotionState>& motions, double kappa, std::span<double> w,
                                   const ForcedFlowOptions& options, const ForcedFlowObserver& observer) {
  ForcedFlowProblem<Dim> problem(flow, motions, kappa, std::move(factors), options.tolerance);
  ForcedFlowResult result;
  const NewtonResult solved =
      newton(flow.domain().comm(), problem, w, options.newton,
             [&](const NewtonIteration& i, std::span<const double>, std::span<const double> f) {
               result.residual = problem.measure(f);
               return !observer || observer({i.iteration, result.residual, i.step, i.linear_iterations});
             });
  result.status = solved.status;
  result.iterations = solved.iterations;
  result.linear_iterations = solved.linear_iterations;
  result.factorizations = solved.factorizations;
  return result;
}

template ForcedFlowStart steady_start<2>(const FlowLevel<2>&, const TimeSpectral&);
template ForcedFlowStart steady_start<3>(const FlowLevel<3>&, const TimeSpectral&);
template ForcedFlowStart linear_start<2>(FlowLevel<2>&, const TimeSpectral&, const ForcedMotion&, double,
                                         const GmresOptions&);
template ForcedFlowStart linear_start<3>(FlowLevel<3>&, const TimeSpectral&, const ForcedMotion&, double,
                                         const GmresOptions&);
template ForcedFlowResult solve_forced_flow<2>(FlowEquations<2>&, HarmonicFactors,
                                               const std::vector<MotionState>&, double, std::span<double>,
                                               const ForcedFlowOptions&, const ForcedFlowObserver&);
template ForcedFlowResult solve_forced_flow<3>(FlowEquations<3>&, HarmonicFactors,
                                               const std::vector<MotionState>&, double, std::span<double>,
                                               const ForcedFlowOptions&, const ForcedFlowObserver&);

}  // namespace wingbeat
