#pragma once

#include <string>
#include <vector>

#include "optimize/objective_statement.hpp"
#include "optimize/optimize_settings.hpp"
#include "optimize/requirement.hpp"

namespace wingbeat {

struct ProblemStatement {
  ObjectiveStatement objective;
  std::vector<Requirement> requirements;  // of the named problem first

  // Each once, those of the objective first.
  std::vector<std::string> outputs() const;
};

// Sentences "optimize.constraints = "...": ...", one for every fault of the texts of the section that shows
// before anything is solved.
std::vector<std::string> statement_faults(const OptimizeSettings& settings);

// Throws InputError with all faults, a line each, where there are any.
ProblemStatement problem_statement(const OptimizeSettings& settings);

}  // namespace wingbeat
