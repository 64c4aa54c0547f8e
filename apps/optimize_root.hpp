#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "apps/flutter_branches.hpp"
#include "optimize/design_outputs.hpp"
#include "optimize/optimization_problem.hpp"

namespace wingbeat {

// How an optimisation ended.
struct OptimizationOutcome {
  SolveStatus status = SolveStatus::stalled;
  std::string message;
  std::vector<double> design;       // empty where none was solved
  nlohmann::ordered_json findings;  // result.json's "optimization"
};

// Optimises, with a line of progress, of optimization.csv and of the record an iteration. On rank 0, while
// the others serve.
OptimizationOutcome optimize_on_root(Context& context, const ProblemStatement& statement,
                                     DesignOutputs& outputs, EvaluationRecord& record,
                                     const RootService& roots, DesignSpace space);

}  // namespace wingbeat
