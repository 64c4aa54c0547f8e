#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wingbeat {

// An objective with its constraints under one name.
struct NamedProblem {
  std::string name;
  std::string objective;
  std::vector<std::string> constraints;
};

std::span<const NamedProblem> named_problems();
std::vector<std::string> problem_names();
// Null where there is none of that name.
const NamedProblem* find_problem(std::string_view name);

}  // namespace wingbeat
