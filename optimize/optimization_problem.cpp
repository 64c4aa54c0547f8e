#include "optimize/optimization_problem.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

double size_or_one(double value) { return value != 0.0 ? std::abs(value) : 1.0; }

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
  std::map<std::string, double> baselines;
  for (const Requirement& requirement : statement.requirements) {
    const double value = baselines[requirement.output] = value_of(requirement.output);
    const Interval allowed = interval(requirement, value);
    problem.constraints.push_back({requirement.text, requirement.output, allowed.lower, allowed.upper,
                                   violation_scale(requirement, value)});
  }
  if (const auto crossing = bounds_cross(statement.requirements, baselines); !crossing.empty())
    throw InputError("optimize.constraints cross: " + crossing.front());
  problem.space = std::move(space);
  return problem;
}

}  // namespace wingbeat
