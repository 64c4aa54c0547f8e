#include "optimize/optimization_program.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

OptimizationProgram::OptimizationProgram(DesignOutputs& outputs, const OptimizationProblem& problem,
                                         std::span<const double> start, const std::string& branched,
                                         std::vector<std::string> branches,
                                         std::function<bool(const DesignIteration&)> observer)
    : outputs_(outputs),
      problem_(problem),
      start_(start.begin(), start.end()),
      observer_(std::move(observer)),
      last_(start_) {
  if (!branches.empty()) {
    branches_.push_back(outputs.index(branched));
    for (const std::string& branch : branches) branches_.push_back(outputs.index(branch));
  }
  for (const Constraint& c : problem.constraints) {
    const std::size_t output = outputs.index(c.output);
    std::vector<std::size_t> alike{output};
    if (!branches_.empty() && output == branches_.front()) alike = branches_;
    for (const std::size_t o : alike)
      rows_.push_back({o, c.lower / c.scale, c.upper / c.scale, c.scale, 0.0});
  }
  if (branches_.empty()) return;
  for (const auto& term : problem.objective)
    if (outputs.index(term.output) == branches_.front()) least_reference_ = term.reference;
  if (has_least())
    for (const std::size_t o : branches_) rows_.push_back({o, 0.0, infinite, least_reference_, 1.0});
}

ProgramBounds OptimizationProgram::bounds() const {
  ProgramBounds bounds;
  const DesignSpace& space = problem_.space;
  for (std::size_t i = 0; i < space.names.size(); ++i) {
    bounds.x_lower.push_back(space.lower[i] / space.scales[i]);
    bounds.x_upper.push_back(space.upper[i] / space.scales[i]);
  }
  if (has_least()) {
    bounds.x_lower.push_back(-infinite);
    bounds.x_upper.push_back(infinite);
  }
  for (const Row& row : rows_) {
    bounds.g_lower.push_back(row.lower);
    bounds.g_upper.push_back(row.upper);
  }
  for (const LinearLimit& limit : space.limits) {
    bounds.g_lower.push_back(limit.lower);
    bounds.g_upper.push_back(infinite);
  }
  return bounds;
}

std::vector<double> OptimizationProgram::start() const {
  std::vector<double> x(start_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= problem_.space.scales[i];
  if (!has_least()) return x;
  std::vector<double> design = start_;
  const auto outputs = outputs_.values(design);
  x.push_back(outputs ? least(*outputs) / least_reference_ : 1.0);
  return x;
}

std::vector<double> OptimizationProgram::design(std::span<const double> x) const {
  std::vector<double> result;
  for (std::size_t i = 0; i < problem_.space.names.size(); ++i)
    result.push_back(x[i] * problem_.space.scales[i]);
  return result;
}

double OptimizationProgram::least(std::span<const double> outputs) const {
  double result = infinite;
  for (const std::size_t o : branches_) result = std::min(result, outputs[o]);
  return result;
}

double OptimizationProgram::scaled_objective(std::span<const double> outputs, double least) const {
  double sum = 0.0;
  for (const auto& term : problem_.objective) {
    const std::size_t o = outputs_.index(term.output);
    const bool is_least = has_least() && o == branches_.front();
    sum += term.weight * (is_least ? least : outputs[o]) / term.reference;
  }
  return problem_.is_maximized ? -sum : sum;
}

double OptimizationProgram::objective(std::span<const double> outputs) const {
  const double sum = scaled_objective(outputs, has_least() ? least(outputs) : 0.0);
  const double stated = problem_.is_maximized ? -sum : sum;
  return problem_.is_single() ? stated * problem_.objective.front().reference : stated;
}

double OptimizationProgram::violation(std::span<const double> outputs) const {
  double worst = 0.0;
  for (const Constraint& c : problem_.constraints)
    worst = std::max(worst, c.violation(outputs[outputs_.index(c.output)]));
  return worst;
}

std::optional<ProgramValues> OptimizationProgram::values(std::span<const double> x) {
  const std::vector<double> at = design(x);
  const auto outputs = outputs_.values(at);
  if (!outputs) return std::nullopt;
  const double t = has_least() ? x.back() : 0.0;
  ProgramValues values{scaled_objective(*outputs, t * least_reference_), {}};
  for (const Row& row : rows_)
    values.constraints.push_back((*outputs)[row.output] / row.scale - row.by_least * t);
  for (const LinearLimit& limit : problem_.space.limits)
    values.constraints.push_back(
        std::inner_product(limit.coefficients.begin(), limit.coefficients.end(), at.begin(), 0.0));
  return values;
}

std::optional<ProgramGradients> OptimizationProgram::gradients(std::span<const double> x) {
  const std::vector<double> at = design(x);
  const auto derivatives = outputs_.gradients(at);
  if (!derivatives) return std::nullopt;
  last_ = at;
  const auto& scales = problem_.space.scales;
  ProgramGradients result{std::vector<double>(size()), {}};
  for (const auto& term : problem_.objective) {
    const double weight = (problem_.is_maximized ? -term.weight : term.weight);
    const std::size_t o = outputs_.index(term.output);
    if (has_least() && o == branches_.front()) {
      result.objective.back() += weight;
      continue;
    }
    for (std::size_t i = 0; i < at.size(); ++i)
      result.objective[i] += weight / term.reference * (*derivatives)[o][i] * scales[i];
  }
  for (const Row& row : rows_) {
    for (std::size_t i = 0; i < at.size(); ++i)
      result.constraints.push_back((*derivatives)[row.output][i] * scales[i] / row.scale);
    if (has_least()) result.constraints.push_back(-row.by_least);
  }
  for (const LinearLimit& limit : problem_.space.limits) {
    for (std::size_t i = 0; i < at.size(); ++i)
      result.constraints.push_back(i < limit.coefficients.size() ? limit.coefficients[i] * scales[i] : 0.0);
    if (has_least()) result.constraints.push_back(0.0);
  }
  return result;
}

bool OptimizationProgram::observe(const ProgramIteration& iteration) {
  DesignIteration where{iteration, last_, {}};
  if (const auto outputs = outputs_.values(last_)) {
    where.outputs = *outputs;
    where.objective = objective(*outputs);
    where.violation = violation(*outputs);
  }
  return observer_(where);
}

}  // namespace wingbeat
