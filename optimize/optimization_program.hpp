#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "optimize/design_outputs.hpp"
#include "optimize/nonlinear_program.hpp"
#include "optimize/optimization_problem.hpp"

namespace wingbeat {

// Where the optimisation stands, in physical numbers.
struct DesignIteration {
  ProgramIteration program;
  std::vector<double> design;
  std::vector<double> outputs;  // in the order of DesignOutputs::names
  double objective = 0.0;       // as stated
  double violation = 0.0;       // the largest of the constraints, over its scale
};

// An optimisation problem as the optimiser sees it (eq:optimization): variables, objective and constraints
// over their scales, the objective to be minimised. Where an output has further branches - other flutter
// roots - that come near, the least of them is not differentiable: it is then a variable t of its own, with
// V_j >= t for every branch (eq:epigraph).
class OptimizationProgram final : public NonlinearProgram {
 public:
  // `branches`: further outputs that stand beside `branched`, each asked of wherever that is. `observer`:
  // after every iteration; false ends. Outputs and problem are kept by reference.
  OptimizationProgram(DesignOutputs& outputs, const OptimizationProblem& problem,
                      std::span<const double> start, const std::string& branched,
                      std::vector<std::string> branches,
                      std::function<bool(const DesignIteration&)> observer);

  ProgramBounds bounds() const override;
  std::vector<double> start() const override;
  std::optional<ProgramValues> values(std::span<const double> x) override;
  std::optional<ProgramGradients> gradients(std::span<const double> x) override;
  bool observe(const ProgramIteration& iteration) override;

  // Of the optimiser's x.
  std::vector<double> design(std::span<const double> x) const;
  // The objective as stated, of all outputs: of an output with branches the least counts.
  double objective(std::span<const double> outputs) const;
  double violation(std::span<const double> outputs) const;

 private:
  struct Row {  // lower <= (output - by_least t)/scale <= upper
    std::size_t output;
    double lower, upper, scale;
    double by_least;
  };
  bool has_least() const { return least_reference_ > 0.0; }
  std::size_t size() const { return problem_.space.names.size() + (has_least() ? 1 : 0); }
  double least(std::span<const double> outputs) const;
  double scaled_objective(std::span<const double> outputs, double least) const;

  DesignOutputs& outputs_;
  const OptimizationProblem& problem_;
  std::vector<double> start_;
  std::vector<std::size_t> branches_;  // outputs that are branches of one, itself first
  std::function<bool(const DesignIteration&)> observer_;
  std::vector<Row> rows_;
  double least_reference_ = 0.0;  // scale of t; 0: there is none
  std::vector<double> last_;      // design of the last iteration
};

}  // namespace wingbeat
