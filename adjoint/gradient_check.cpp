#include "adjoint/gradient_check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "core/algebra/krylov_kernels.hpp"

namespace wingbeat {
namespace {

// Numbers in [-1, 1], the same in every run.
std::vector<double> random_numbers(std::size_t count, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::vector<double> numbers(count);
  for (double& value : numbers) value = std::uniform_real_distribution<double>(-1.0, 1.0)(generator);
  return numbers;
}

// The objective at other values of the variables.
class Values {
 public:
  Values(Objective<2>& objective, const DesignVariables& variables, const std::function<void()>& on_solution)
      : objective_(objective), variables_(variables), on_solution_(on_solution) {}

  double at(const std::vector<double>& direction, double step) {
    std::vector<double> x = direction;
    for (double& value : x) value *= step;
    objective_.solve(variables_.change(x));
    if (on_solution_) on_solution_();
    return objective_.value();
  }
  double central(const std::vector<double>& direction, double step) {
    const double above = at(direction, step);
    return (above - at(direction, -step)) / (2.0 * step);
  }
  // Nothing where a changed problem has no solution.
  std::optional<double> try_central(const std::vector<double>& direction, double step) {
    try {
      return central(direction, step);
    } catch (const SolveFailure& failure) {
      if (failure.status() == SolveStatus::interrupted) throw;
      return std::nullopt;
    }
  }

 private:
  Objective<2>& objective_;
  const DesignVariables& variables_;
  const std::function<void()>& on_solution_;
};

// What counts as a derivative beside the objective itself, over a variable's scale: less is round-off's.
double least_derivative(double value) { return 1e-3 * std::abs(value) + 1e-9; }

// |differences - gradient| over the greatest derivative of its kind, the worst.
double worst_departure(const DesignVariables& variables, std::span<const double> gradient,
                       std::span<const double> differences, double least) {
  double worst = 0.0;
  for (const bool is_bump : {true, false}) {
    double size = least, departure = 0.0;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if ((i < variables.bump_count()) != is_bump) continue;
      size = std::max(size, std::abs(gradient[i]) * variables.scale(i));
      departure = std::max(departure, std::abs(differences[i] - gradient[i]) * variables.scale(i));
    }
    worst = std::max(worst, departure / size);
  }
  return worst;
}

}  // namespace

double transpose_defect(const Comm& comm, const LinearOperator<double>& op) {
  const std::size_t size = op.local_size();
  const auto seed = static_cast<unsigned>(2 * comm.rank());
  const std::vector<double> x = random_numbers(size, 11 + seed), v = random_numbers(size, 12 + seed);
  std::vector<double> ax(size), atv(size);
  op.apply(x, ax);
  op.apply_transpose(v, atv);
  const double defect = comm.sum(local_dot(v, ax)) - comm.sum(local_dot(atv, x));
  return std::abs(defect) / (global_norm<double>(comm, v) * global_norm<double>(comm, ax));
}

GradientCheck check_gradient(const Comm& comm, Objective<2>& objective, const DesignVariables& variables,
                             const ShapeVariables& shape, const std::vector<double>& gradient,
                             const GradientCheckOptions& options, const std::function<void()>& on_solution) {
  GradientCheck check;
  for (const auto& term : objective.terms)
    check.transpose =
        std::max(check.transpose, transpose_defect(comm, term.analysis->functional().problem().jacobian()));

  std::vector<double> direction = random_numbers(variables.size(), 1);
  for (std::size_t i = 0; i < variables.size(); ++i) direction[i] *= variables.scale(i);
  const auto exact = weighted_sum(term_derivatives(objective, solve_adjoints(objective, options.gmres)),
                                  objective.weights());
  const double by_adjoint =
      local_dot(variables.derivatives(shape.wall_sensitivity(comm, exact.nodes), exact), direction);
  const double by_tangent = objective_derivative(objective, variables.change(direction), options.gmres).value;
  const double least = least_derivative(objective.value());
  const double size = std::max(std::abs(by_tangent), least);
  check.tangent = std::abs(by_adjoint - by_tangent) / size;

  Values values(objective, variables, on_solution);
  check.finite_difference = std::numeric_limits<double>::infinity();
  for (double step = 0.1; step > 1e-4; step *= 0.2) {
    const auto difference = values.try_central(direction, step);
    if (!difference) continue;  // a long step may lead where there is no solution
    const double error = std::abs(*difference - by_adjoint) / size;
    check.steps.push_back({step, *difference, error});
    check.finite_difference = std::min(check.finite_difference, error);
  }
  if (variables.size() <= static_cast<std::size_t>(options.max_differences)) {
    const auto begun = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < variables.size(); ++i) {
      std::vector<double> one(variables.size(), 0.0);
      one[i] = 1.0;
      check.differences.push_back(values.central(one, options.difference_step * variables.scale(i)));
    }
    check.difference_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    check.finite_difference = worst_departure(variables, gradient, check.differences, least);
  }
  values.at(direction, 0.0);
  return check;
}

}  // namespace wingbeat
