#pragma once

#include <string>
#include <vector>

#include "adjoint/shape_variables.hpp"
#include "apps/context.hpp"
#include "flow/steady_sequence.hpp"
#include "optimize/design_outputs.hpp"
#include "optimize/output_analysis.hpp"

namespace wingbeat {

// Which problem some outputs are numbers of.
struct AnalysisPlan {
  enum class Kind { steady, flutter, cycle_of_energy, cycle_at_speed, onset };
  Kind kind;
  double energy = 0.0;  // of a cycle of given energy
  std::vector<std::string> outputs;
};

// The problems behind the outputs that a case's optimisation names, the most laborious first.
std::vector<AnalysisPlan> plan_analyses(const CaseSettings& settings,
                                        const std::vector<std::string>& outputs);

// Those solved at the case's own parameters, by the stages of steady, flutter and lco; where `status` tells
// of a failure, so does the result's message. The levels and the shape outlive them. Collective.
struct BaselineAnalyses {
  SolveStatus status = SolveStatus::converged;
  std::vector<OutputAnalysis> analyses;
};
BaselineAnalyses solve_baseline(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                                const std::vector<AnalysisPlan>& plans);

// Outputs that are made of others, and those of the shape alone, among the outputs named.
std::vector<DerivedOutput> derived_outputs(const CaseSettings& settings,
                                           const std::vector<std::string>& outputs);
std::vector<GeometricOutput> geometric_outputs(const ShapeVariables& shape,
                                               const std::vector<std::string>& outputs);

}  // namespace wingbeat
