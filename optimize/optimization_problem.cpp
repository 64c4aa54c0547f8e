#include "optimize/optimization_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

double size_or_one(double value) { return value != 0.0 ? std::abs(value) : 1.0; }

// The first pair of constraints of one output that nothing can meet.
void refuse_crossing(const std::vector<Constraint>& constraints) {
  for (const Constraint& a : constraints)
    for (const Constraint& b : constraints)
      if (a.output == b.output && a.lower > b.upper)
        throw InputError(
            fmt::format("optimize.constraints: \"{}\" and \"{}\" cross: {} is to be at least {:.8g} and at "
                        "most {:.8g} (its "
                        "baseline is {:.8g}); loosen one of the two",
                        a.text, b.text, a.output, a.lower, b.upper, a.baseline));
}

}  // namespace

double Constraint::violation(double value) const {
  return std::max({lower - value, value - upper, 0.0}) / scale;
}

OptimizationProblem make_problem(const ProblemStatement& statement, const std::vector<std::string>& names,
                                 std::span<const double> baseline, DesignSpace space) {
  const auto value_of = [&](const std::string& output) {
    const auto found = std::ranges::find(names, output);
    ensure(found != names.end(), "no output " + output);
    return baseline[static_cast<std::size_t>(found - names.begin())];
  };
  OptimizationProblem problem;
  problem.is_maximized = statement.objective.is_maximized;
  for (const ObjectiveTerm& term : statement.objective.terms)
    problem.objective.push_back({term.output, term.weight, size_or_one(value_of(term.output))});
  for (const Requirement& requirement : statement.requirements) {
    const double value = value_of(requirement.output);
    const Interval allowed = interval(requirement, value);
    problem.constraints.push_back({requirement.text, requirement.output, allowed.lower, allowed.upper,
                                   violation_scale(requirement, value), value});
  }
  refuse_crossing(problem.constraints);
  problem.space = std::move(space);
  return problem;
}

}  // namespace wingbeat
