#include "flow/dual_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/error.hpp"
#include "flow/shifted_jacobian.hpp"
#include "flow/spectral_radius.hpp"
#include "flow/step_limit.hpp"

namespace wingbeat {
namespace {

// Steps that differ by less are equal: round-off of a caller's clock.
constexpr double step_tolerance = 1e-9;
// A cycle after which the residual is this many times the smallest so far has left the basin.
constexpr double hopeless_growth = 50.0;
constexpr int max_halvings = 6;
// A linear system is solved to this share of what is left to the tolerance, but not closer than the
// linearization is worth.
constexpr double linear_share = 0.5, least_forcing = 1e-3;

// Norm of eps (sum of spectral radii + shift Omega) w: what rounding the terms of R makes of R, but for
// a factor of the number of terms.
template <int Dim>
double rounding(const FlowEquations<Dim>& flow, std::span<const double> w, std::span<const double> shifts) {
  const auto radii = spectral_radius_sums<Dim>(flow.domain(), w, {}, flow.model().freestream.gamma);
  double sum = 0.0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const std::size_t cell = i / state_size<Dim>;
    const double term = (radii[cell] + shifts[cell]) * w[i];
    sum += term * term;
  }
  return std::numeric_limits<double>::epsilon() * std::sqrt(flow.domain().comm().sum(sum));
}
constexpr double rounded_terms = 2.0;

}  // namespace

template <int Dim>
DualTime<Dim>::DualTime(FlowLevel<Dim>& level, const DualTimeOptions& options)
    : level_(level),
      flow_(level.steady),
      options_(options),
      source_(flow_.state_count()),
      shifts_(flow_.domain().volumes().size()),
      r_(flow_.state_count()),
      trial_(flow_.state_count()),
      trial_r_(flow_.state_count()),
      dw_(flow_.state_count()) {
  ensure(flow_.instance_count() == 1, "a step in time has one instance");
  if (options.by_cycles)
    multigrid_ = std::make_unique<Multigrid<Dim>>(flow_, DividedMesh<Dim>{level.mesh, level.partition},
                                                  options.multigrid);
}

template <int Dim>
void DualTime<Dim>::start(std::vector<std::vector<double>> history) {
  ensure(!history.empty(), "a step in time needs a level to start from");
  for (const auto& level : history)
    ensure(level.size() == flow_.state_count(), "a level of the history is no state of this flow");
  history_ = std::move(history);
  history_.resize(std::min(history_.size(), static_cast<std::size_t>(options_.order) + 1));
  w_ = history_.front();
  dt_ = shift_ = 0.0;
  is_open_ = false;
}

template <int Dim>
void DualTime<Dim>::begin(double dt) {
  ensure(!history_.empty(), "a step in time needs start() first");
  ensure(dt > 0.0 && (dt_ == 0.0 || std::abs(dt - dt_) <= step_tolerance * dt_),
         "the length of a step may change by another start() only");
  if (dt_ == 0.0) dt_ = dt;
  const int levels = static_cast<int>(history_.size());
  const BackwardDifference formula(std::min(options_.order, levels));
  set_formula(formula);

  const std::vector<double> weights = extrapolation_weights(levels);
  for (std::size_t i = 0; i < w_.size(); ++i) {
    double past = 0.0, next = 0.0;
    for (std::size_t k = 0; k < history_.size(); ++k) {
      if (k < 3) past += formula.c[k + 1] * history_[k][i];
      next += weights[k] * history_[k][i];
    }
    source_[i] = -past / formula.c[0] * shifts_[i / state_size<Dim>];
    w_[i] = next;
  }
  // At a shock the extrapolation may overshoot.
  if (flow_.domain().comm().any(!is_physical<Dim>(w_, flow_.model().freestream.gamma))) w_ = history_.front();
  is_open_ = is_only_predicted_ = true;
}

template <int Dim>
void DualTime<Dim>::set_formula(const BackwardDifference& formula) {
  const double shift = formula.c[0] / dt_;
  if (shift == shift_) return;
  set_shift(shift);
  round_off_ = rounded_terms * rounding<Dim>(flow_, history_.front(), shifts_);
  is_linearization_due_ = are_factors_due_ = true;
}

