#include "core/algebra/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/algebra/krylov_kernels.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// |F| must fall by at least this part of what the linear model promises (Armijo).
constexpr double sufficient_decrease = 1e-4;

// A linear residual this far below what is asked of F: solving further would be for nothing.
constexpr double enough = 0.5;

// Factors are out of date where a digit takes this many times the iterations it took when they were new.
constexpr double outdated = 1.5;

// Choice 2 of Eisenstat & Walker with its safeguard against tightening too early
// (doi:10.1137/0917003, gamma = 0.9, alpha = golden ratio).
double next_forcing(double previous, double norm_ratio, const NewtonOptions& options) {
  constexpr double gamma = 0.9;
  constexpr double threshold = 0.1;
  const double guard = gamma * std::pow(previous, std::numbers::phi);
  double forcing = gamma * std::pow(norm_ratio, std::numbers::phi);
  if (guard > threshold) forcing = std::max(forcing, guard);
  return std::clamp(forcing, options.forcing_min, options.forcing_max);
}

// Next step to try after `step` gave |F| = norm: the minimum of the parabola through both values
// of |F|^2 and its slope at 0, kept within [0.1, 0.5] of the step. Halves it where F is unknown.
double shorter_step(double step, double norm_start, double norm, double linear_residual) {
  if (!std::isfinite(norm)) return 0.5 * step;
  const double start = norm_start * norm_start;
  const double slope = -2.0 * start * (1.0 - linear_residual);
  const double curvature = norm * norm - start - slope * step;
  return std::clamp(-0.5 * slope * step * step / curvature, 0.1 * step, 0.5 * step);
}

// One Newton solve: what is carried from iteration to iteration.
class NewtonSolve {
 public:
  NewtonSolve(const Comm& comm, Problem& problem, std::span<double> u, const NewtonOptions& options)
      : comm_(comm),
        problem_(problem),
        u_(u),
        options_(options),
        f_(u.size()),
        rhs_(u.size()),
        step_(u.size()),
        trial_(u.size()),
        f_trial_(u.size()) {}

  NewtonResult run(const NewtonObserver& observer) {
    result_.residual_norm = evaluate(u_, f_);
    double forcing = options_.forcing_max;
    NewtonIteration line{.residual_norm = result_.residual_norm};
    for (;;) {
      if (!std::isfinite(result_.residual_norm)) return end(SolveStatus::diverged);
      const bool is_stopped = observer && comm_.any(!observer(line, u_, f_));
      const double excess = comm_.max(problem_.excess(f_));
      if (excess <= 1.0) return end(SolveStatus::converged);
      if (is_stopped) return end(SolveStatus::interrupted);
      if (result_.iterations >= options_.max_iterations) return end(SolveStatus::iteration_limit);

      const double norm_before = result_.residual_norm;
      problem_.linearize(u_);
      line = {.iteration = result_.iterations + 1};
      if (refactor_due_ || !problem_.is_factored()) refactor(line);
      if (!advance(std::max(forcing, enough / excess), line)) {
        // Old factors may be to blame: once more with new ones, and as exactly as allowed.
        if (line.refactored) return end(failure_);
        refactor(line);
        if (!advance(options_.forcing_min, line)) return end(failure_);
      }
      ++result_.iterations;
      line.residual_norm = result_.residual_norm;
      forcing = next_forcing(forcing, result_.residual_norm / norm_before, options_);
    }
  }

 private:
  NewtonResult end(SolveStatus status) {
    result_.status = status;
    return result_;
  }

  // |F(u)|, infinite where F cannot be evaluated on some rank.
  double evaluate(std::span<const double> u, std::span<double> f) {
    const bool failed = !problem_.residual(u, f);
    if (comm_.any(failed)) return std::numeric_limits<double>::infinity();
    return global_norm<double>(comm_, f);
  }

  void refactor(NewtonIteration& line) {
    problem_.refactor();
    ++result_.factorizations;
    line.refactored = true;
    refactor_due_ = false;
  }

