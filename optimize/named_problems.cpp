#include "optimize/named_problems.hpp"

#include <algorithm>

namespace wingbeat {

std::span<const NamedProblem> named_problems() {
  static const std::vector<NamedProblem> problems{
      {"flutter", "maximize flutter_speed", {}},
      {"flutter-drag", "maximize flutter_speed", {"drag <= baseline"}},
      {"flutter-drag-lift", "maximize flutter_speed", {"drag <= baseline", "lift >= baseline"}},
      {"flutter-drag-area", "maximize flutter_speed", {"drag <= baseline", "area >= baseline"}},
      {"flutter-drag-thickness", "maximize flutter_speed", {"drag <= baseline", "thickness >= baseline"}},
      {"flutter-drag-radius",
       "maximize flutter_speed",
       {"drag <= baseline", "leading_edge_radius >= baseline"}},
      {"drag-flutter", "minimize drag", {"flutter_speed >= 1.4 baseline"}},
      {"flutter-supercritical", "maximize flutter_speed", {"drag <= baseline", "onset_slope >= 0"}},
      {"lco-amplitude", "minimize lco_amplitude", {"drag <= baseline"}},
      {"lco-speeds", "maximize least_lco_speed", {"drag <= baseline"}}};
  return problems;
}

std::vector<std::string> problem_names() {
  std::vector<std::string> names;
  for (const NamedProblem& problem : named_problems()) names.push_back(problem.name);
  return names;
}

const NamedProblem* find_problem(std::string_view name) {
  const auto problems = named_problems();
  const auto found = std::ranges::find(problems, name, &NamedProblem::name);
  return found == problems.end() ? nullptr : &*found;
}

}  // namespace wingbeat
