#pragma once

#include <string>
#include <vector>

#include "optimize/statement_words.hpp"

namespace wingbeat {

struct ObjectiveTerm {
  std::string output;
  double weight = 1.0;
};

// What is optimised: one output, or a sum of several, each relative to its value for the undeformed shape.
struct ObjectiveStatement {
  bool is_maximized = true;
  std::vector<ObjectiveTerm> terms{};
  std::string text{};
};

// Reads "OUTPUT", optimised in its natural sense, or "maximize SUM" or "minimize SUM", where SUM is of terms
// "OUTPUT", "NUMBER OUTPUT" or "NUMBER * OUTPUT" with + or - between them.
Reading<ObjectiveStatement> read_objective(const std::string& text);

}  // namespace wingbeat