  // Solves J du = -F to `forcing` and takes the step; false, with failure_ set and u_ untouched,
  // when no acceptable step came of it.
  bool advance(double forcing, NewtonIteration& line) {
    double linear_residual = 1.0;
    if (!solve_linear(forcing, line, linear_residual)) return false;
    if (search_line(linear_residual, line)) return true;
    failure_ = SolveStatus::stalled;
    return false;
  }

  bool solve_linear(double forcing, NewtonIteration& line, double& linear_residual) {
    for (std::size_t i = 0; i < f_.size(); ++i) rhs_[i] = -f_[i];
    GmresOptions gmres_options = options_.gmres;
    gmres_options.relative_tolerance = forcing;
    // Factors that are out of date get a fair try, not a long one.
    if (!line.refactored)
      gmres_options.max_iterations = std::min(gmres_options.max_iterations, 2 * options_.refactor_iterations);
    std::fill(step_.begin(), step_.end(), 0.0);
    for (;;) {
      const GmresResult solve =
          gmres<double>(comm_, problem_.jacobian(), problem_.preconditioner(), rhs_, step_, gmres_options);
      line.linear_iterations += solve.iterations;
      result_.linear_iterations += solve.iterations;
      linear_residual = solve.relative_residual;
      note_pace(solve, line.refactored);
      if (solve.status == GmresStatus::converged) return true;
      if (!line.refactored) {
        refactor(line);  // and go on from where the old factors led
        gmres_options.max_iterations = options_.gmres.max_iterations;
        continue;
      }
      // Any reduction of the linear residual makes du a descent direction of |F|.
      failure_ = solve.status == GmresStatus::not_finite ? SolveStatus::diverged : SolveStatus::stalled;
      return std::isfinite(linear_residual) && linear_residual < 1.0;
    }
  }

  void note_pace(const GmresResult& solve, bool with_new_factors) {
    const double digits = std::max(-std::log10(solve.relative_residual), 0.1);
    const double pace = solve.iterations / digits;
    refactor_due_ = solve.iterations > options_.refactor_iterations && pace > outdated * new_pace_;
    if (with_new_factors) new_pace_ = pace;
  }

  bool search_line(double linear_residual, NewtonIteration& line) {
    double step = comm_.min(problem_.step_limit(u_, step_));
    for (int k = 0; k <= options_.max_backtracks; ++k) {
      for (std::size_t i = 0; i < trial_.size(); ++i) trial_[i] = u_[i] + step * step_[i];
      const double norm = evaluate(trial_, f_trial_);
      const double allowed = 1.0 - sufficient_decrease * step * (1.0 - linear_residual);
      if (std::isfinite(norm) && norm <= allowed * result_.residual_norm) {
        std::copy(trial_.begin(), trial_.end(), u_.begin());
        f_.swap(f_trial_);
        result_.residual_norm = norm;
        line.step = step;
        return true;
      }
      step = shorter_step(step, result_.residual_norm, norm, linear_residual);
    }
    return false;
  }

  const Comm& comm_;
  Problem& problem_;
  std::span<double> u_;
  const NewtonOptions& options_;
  std::vector<double> f_, rhs_, step_, trial_, f_trial_;
  NewtonResult result_;
  SolveStatus failure_ = SolveStatus::stalled;
  bool refactor_due_ = false;
  double new_pace_ = 0.0;  // Krylov iterations a digit with new factors; 0: none were made
};

}  // namespace

std::string_view to_string(SolveStatus status) {
  switch (status) {
    case SolveStatus::converged:
      return "converged";
    case SolveStatus::stalled:
      return "stalled";
    case SolveStatus::iteration_limit:
      return "iteration-limit";
    case SolveStatus::diverged:
      return "diverged";
    case SolveStatus::interrupted:
      return "interrupted";
  }
  return "unknown";
}

NewtonResult newton(const Comm& comm, Problem& problem, std::span<double> u, const NewtonOptions& options,
                    const NewtonObserver& observer) {
  ensure(u.size() == problem.local_size(), "newton: start of a wrong size");
  return NewtonSolve(comm, problem, u, options).run(observer);
}

}  // namespace wingbeat
