#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/algebra/newton.hpp"
#include "flow/backward_difference.hpp"
#include "flow/flow_level.hpp"
#include "flow/multigrid.hpp"

namespace wingbeat {

struct DualTimeOptions {
  int order = 2;            // of the backward difference, 1 to 3
  double tolerance = 1e-4;  // on |R + Omega dw/dt| relative to |Omega dw/dt|
  bool by_cycles = false;   // Runge-Kutta multigrid in place of Newton's method
  int max_iterations = 30;  // of Newton's method in a solve
  int max_cycles = 500;     // of multigrid in a solve
  int max_retreats = 6;     // of the CFL number in a solve by cycles
  double forcing = 0.1;     // largest linear tolerance
  // An iteration that leaves more than this share of the residual is followed by a linearization at the
  // new state.
  double contraction = 0.1;
  // What new factors cost, in Krylov iterations: they are made once old ones have cost as many more than
  // they did when new.
  int refactor_iterations = 25;
  double step_limit = 0.25;  // largest relative change of density and pressure in an iteration
  GmresOptions gmres{};
  MultigridOptions multigrid{};
};

struct DualTimeResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;  // of Newton's method, or cycles
  int linear_iterations = 0;
  int linearizations = 0;
  int factorizations = 0;
  double residual = 1.0;  // |R + Omega dw/dt| relative to |Omega dw/dt|
};

// What the steps go on with, bit for bit but for how factors were pivoted, beside the levels: a linearization
// and factors are kept over steps, and made again from what they were made of.
struct DualTimeMemory {
  double dt = 0.0;
  double shift = 0.0;
  double round_off = 0.0;
  bool is_linearization_due = true;
  bool are_factors_due = true;
  int fewest_iterations = 0;
  int excess_iterations = 0;
  MotionState linearized_motion, factored_motion;
  std::vector<double> linearized_w, factored_w;  // empty where none is kept
};

// The flow about a section in motion, one step of constant length after another (eq:dual-time):
//   (Omega/dt) sum_k c_k w^{n+1-k} + balance(w^{n+1}, motion^{n+1}) = 0,
// on a mesh that moves rigidly: volumes stay, and what faces sweep at the new level is exact. Each step is
// solved by Newton's method or by multigrid in pseudo-time. Linearization and factors are kept from step to
// step as long as iterations with them converge well. All members but the const ones are collective.
template <int Dim>
class DualTime {
 public:
  // `level` is kept by reference; level.steady and level.solver are the ones used.
  DualTime(FlowLevel<Dim>& level, const DualTimeOptions& options);

  // Levels w^n, w^{n-1}, ... at the constant step, newest first, each with the size of a state. One level
  // starts with steps of lower order; `order` levels, of a periodic solution or of an earlier run, give the
  // full order from the first step, and one more the predictor that goes with it. More are not used.
  void start(std::vector<std::vector<double>> history);

  bool is_open() const { return is_open_; }
  // Between steps: what they go on with, and going on with it after start() with the levels it belongs to.
  DualTimeMemory memory() const;
  void resume(const DualTimeMemory& memory);

  // Opens a step of length dt on the flow's clock: w is extrapolated from the history (eq:extrapolation).
  // The length may change by another start() only.
  void begin(double dt);
  // Brings w of the open step to the tolerance at this motion of the new level, from what w is: it may be
  // called again with a better motion. Where it fails, w is the best state it had.
  DualTimeResult solve(const MotionState& motion) { return solve(motion, options_.tolerance); }
  DualTimeResult solve(const MotionState& motion, double tolerance);
  // Of the open step, or of the last one.
  std::span<const double> w() const { return w_; }
  Loads<double> loads(const MotionState& motion);
  // Closes the step: w becomes the newest level.
  void accept();

  // The levels kept, at most order + 1.
  const std::vector<std::vector<double>>& history() const { return history_; }
  const DualTimeOptions& options() const { return options_; }

 private:
  struct Measure {
    double residual = 0.0;  // |R + Omega dw/dt|
    double scale = 0.0;     // |Omega dw/dt|
  };
  // r = R + Omega dw/dt at `state`; not finite where that is no flow.
  Measure evaluate(std::span<const double> state, const MotionState& motion, std::span<double> r);
  double relative(const Measure& measure, double tolerance) const;
  void set_formula(const BackwardDifference& formula);
  void set_shift(double shift);
  void linearize(const MotionState& motion, DualTimeResult& result);
  void linearize_at(const std::vector<double>& w, const MotionState& motion);
  void factor_at_linearization();
  bool are_factors_old(const GmresResult& linear);
  DualTimeResult solve_by_newton(const MotionState& motion, double tolerance);
  DualTimeResult solve_by_cycles(const MotionState& motion, double tolerance);

  FlowLevel<Dim>& level_;
  FlowEquations<Dim>& flow_;
  DualTimeOptions options_;
  std::unique_ptr<Multigrid<Dim>> multigrid_;  // by cycles only
  std::vector<std::vector<double>> history_;   // newest first
  std::vector<double> w_;
  std::vector<double> source_;  // -(Omega/dt) sum_{k>=1} c_k w^{n+1-k}
  double dt_ = 0.0;             // 0: not settled
  double shift_ = 0.0;          // c_0/dt
  std::vector<double> shifts_;  // shift Omega of every cell
  double round_off_ = 0.0;      // of the residual, in its norm
  bool is_open_ = false;
  // Extrapolation alone, step after step, lets round-off grow: each step has one iteration at least.
  bool is_only_predicted_ = true;
  // What the next iteration of Newton's method begins with.
  bool is_linearization_due_ = true;
  bool are_factors_due_ = true;
  int fewest_iterations_ = 0;  // Krylov iterations of the best solve with the factors
  int excess_iterations_ = 0;  // of all others over that
  MotionState linearized_motion_, factored_motion_;
  std::vector<double> linearized_w_, factored_w_;
  std::vector<double> r_, trial_, trial_r_, dw_;
};

}  // namespace wingbeat
