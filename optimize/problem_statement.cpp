#include "optimize/problem_statement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/io/error.hpp"
#include "core/io/nearest_name.hpp"
#include "optimize/named_problems.hpp"

namespace wingbeat {
namespace {

constexpr const char* default_objective = "flutter_speed";

// The texts to read: objective and constraints, those of the named problem first.
struct StatementTexts {
  std::string objective;
  std::vector<std::string> named, given;
};

StatementTexts texts_of(const OptimizeSettings& settings) {
  StatementTexts texts{settings.objective.value_or(default_objective), {}, settings.constraints};
  const NamedProblem* problem = settings.problem ? find_problem(*settings.problem) : nullptr;
  if (problem != nullptr) {
    if (!settings.objective) texts.objective = problem->objective;
    texts.named = problem->constraints;
  }
  return texts;
}

std::vector<std::string> problem_faults(const OptimizeSettings& settings) {
  std::vector<std::string> faults;
  if (!settings.problem) return faults;
  if (find_problem(*settings.problem) == nullptr) {
    const auto names = problem_names();
    const std::string nearest = nearest_name(*settings.problem, names);
    faults.push_back(fmt::format(
        "optimize.problem = \"{}\": no such problem; {}problems are {}", *settings.problem,
        nearest.empty() ? "" : fmt::format("the nearest is \"{}\"; ", nearest), fmt::join(names, ", ")));
  }
  if (settings.objective)
    faults.push_back(fmt::format(
        "optimize.problem = \"{}\": has an objective of its own, and optimize.objective = \"{}\" is "
        "given too; leave one of them out",
        *settings.problem, *settings.objective));
  return faults;
}

// Of two requirements that cannot both stand.
std::vector<std::string> pair_faults(const std::vector<Requirement>& requirements, std::size_t named) {
  std::vector<std::string> faults;
  for (std::size_t j = 0; j < requirements.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Requirement &a = requirements[i], &b = requirements[j];
      const bool are_equalities =
          a.relation == Requirement::Relation::equal && b.relation == a.relation && a.output == b.output;
      if (are_alike(a, b))
        faults.push_back(fmt::format("optimize.constraints = \"{}\": repeats \"{}\"{}; leave it out", b.text,
                                     a.text, i < named ? " of optimize.problem" : ""));
      else if (are_equalities)
        faults.push_back(
            fmt::format("optimize.constraints = \"{}\": {} is to equal another bound as well, "
                        "\"{}\"; drop one of them",
                        b.text, b.output, a.text));
    }
  for (const std::string& crossing : bounds_cross(requirements, {}))
    faults.push_back("optimize.constraints: " + crossing);
  return faults;
}

// Reads all texts; `faults` only grows.
ProblemStatement read_statement(const OptimizeSettings& settings, std::vector<std::string>& faults) {
  ProblemStatement statement;
  const StatementTexts texts = texts_of(settings);
  auto objective = read_objective(texts.objective);
  for (const std::string& fault : objective.faults)
    faults.push_back(fmt::format("optimize.objective = \"{}\": {}", texts.objective, fault));
  statement.objective = std::move(objective.value);
  for (const auto* list : {&texts.named, &texts.given})
    for (const std::string& text : *list) {
      auto requirement = read_requirement(text);
      for (const std::string& fault : requirement.faults)
        faults.push_back(fmt::format("optimize.constraints = \"{}\": {}", text, fault));
      if (requirement.faults.empty()) statement.requirements.push_back(std::move(requirement.value));
    }
  for (std::string& fault : pair_faults(statement.requirements, texts.named.size()))
    faults.push_back(std::move(fault));
  return statement;
}

}  // namespace

std::vector<std::string> ProblemStatement::outputs() const {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const ObjectiveTerm& term : objective.terms) add(term.output);
  for (const Requirement& requirement : requirements) add(requirement.output);
  return names;
}

std::vector<std::string> statement_faults(const OptimizeSettings& settings) {
  std::vector<std::string> faults = problem_faults(settings);
  read_statement(settings, faults);
  if (settings.variables.empty())
    faults.push_back("optimize.variables = []: nothing to vary; name \"bumps\", \"angle_of_attack\" or both");
  return faults;
}

ProblemStatement problem_statement(const OptimizeSettings& settings) {
  std::vector<std::string> faults = problem_faults(settings);
  ProblemStatement statement = read_statement(settings, faults);
  if (!faults.empty()) throw InputError(fmt::format("{}", fmt::join(faults, "\n")));
  return statement;
}

}  // namespace wingbeat
