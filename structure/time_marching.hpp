#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "core/algebra/newton.hpp"
#include "flow/backward_difference.hpp"
#include "structure/structural_equation.hpp"

namespace wingbeat {

// The flow as a structure marching in time sees it: one step of equal length after another. Collective.
class UnsteadyLoads {
 public:
  virtual ~UnsteadyLoads() = default;
  // Opens the next step, of length dtau in 1/omega_alpha.
  virtual void begin(double dtau) = 0;
  // Generalised forces f (m values) at the end of the open step if the states there are y (2m values).
  // May be called several times in a step. A status other than `converged` says that they were not found.
  virtual SolveStatus forces(std::span<const double> y, std::span<double> f) = 0;
  // Closes the step with the flow of the last call.
  virtual void accept() = 0;
};

struct TimeMarchingOptions {
  int order = 2;            // of the backward difference, 1 to 3
  double tolerance = 1e-4;  // on the change of y after the last visit to the flow, over that of the step
  int max_iterations = 30;  // visits to the flow in a step
};

struct TimeStepResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;   // visits to the flow
  double change = 0.0;  // as in the tolerance
};

// What the steps go on with, bit for bit, beside the levels.
struct TimeMarchingMemory {
  std::vector<Eigen::VectorXd> forces;  // of the steps taken, newest first
  Eigen::MatrixXd response;             // J ~ df/dy within a step, m x 2m
};

// One structure in time, y' + A y + (0, M^-1 g(u)) = load (0, M^-1 f), by backward differences, the flow
// and it converged in every step (eq:time-marching). Predicts the forces by their extrapolation, so that
// mostly one visit to the flow does; the instant response df/dy, which matters for light structures, is
// learnt by Broyden's update (eq:instant-response).
class TimeMarching {
 public:
  // dtau: the step in 1/omega_alpha; load = c V^2. `flow` is kept by reference. Throws InputError unless
  // the model is consistent.
  TimeMarching(StructureModel model, double load, double dtau, UnsteadyLoads& flow,
               const TimeMarchingOptions& options);

  // States of 2m values, newest first, dtau apart. Fewer than `order`: first steps of lower order. One more
  // than that is kept for who keeps as many levels of the flow.
  void start(std::vector<std::vector<double>> history);
  const TimeMarchingMemory& memory() const { return memory_; }
  // After start() with the levels it belongs to.
  void resume(TimeMarchingMemory memory) { memory_ = std::move(memory); }
  // On failure y stays at the last good step. Collective.
  TimeStepResult step();

  double dtau() const { return dtau_; }
  std::span<const double> y() const { return history_.front(); }
  const std::vector<std::vector<double>>& history() const { return history_; }

 private:
  // y with (c_0 y + past)/dtau + S(y, f + J (y - about)) = 0, by Newton from `about`. Nothing where that does
  // not converge.
  std::optional<std::vector<double>> implicit_step(const std::vector<double>& past, double c0,
                                                   const Eigen::VectorXd& f,
                                                   const std::vector<double>& about) const;
  void learn_response(const std::vector<double>& dy, const Eigen::VectorXd& df);
  double norm(const std::vector<double>& dy) const;  // of states, by energy

  StructuralEquation structure_;
  double load_;
  double dtau_;
  UnsteadyLoads& flow_;
  TimeMarchingOptions options_;
  Eigen::MatrixXd weight_;  // blkdiag(K, M)
  TimeMarchingMemory memory_;
  std::vector<std::vector<double>> history_;  // newest first, one more than the order
};

}  // namespace wingbeat
