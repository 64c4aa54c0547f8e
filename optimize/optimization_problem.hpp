#pragma once

#include <span>
#include <string>
#include <vector>

#include "optimize/problem_statement.hpp"
#include "optimize/wall_limits.hpp"

namespace wingbeat {

// The variables of a design: a box, linear limits within it, and what counts as a large change of each.
struct DesignSpace {
  std::vector<std::string> names;
  std::vector<double> lower, upper, scales;
  std::vector<double> start;  // within the box
  std::vector<LinearLimit> limits;
};

// lower <= output <= upper.
struct Constraint {
  std::string text;  // as stated
  std::string output;
  double lower, upper;
  double scale;  // of a violation that is neither small nor large

  // Over the scale; 0 where it is met.
  double violation(double value) const;
};

// A problem with its numbers: statements that speak of the baseline are resolved.
struct OptimizationProblem {
  struct Term {
    std::string output;
    double weight;
    double reference;  // what the output is divided by
  };
  std::vector<Term> objective;
  bool is_maximized = true;
  std::vector<Constraint> constraints;
  DesignSpace space;

  // The objective as stated: the output itself where it is one term, a sum of ratios to the baseline
  // otherwise.
  bool is_single() const { return objective.size() == 1; }
};

// `names` and `baseline`: all outputs, and their values for the undeformed section. Throws InputError where
// constraints cross, with their values.
OptimizationProblem make_problem(const ProblemStatement& statement, const std::vector<std::string>& names,
                                 std::span<const double> baseline, DesignSpace space);

}  // namespace wingbeat
