#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adjoint/analysis.hpp"

namespace wingbeat {

// One number of a solved problem; `choose` makes it the analysis' functional.
struct AnalysisOutput {
  std::string name;
  std::function<void()> choose;
};

// A problem over all parameters and the numbers wanted of its solution: one primal for all of them, one
// adjoint each. It is solved at no change of the parameters.
struct OutputAnalysis {
  std::string name;
  std::unique_ptr<Analysis<2>> analysis;
  std::vector<AnalysisOutput> outputs;
};

}  // namespace wingbeat
