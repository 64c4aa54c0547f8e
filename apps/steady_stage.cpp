#include "apps/steady_stage.hpp"

#include <memory>

#include "apps/advice.hpp"
#include "apps/flow_setup.hpp"
#include "apps/solution_output.hpp"
#include "core/io/progress.hpp"

namespace wingbeat {
namespace {

PseudoTransientResult solve_with_progress(Context& context, FlowLevels<2>& levels, const MotionState& motion,
                                          History& history) {
  const auto part = context.timer.measure("steady");
  const PseudoTransientOptions options = steady_options(context.settings.solver);
  std::unique_ptr<Progress> progress;
  std::size_t shown = levels.size();
  PseudoTransientResult result =
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
        return !context.stop.is_set();
      });
  return result;
}

void report_steady(Context& context, FlowLevel<2>& level, const MotionState& motion,
                   const PseudoTransientResult& solved) {
  const Loads<double> loads = level.steady.loads(level.w, std::span<const MotionState>(&motion, 1))[0];
  const Coefficients c = coefficients(context.settings, loads, motion.pitch);
  context.result.findings["steady"] = {{"cl", c.cl},
                                       {"cd", c.cd},
                                       {"cm", c.cm},
                                       {"residual", solved.residual},
                                       {"iterations", solved.iterations},
                                       {"linear_iterations", solved.linear_iterations},
                                       {"factorizations", solved.factorizations}};
  context.log.line("\ncl = {:.8f}   cd = {:.8f}   cm = {:.8f}   residual {:.1e}", c.cl, c.cd, c.cm,
                   solved.residual);
}

}  // namespace

MotionState at_rest(const CaseSettings& settings) {
  return {section_kinematics(settings).mean_pitch, 0.0, 0.0};
}

SolveStatus run_steady_stage(Context& context, FlowLevels<2>& levels, History& history) {
  FlowLevel<2>& level = *levels.back();
  const MotionState motion = at_rest(context.settings);
  const PseudoTransientResult solved = solve_with_progress(context, levels, motion, history);
  history.write();
  context.result.message = steady_advice(solved.status, context.settings.solver);
  if (level.w.empty()) return solved.status;
  if (solved.status == SolveStatus::interrupted)
    context.result.message = "stopped by a signal or --walltime; continue with --restart solution.cgns";
  const auto part = context.timer.measure("output");
  write_solution_files(context, level, {level.w, std::vector<double>(4, 0.0), 0.0, 1.0});
  report_steady(context, level, motion, solved);
  return solved.status;
}

}  // namespace wingbeat
