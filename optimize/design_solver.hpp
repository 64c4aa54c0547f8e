#pragma once

#include <functional>
#include <span>
#include <vector>

#include "adjoint/design_variables.hpp"
#include "core/algebra/gmres.hpp"
#include "optimize/output_analysis.hpp"
#include "optimize/warm_starts.hpp"

namespace wingbeat {

struct DesignSolverOptions {
  GmresOptions gmres{};    // of the adjoints
  int max_bisections = 1;  // of the way from the nearest solved design, before a design is given up
};

// How a design was solved.
struct DesignCost {
  int solves = 0;  // designs on the way, tried
  double seconds = 0.0;
};

// One problem at design after design: each starts from the nearest one solved, and is walked up to from there
// in shorter steps where that fails. Collective over the ranks that share the problem.
class DesignSolver {
 public:
  // The analysis is solved at `design`. `variables` and `shape` are kept by reference.
  DesignSolver(const Comm& comm, OutputAnalysis analysis, std::vector<double> design,
               const DesignVariables& variables, const ShapeVariables& shape,
               const DesignSolverOptions& options);

  const std::string& name() const { return analysis_.name; }
  const std::vector<AnalysisOutput>& outputs() const { return analysis_.outputs; }

  // Throws SolveFailure where every way was in vain.
  DesignCost solve(std::span<const double> design);
  // At the design solved last: one number an output.
  std::vector<double> values() const;
  // [output][variable]. Solves the design anew where another was solved since. Throws SolveFailure.
  std::vector<std::vector<double>> gradients(std::span<const double> design);

 private:
  void solve_from(const WarmStarts::Start& start, std::span<const double> design);
  std::vector<double> derivatives();

  const Comm& comm_;
  OutputAnalysis analysis_;
  const DesignVariables& variables_;
  const ShapeVariables& shape_;
  DesignSolverOptions options_;
  WarmStarts starts_;
  std::vector<double> at_;  // design solved last; empty where that failed
};

}  // namespace wingbeat
