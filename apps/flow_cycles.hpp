#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "apps/history.hpp"
#include "flow/flow_level.hpp"
#include "flow/pseudo_time.hpp"

namespace wingbeat {

// Runge-Kutta multigrid cycles of a case's flow on one mesh. All methods are collective.
class FlowCycles {
 public:
  // `flow` lives on the mesh of `level`; both are kept by reference. Throws InputError where
  // pseudo_time.levels asks for more meshes than every block gives.
  FlowCycles(Context& context, const FlowLevel<2>& level, FlowEquations<2>& flow);

  Multigrid<2>& multigrid() { return multigrid_; }
  RungeKuttaOptions step() const { return options_.multigrid.runge_kutta; }

  // All instances by full multigrid from uniform flow, or just that, as the case says. Throws SolveFailure
  // where the run is to end on a coarser mesh: there is nothing yet that is worth going on from.
  std::vector<double> start(const std::vector<MotionState>& motions, double kappa);
  // Writes a checkpoint of all instances.
  using Save = std::function<void(std::vector<double> w, const std::optional<SolverMemory>& memory)>;
  // Cycles with progress and history under the name of the stage until the residual is `tolerance`,
  // relative to uniform flow. Goes on where an earlier run left that stage.
  PseudoTimeResult solve(std::vector<double>& w, const std::vector<MotionState>& motions, double kappa,
                         double tolerance, const std::string& stage, History& history, const Save& save);

 private:
  Context& context_;
  const FlowLevel<2>& level_;
  FlowEquations<2>& flow_;
  PseudoTimeOptions options_;
  Multigrid<2> multigrid_;
};

// Of a run that is to end before the finest mesh is reached.
SolveFailure stopped_too_early();

// What a stage goes on with where its cycles were stopped or met their limit.
std::optional<SolverMemory> memory_of(const std::string& stage, PseudoTimeResult& result);

// Why cycles ended as they did and what to change; empty where they converged.
std::string cycles_advice(SolveStatus status, double tolerance, const PseudoTimeSettings& settings);

}  // namespace wingbeat