template <int Dim>
void DualTime<Dim>::set_shift(double shift) {
  shift_ = shift;
  const auto volumes = flow_.domain().volumes();
  for (std::size_t c = 0; c < shifts_.size(); ++c) shifts_[c] = shift * volumes[c];
}

template <int Dim>
DualTimeMemory DualTime<Dim>::memory() const {
  ensure(!is_open_, "a step in time is remembered once it has been accepted");
  DualTimeMemory kept{dt_,
                      shift_,
                      round_off_,
                      is_linearization_due_,
                      are_factors_due_,
                      fewest_iterations_,
                      excess_iterations_,
                      linearized_motion_,
                      factored_motion_,
                      {},
                      {}};
  if (!is_linearization_due_) kept.linearized_w = linearized_w_;
  if (!are_factors_due_) kept.factored_w = factored_w_;
  return kept;
}

template <int Dim>
void DualTime<Dim>::resume(const DualTimeMemory& memory) {
  dt_ = memory.dt;
  set_shift(memory.shift);
  round_off_ = memory.round_off;
  if (!memory.are_factors_due) {
    linearize_at(memory.factored_w, memory.factored_motion);
    factor_at_linearization();
  }
  if (!memory.is_linearization_due) linearize_at(memory.linearized_w, memory.linearized_motion);
  is_linearization_due_ = memory.is_linearization_due;
  are_factors_due_ = memory.are_factors_due;
  fewest_iterations_ = memory.fewest_iterations;
  excess_iterations_ = memory.excess_iterations;
}

template <int Dim>
typename DualTime<Dim>::Measure DualTime<Dim>::evaluate(std::span<const double> state,
                                                        const MotionState& motion, std::span<double> r) {
  const Comm& comm = flow_.domain().comm();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (comm.any(!is_physical<Dim>(state, flow_.model().freestream.gamma))) return {infinity, 0.0};
  flow_.residual(state, {&motion, 1}, {0.0, shift_}, r);
  double residual = 0.0, derivative = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double change = shifts_[i / state_size<Dim>] * state[i] - source_[i];
    r[i] -= source_[i];
    residual += r[i] * r[i];
    derivative += change * change;
  }
  return {std::sqrt(comm.sum(residual)), std::sqrt(comm.sum(derivative))};
}

// A residual within its round-off meets any tolerance.
template <int Dim>
double DualTime<Dim>::relative(const Measure& measure, double tolerance) const {
  return measure.residual / std::max(measure.scale, round_off_ / tolerance);
}

template <int Dim>
DualTimeResult DualTime<Dim>::solve(const MotionState& motion, double tolerance) {
  ensure(is_open_, "a step in time is solved between begin() and accept()");
  return options_.by_cycles ? solve_by_cycles(motion, tolerance) : solve_by_newton(motion, tolerance);
}

template <int Dim>
void DualTime<Dim>::linearize(const MotionState& motion, DualTimeResult& result) {
  linearize_at(w_, motion);
  ++result.linearizations;
  is_linearization_due_ = false;
  if (!are_factors_due_) return;
  factor_at_linearization();
  ++result.factorizations;
  are_factors_due_ = false;
  fewest_iterations_ = options_.gmres.max_iterations;
  excess_iterations_ = 0;
}

template <int Dim>
void DualTime<Dim>::linearize_at(const std::vector<double>& w, const MotionState& motion) {
  flow_.linearize_state(w, {&motion, 1}, 0.0);
  linearized_w_ = w;
  linearized_motion_ = motion;
}

template <int Dim>
void DualTime<Dim>::factor_at_linearization() {
  level_.solver->template factor<state_size<Dim>>(flow_.jacobians()[0], shifts_);
  factored_w_ = linearized_w_;
  factored_motion_ = linearized_motion_;
}

// Refactoring when the excess has paid for it keeps the mean cost of a step least where the excess grows
// evenly.
template <int Dim>
bool DualTime<Dim>::are_factors_old(const GmresResult& linear) {
  fewest_iterations_ = std::min(fewest_iterations_, linear.iterations);
  excess_iterations_ += linear.iterations - fewest_iterations_;
  return excess_iterations_ > options_.refactor_iterations || linear.status != GmresStatus::converged;
}

