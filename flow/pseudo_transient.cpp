#include "flow/pseudo_transient.hpp"

#include <algorithm>
#include <cmath>

#include "flow/shifted_jacobian.hpp"
#include "flow/spectral_radius.hpp"
#include "flow/step_limit.hpp"

namespace wingbeat {
template <int Dim>
PseudoTransientResult pseudo_transient(FlowEquations<Dim>& flow, const MotionState& motion,
                                       SchwarzSolver<double>& solver, std::span<double> w,
                                       const PseudoTransientOptions& options,
                                       const PseudoTransientObserver& observer,
                                       std::span<const double> source) {
  const Comm& comm = flow.domain().comm();
  const double gamma = flow.model().freestream.gamma;
  const std::span<const MotionState> motions(&motion, 1);
  double scale = source.empty() ? flow.uniform_residual() : 1.0;
  std::vector<double> r(w.size()), dw(w.size()), trial(w.size()), trial_r(w.size()), shift;

  const auto residual = [&](std::span<const double> state, std::span<double> out) {
    if (comm.any(!is_physical<Dim>(state, gamma))) return std::numeric_limits<double>::infinity();
    flow.residual(state, motions, 0.0, out);
    double sum = 0.0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (!source.empty()) out[i] -= source[i];
      sum += out[i] * out[i];
    }
    return std::sqrt(comm.sum(sum)) / scale;
  };

  PseudoTransientResult result;
  result.residual = residual(w, r);
  // Without walls uniform flow leaves nothing to measure by: the source does.
  if (!source.empty()) {
    scale *= result.residual;
    result.residual = 1.0;
  }
  const auto cfl_target = [&] {
    return options.cfl_initial * std::pow(result.residual, -options.cfl_growth);
  };
  double cfl = cfl_target();
  bool refactor = true;
  PseudoTransientIteration report{0, result.residual, cfl, 0.0, 0, false};
  while (true) {
    const bool is_stopped = observer && comm.any(!observer(report));
    if (!std::isfinite(result.residual)) return result.status = SolveStatus::diverged, result;
    if (result.residual <= options.tolerance) return result.status = SolveStatus::converged, result;
    if (is_stopped) return result.status = SolveStatus::interrupted, result;
    if (result.iterations == options.max_iterations)
      return result.status = SolveStatus::iteration_limit, result;

    flow.linearize_state(w, motions, 0.0);
    shift = spectral_radius_sums<Dim>(flow.domain(), w, motion, gamma);
    for (double& value : shift) value /= cfl;
    if (refactor || !solver.is_factored()) {
      solver.template factor<state_size<Dim>>(flow.jacobians()[0], shift);
      ++result.factorizations;
      refactor = false;
      report.refactored = true;
    } else {
      report.refactored = false;
    }
    for (double& value : r) value = -value;
    std::fill(dw.begin(), dw.end(), 0.0);
    GmresOptions gmres_options = options.gmres;
    gmres_options.relative_tolerance = options.forcing;
    const GmresResult linear =
        gmres<double>(comm, ShiftedJacobian<Dim>(flow, shift), solver, r, dw, gmres_options);
    result.linear_iterations += linear.iterations;
    report.linear_iterations = linear.iterations;
    refactor = linear.iterations > options.refactor_iterations || linear.status != GmresStatus::converged;

    double step = comm.min(largest_step<Dim>(w, dw, gamma, options.step_limit));
    double trial_residual = 0.0;
    // The residual may rise on the way, but not by much.
    for (int attempt = 0; attempt < 6; ++attempt, step *= 0.5) {
      for (std::size_t i = 0; i < w.size(); ++i) trial[i] = w[i] + step * dw[i];
      trial_residual = residual(trial, trial_r);
      if (trial_residual <= 1.5 * result.residual) break;
    }
    ++result.iterations;
    if (trial_residual <= 1.5 * result.residual) {
      std::copy(trial.begin(), trial.end(), w.begin());
      r.swap(trial_r);
      result.residual = trial_residual;
      cfl = step < 0.5 ? std::max(cfl * step, 1.0) : std::min(cfl_target(), cfl * 10.0);
    } else {
      for (double& value : r) value = -value;
      cfl *= 0.1;
      refactor = true;
      if (cfl < 1e-3) return result.status = SolveStatus::stalled, result;
    }
    report = {result.iterations, result.residual, cfl, step, linear.iterations, report.refactored};
  }
}

template PseudoTransientResult pseudo_transient<2>(FlowEquations<2>&, const MotionState&,
                                                   SchwarzSolver<double>&, std::span<double>,
                                                   const PseudoTransientOptions&,
                                                   const PseudoTransientObserver&, std::span<const double>);
template PseudoTransientResult pseudo_transient<3>(FlowEquations<3>&, const MotionState&,
                                                   SchwarzSolver<double>&, std::span<double>,
                                                   const PseudoTransientOptions&,
                                                   const PseudoTransientObserver&, std::span<const double>);

}  // namespace wingbeat
