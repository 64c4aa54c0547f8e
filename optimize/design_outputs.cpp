#include "optimize/design_outputs.hpp"

#include <algorithm>

#include "core/io/error.hpp"

namespace wingbeat {

DesignOutputs::DesignOutputs(EvaluationService& service, EvaluationRecord& record,
                             std::vector<DerivedOutput> derived, std::vector<GeometricOutput> geometric)
    : service_(service), record_(record), derived_(std::move(derived)), geometric_(std::move(geometric)) {
  refresh();
}

void DesignOutputs::refresh() {
  record_.expect(service_.analyses(), service_.outputs());
  names_ = service_.outputs();
  parts_.clear();
  for (const DerivedOutput& output : derived_) {
    auto& parts = parts_.emplace_back();
    for (const std::string& name : output.of) parts.push_back(index(name));
  }
  for (const DerivedOutput& output : derived_) names_.push_back(output.name);
  for (const GeometricOutput& output : geometric_) names_.push_back(output.name);
}

std::size_t DesignOutputs::index(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  ensure(found != names_.end(), "no output " + name);
  return static_cast<std::size_t>(found - names_.begin());
}

const Evaluation& DesignOutputs::evaluate(std::span<const double> design) {
  if (!record_.values(design)) record_.add(design, service_.values(design));
  return *record_.values(design);
}

std::optional<std::vector<double>> DesignOutputs::values(std::span<const double> design) {
  const Evaluation& evaluation = evaluate(design);
  why_ = evaluation.message;
  if (!evaluation.is_solved) return std::nullopt;
  std::vector<double> result = evaluation.values;
  for (std::size_t d = 0; d < derived_.size(); ++d) {
    std::vector<double> parts, weights(parts_[d].size());
    for (const std::size_t part : parts_[d]) parts.push_back(evaluation.values[part]);
    result.push_back(derived_[d].combine(parts, weights));
  }
  std::vector<double> unused(design.size());
  for (const GeometricOutput& output : geometric_) result.push_back(output.measure(design, unused));
  return result;
}

std::optional<std::vector<std::vector<double>>> DesignOutputs::gradients(std::span<const double> design) {
  const Evaluation& evaluation = evaluate(design);
  why_ = evaluation.message;
  if (!evaluation.is_solved) return std::nullopt;
  if (!record_.gradients(design)) record_.add(design, service_.gradients(design));
  const GradientEvaluation& found = *record_.gradients(design);
  why_ = found.message;
  if (!found.is_solved) return std::nullopt;
  std::vector<std::vector<double>> result = found.derivatives;
  for (std::size_t d = 0; d < derived_.size(); ++d) {
    std::vector<double> parts, weights(parts_[d].size()), sum(design.size());
    for (const std::size_t part : parts_[d]) parts.push_back(evaluation.values[part]);
    derived_[d].combine(parts, weights);
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += weights[i] * found.derivatives[parts_[d][i]][v];
    result.push_back(std::move(sum));
  }
  for (const GeometricOutput& output : geometric_) {
    std::vector<double> derivatives(design.size());
    output.measure(design, derivatives);
    result.push_back(std::move(derivatives));
  }
  return result;
}

}  // namespace wingbeat