template <int Dim>
DualTimeResult DualTime<Dim>::solve_by_newton(const MotionState& motion, double tolerance) {
  const Comm& comm = flow_.domain().comm();
  const double gamma = flow_.model().freestream.gamma;
  DualTimeResult result;
  Measure now = evaluate(w_, motion, r_);
  while (true) {
    result.residual = relative(now, tolerance);
    if (!std::isfinite(now.residual)) return result.status = SolveStatus::diverged, result;
    const bool is_within = result.residual <= tolerance;
    if (is_within && !is_only_predicted_) return result.status = SolveStatus::converged, result;
    if (result.iterations == options_.max_iterations)
      return result.status = SolveStatus::iteration_limit, result;

    const bool is_fresh = is_linearization_due_;
    if (is_linearization_due_) linearize(motion, result);
    std::fill(dw_.begin(), dw_.end(), 0.0);
    GmresOptions gmres_options = options_.gmres;
    gmres_options.relative_tolerance =
        std::clamp(linear_share * tolerance / result.residual, least_forcing, options_.forcing);
    const GmresResult linear =
        gmres<double>(comm, ShiftedJacobian<Dim>(flow_, shifts_), *level_.solver, r_, dw_, gmres_options);
    result.linear_iterations += linear.iterations;
    ++result.iterations;
    is_only_predicted_ = false;
    are_factors_due_ = are_factors_old(linear);

    for (double& value : dw_) value = -value;
    double step = comm.min(largest_step<Dim>(w_, dw_, gamma, options_.step_limit));
    Measure next;
    for (int halvings = 0;; ++halvings, step *= 0.5) {
      for (std::size_t i = 0; i < w_.size(); ++i) trial_[i] = w_[i] + step * dw_[i];
      next = evaluate(trial_, motion, trial_r_);
      // A direction of an old linearization is given up at once.
      if (next.residual < now.residual || is_within || !is_fresh || halvings == max_halvings) break;
    }
    const bool is_better =
        next.residual < now.residual || (is_within && relative(next, tolerance) <= tolerance);
    is_linearization_due_ =
        are_factors_due_ || (!is_within && !(next.residual <= options_.contraction * now.residual));
    if (is_better) {
      w_.swap(trial_);
      r_.swap(trial_r_);
      now = next;
    } else if (is_fresh && !is_within) {
      return result.status = SolveStatus::stalled, result;
    }
  }
}

template <int Dim>
DualTimeResult DualTime<Dim>::solve_by_cycles(const MotionState& motion, double tolerance) {
  RungeKuttaOptions step = options_.multigrid.runge_kutta;
  DualTimeResult result;
  Measure best = evaluate(w_, motion, r_);
  trial_ = w_;
  int retreats = 0;
  while (true) {
    result.residual = relative(best, tolerance);
    if (!std::isfinite(best.residual)) return result.status = SolveStatus::diverged, result;
    const bool is_within = result.residual <= tolerance;
    if (is_within && !is_only_predicted_) return result.status = SolveStatus::converged, result;
    if (result.iterations == options_.max_cycles) return result.status = SolveStatus::iteration_limit, result;

    multigrid_->cycle(trial_, {&motion, 1}, {0.0, shift_}, step, source_);
    ++result.iterations;
    is_only_predicted_ = false;
    const Measure now = evaluate(trial_, motion, r_);
    if (now.residual < best.residual || (is_within && relative(now, tolerance) <= tolerance)) {
      w_ = trial_;
      best = now;
    } else if (!(now.residual <= hopeless_growth * best.residual)) {
      if (retreats == options_.max_retreats) return result.status = SolveStatus::diverged, result;
      ++retreats;
      step.cfl *= 0.5;
      trial_ = w_;
    }
  }
}

template <int Dim>
Loads<double> DualTime<Dim>::loads(const MotionState& motion) {
  return flow_.loads(w_, {&motion, 1})[0];
}

template <int Dim>
void DualTime<Dim>::accept() {
  ensure(is_open_, "there is no open step in time to accept");
  history_.insert(history_.begin(), w_);
  history_.resize(std::min(history_.size(), static_cast<std::size_t>(options_.order) + 1));
  is_open_ = false;
}

template class DualTime<2>;
template class DualTime<3>;

}  // namespace wingbeat
