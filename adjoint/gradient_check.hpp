#pragma once

#include <functional>
#include <vector>

#include "adjoint/design_variables.hpp"
#include "adjoint/objective.hpp"

namespace wingbeat {

struct DifferenceStep {
  double step = 0.0;  // of the direction, whose entries are the variables' scales times numbers in [-1, 1]
  double difference = 0.0;
  double relative_error = 0.0;  // of the adjoint's derivative along it
};
// How far a gradient agrees with the transpose, a tangent solve and differences of whole solutions.
struct GradientCheck {
  double transpose = 0.0;             // |<v, J x> - <J^T v, x>| over |v| |J x|, the worst of the problems
  double tangent = 0.0;               // relative difference of adjoint and tangent along a random direction
  std::vector<DifferenceStep> steps;  // those that lead to solutions
  // Central differences one by one, [variable], where asked for; and the greatest departure of the gradient
  // from them, over the greatest derivative of its kind (bumps, or single numbers, times their scales), or
  // over a thousandth of the objective where that is more. Where they are not asked for, the least error of
  // the steps.
  std::vector<double> differences;
  double finite_difference = 0.0;
  double difference_seconds = 0.0;  // wall time of `differences`
};

struct GradientCheckOptions {
  double difference_step = 5e-4;  // over the scale of a variable
  int max_differences = 32;
  GmresOptions gmres{};  // of adjoint and tangent, as far as round-off allows
};

// `gradient`: with respect to the variables, at the base, where the objective is solved and is left.
// `on_solution` is called after every changed problem. Collective; throws SolveFailure where one cannot be
// solved.
GradientCheck check_gradient(const Comm& comm, Objective<2>& objective, const DesignVariables& variables,
                             const ShapeVariables& shape, const std::vector<double>& gradient,
                             const GradientCheckOptions& options,
                             const std::function<void()>& on_solution = {});

// <v, J x> against <J^T v, x>, relative to |v| |J x|. Collective.
double transpose_defect(const Comm& comm, const LinearOperator<double>& op);

}  // namespace wingbeat
