#pragma once

#include <optional>
#include <span>
#include <vector>

namespace wingbeat {

// min f(x) with x_lower <= x <= x_upper and g_lower <= g(x) <= g_upper; an infinite bound is none. Numbers
// are scaled to order one.
struct ProgramBounds {
  std::vector<double> x_lower, x_upper;
  std::vector<double> g_lower, g_upper;
};

struct ProgramValues {
  double objective = 0.0;
  std::vector<double> constraints;
};

struct ProgramGradients {
  std::vector<double> objective;    // [variable]
  std::vector<double> constraints;  // [constraint][variable]
};

// Where an optimiser stands after an iteration, in the scaled numbers.
struct ProgramIteration {
  int iteration = 0;
  double objective = 0.0;
  double infeasibility = 0.0;  // largest violation of a constraint
  double kkt_error = 0.0;      // of the optimality conditions, as the optimiser tests it
  double barrier = 0.0;
  double step = 0.0;          // largest change of a variable
  int trials = 0;             // of the line search
  bool is_restoring = false;  // of feasibility, the objective aside
};

// A smooth nonlinear programme as an optimiser sees it. What values, gradients or observe throw ends the
// optimisation and reaches its caller.
class NonlinearProgram {
 public:
  virtual ~NonlinearProgram() = default;
  virtual ProgramBounds bounds() const = 0;
  virtual std::vector<double> start() const = 0;
  // Nothing where the point cannot be evaluated: the optimiser then shortens its step.
  virtual std::optional<ProgramValues> values(std::span<const double> x) = 0;
  virtual std::optional<ProgramGradients> gradients(std::span<const double> x) = 0;
  // After every iteration; false ends the optimisation.
  virtual bool observe(const ProgramIteration& iteration) = 0;
};

}  // namespace wingbeat
