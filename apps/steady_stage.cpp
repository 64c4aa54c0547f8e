#include "apps/steady_stage.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "apps/advice.hpp"
#include "apps/breakdown.hpp"
#include "apps/flow_cycles.hpp"
#include "apps/flow_setup.hpp"
#include "apps/neighbour.hpp"
#include "apps/solution_output.hpp"
#include "core/io/progress.hpp"

namespace wingbeat {
namespace {

struct SteadyCost {
  int iterations = 0;
  int linear_iterations = 0;
  int factorizations = 0;
  int cycles = 0;
};
struct SteadyOutcome {
  SolveStatus status = SolveStatus::converged;
  double residual = 1.0;
  SteadyCost cost;
  std::optional<SolverMemory> memory{};  // of cycles that have not ended
};

AeroelasticState steady_state(std::vector<double> w) {
  return {std::move(w), std::vector<double>(4, 0.0), 0.0, 1.0};
}

// Newton from mesh to mesh. `is_kept`: the last of them is the case's own, worth checkpoints.
SteadyOutcome solve_by_newton(Context& context, FlowLevelRange<2> levels, const MotionState& motion,
                              History& history, bool is_kept) {
  const auto part = context.timer.measure("steady");
  const PseudoTransientOptions options = steady_options(context.settings.solver);
  std::unique_ptr<Progress> progress;
  std::size_t shown = levels.size();
  const PseudoTransientResult result =
      solve_steady<2>(levels, motion, options, [&](std::size_t level, const PseudoTransientIteration& i) {
        const std::string mesh = mesh_size_text<2>(levels[level]->mesh);
        if (level != shown) {
          progress.reset();
          progress =
              std::make_unique<Progress>(context.log, "steady flow, " + mesh,
                                         std::vector<std::string>{"iter", "|R|", "CFL", "step", "linear"});
          shown = level;
        }
        history.steady(mesh, i);
        progress->row(
            {fmt::format("{}", i.iteration), fmt::format("{:.2e}", i.residual), fmt::format("{:.1e}", i.cfl),
             fmt::format("{:.2f}", i.step), fmt::format("{}", i.linear_iterations)},
            converged_fraction(1.0, i.residual, options.tolerance));
        if (level + 1 < levels.size() || !is_kept || context.checkpoints.is_ahead())
          return !context.stop.is_set();
        return context.checkpoints.goes_on(
            [&] { write_checkpoint(context, *levels[level], steady_state(levels[level]->w)); });
      });
  if (result.status == SolveStatus::diverged) {
    const FlowLevel<2>& finest = *levels[levels.size() - 1];
    note_breakdown(context, finest, finest.w);
  }
  return {result.status,
          result.residual,
          {result.iterations, result.linear_iterations, result.factorizations, 0}};
}

// Cycles on the finest mesh alone, from the solution of the next coarser one where there is one.
SteadyOutcome solve_by_cycles(Context& context, FlowLevels<2>& levels, const MotionState& motion,
                              History& history) {
  const auto part = context.timer.measure("steady");
  FlowLevel<2>& level = *levels.back();
  const SolverSettings& solver = context.settings.solver;
  FlowCycles cycles(context, level, level.steady);
  const std::vector<MotionState> motions{motion};
  if (level.w.empty()) {
    const bool has_coarse = levels.size() > 1 && !levels[levels.size() - 2]->w.empty();
    const auto& coarse = levels[levels.size() - (has_coarse ? 2 : 1)];
    level.w = has_coarse ? transferred_state<2>(*coarse, coarse->w, level) : cycles.start(motions, 0.0);
  }
  const double tolerance = solver.ends_with_newton() ? std::max(solver.newton_switch, solver.steady_target())
                                                     : solver.steady_target();
  const std::string stage = "steady flow";
  PseudoTimeResult result =
      cycles.solve(level.w, motions, 0.0, tolerance, stage, history,
                   [&](std::vector<double> w, const std::optional<SolverMemory>& memory) {
                     if (!context.checkpoints.is_ahead())
                       write_checkpoint(context, level, steady_state(std::move(w)), memory);
                   });
  context.result.message = cycles_advice(result.status, tolerance, context.settings.pseudo_time);
  return {result.status, result.residual, {0, 0, 0, result.cycles}, memory_of(stage, result)};
}

void report_steady(Context& context, FlowLevel<2>& level, const MotionState& motion,
                   const SteadyOutcome& solved) {
  const Loads<double> loads = level.steady.loads(level.w, std::span<const MotionState>(&motion, 1))[0];
  const Coefficients c = coefficients(context.settings, loads, motion.pitch);
  context.result.findings["steady"] = {{"cl", c.cl},
                                       {"cd", c.cd},
                                       {"cm", c.cm},
                                       {"residual", solved.residual},
                                       {"iterations", solved.cost.iterations},
                                       {"linear_iterations", solved.cost.linear_iterations},
                                       {"factorizations", solved.cost.factorizations},
                                       {"cycles", solved.cost.cycles}};
  context.log.line("\ncl = {:.8f}   cd = {:.8f}   cm = {:.8f}   residual {:.1e}", c.cl, c.cd, c.cm,
                   solved.residual);
}

}  // namespace

MotionState at_rest(const CaseSettings& settings) {
  return {section_kinematics(settings).mean_pitch, 0.0, 0.0};
}

SolveStatus run_steady_stage(Context& context, FlowLevels<2>& levels, History& history,
                             bool needs_coarse_levels) {
  FlowLevel<2>& level = *levels.back();
  const SolverSettings& solver = context.settings.solver;
  const MotionState motion = at_rest(context.settings);
  const FlowLevelRange<2> all(levels);
  SteadyOutcome solved;
  if (context.neighbour && level.w.empty()) level.w = neighbouring_flow(context, level);
  if (solver.flow_solver() == "newton") {
    solved = solve_by_newton(context, all, motion, history, true);
    context.result.message = steady_advice(solved.status, solver);
  } else {
    if (needs_coarse_levels && levels.size() > 1) {
      const auto coarse = solve_by_newton(context, all.first(levels.size() - 1), motion, history, false);
      if (coarse.status == SolveStatus::interrupted && level.w.empty()) throw stopped_too_early();
    }
    solved = solve_by_cycles(context, levels, motion, history);
    if (solved.status == SolveStatus::converged && solver.ends_with_newton()) {
      const int cycles = solved.cost.cycles;
      solved = solve_by_newton(context, all.last(1), motion, history, true);
      solved.cost.cycles = cycles;
      context.result.message = steady_advice(solved.status, solver);
    }
  }
  history.write();
  if (level.w.empty()) return solved.status;
  if (solved.status == SolveStatus::interrupted)
    context.result.message = "stopped by a signal or --walltime; continue with --restart and this folder";
  const auto part = context.timer.measure("output");
  if (!context.checkpoints.is_ahead())
    write_solution_files(context, level, steady_state(level.w), solved.memory);
  report_steady(context, level, motion, solved);
  return solved.status;
}

}  // namespace wingbeat
