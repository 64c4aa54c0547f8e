#include "apps/load_primal.hpp"

#include <algorithm>

#include "apps/analysis_setup.hpp"
#include "apps/flow_setup.hpp"
#include "apps/pitch_stage.hpp"
#include "apps/restart.hpp"
#include "apps/steady_stage.hpp"

namespace wingbeat {
namespace {

constexpr double round_off = 2e-12;  // with --check

FlowAnalysisOptions load_options(const Context& context, std::vector<WeightedLoad> objective,
                                 double tolerance) {
  const CaseSettings& settings = context.settings;
  FlowAnalysisOptions options;
  options.objective = std::move(objective);
  if (const auto& reference = settings.flow.moment_reference)
    options.moment_reference = Vec<double, 2>{{{(*reference)[0], (*reference)[1]}}};
  options.tolerance = primal_tolerance(context, tolerance, round_off);
  options.slack = std::max(1.0, tolerance / options.tolerance);
  options.newton = near_options(settings.solver);
  return options;
}

std::unique_ptr<FlowAnalysis<2>> solved(std::unique_ptr<FlowAnalysis<2>> analysis,
                                        const ShapeVariables& shape) {
  analysis->solve(no_change(shape.nodes()));
  analysis->keep();
  return analysis;
}

}  // namespace

LoadPrimal steady_primal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                         History& history, std::vector<WeightedLoad> objective) {
  FlowLevel<2>& level = *levels.back();
  if (context.restart) level.w = read_restart(context, level, {1}).w;
  const SolveStatus status = run_steady_stage(context, levels, history);
  if (status != SolveStatus::converged) return {status, nullptr};
  ForcedMotion rest;
  rest.mean_pitch = at_rest(context.settings).pitch;
  return {status,
          solved(std::make_unique<FlowAnalysis<2>>(
                     domain_base(context, level, shape), TimeSpectral(0), rest, 0.0, level.w,
                     HarmonicFactors{level.solver, {}},
                     load_options(context, std::move(objective), context.settings.solver.steady_target())),
                 shape)};
}

LoadPrimal forced_primal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                         History& history, std::vector<WeightedLoad> objective) {
  const CaseSettings& settings = context.settings;
  FlowLevel<2>& level = *levels.back();
  ForcedFlowStage stage = run_pitch_stage(context, levels, history, false);
  if (stage.status != SolveStatus::converged) return {stage.status, nullptr};
  const TimeSpectral time(settings.time.harmonics);
  if (!stage.flow.factors.mean)
    stage.flow.factors = unfactored(level.comm(), level.subdomain, state_size<2>, time.harmonics());
  return {
      stage.status,
      solved(std::make_unique<FlowAnalysis<2>>(
                 domain_base(context, level, shape), time, forced_motion(settings.pitch),
                 *settings.pitch.reduced_frequency, std::move(stage.flow.w), std::move(stage.flow.factors),
                 load_options(context, std::move(objective), settings.solver.flow_tolerance)),
             shape)};
}

}  // namespace wingbeat
