#include "apps/pitch_stage.hpp"

#include <algorithm>
#include <cmath>

#include "apps/advice.hpp"
#include "apps/breakdown.hpp"
#include "apps/flow_cycles.hpp"
#include "apps/flow_setup.hpp"
#include "apps/forced_output.hpp"
#include "apps/restart.hpp"
#include "apps/solution_output.hpp"
#include "apps/steady_stage.hpp"
#include "core/io/progress.hpp"
#include "core/spectral/mean_instance.hpp"

namespace wingbeat {
namespace {

double kappa(const CaseSettings& settings) {
  return 2.0 * *settings.pitch.reduced_frequency * section_kinematics(settings).flow_speed;
}

// The motion as the states of a typical section, at the speed V_ref where the two clocks agree with k.
AeroelasticState moved_state(const CaseSettings& settings, const TimeSpectral& time, std::vector<double> w) {
  const ForcedMotion motion = forced_motion(settings.pitch);
  AeroelasticState state;
  state.w = std::move(w);
  state.r = 1.0;
  state.omega =
      2.0 * *settings.pitch.reduced_frequency * section_kinematics(settings).reduced_velocity(state.r);
  constexpr double b = SectionKinematics::semichord;
  for (int n = 0; n < time.instances(); ++n) {
    const ForcedPosition at = position_at(motion, time.phase(n));
    state.y.insert(state.y.end(), {at.plunge / b, at.pitch - motion.mean_pitch,
                                   state.omega * at.plunge_slope / b, state.omega * at.pitch_slope});
  }
  return state;
}

// Newton with a line of progress and of history each iteration.
ForcedFlowResult solve_with_progress(Context& context, FlowEquations<2>& flow, ForcedFlowStart& start,
                                     const std::vector<MotionState>& motions, History& history,
                                     const FlowCycles::Save& save) {
  const auto part = context.timer.measure("newton");
  const ForcedFlowOptions options = forced_flow_options(context.settings.solver);
  Progress progress(context.log, "forced motion", {"iter", "|R|", "step", "linear"});
  double first = 0.0;
  return solve_forced_flow<2>(flow, start.factors, motions, kappa(context.settings), start.w, options,
                              [&](const ForcedFlowIteration& i) {
                                history.forced("pitch", i);
                                if (i.iteration == 0) first = i.residual;
                                progress.row(
                                    {fmt::format("{}", i.iteration), fmt::format("{:.2e}", i.residual),
                                     fmt::format("{:.2f}", i.step), fmt::format("{}", i.linear_iterations)},
                                    converged_fraction(first, i.residual, options.tolerance));
                                return context.checkpoints.goes_on([&] { save(start.w, std::nullopt); });
                              });
}

constexpr const char* cycles_stage = "pitch";

// Cycles; leaves what they go on with where they have not ended.
ForcedFlowResult solve_by_cycles(Context& context, const FlowLevel<2>& level, FlowEquations<2>& flow,
                                 std::vector<double>& w, const std::vector<MotionState>& motions,
                                 History& history, const FlowCycles::Save& save,
                                 std::optional<SolverMemory>& memory) {
  const SolverSettings& solver = context.settings.solver;
  FlowCycles cycles(context, level, flow);
  if (w.empty()) w = cycles.start(motions, kappa(context.settings));
  const double tolerance = solver.ends_with_newton() ? std::max(solver.newton_switch, solver.flow_tolerance)
                                                     : solver.flow_tolerance;
  PseudoTimeResult result =
      cycles.solve(w, motions, kappa(context.settings), tolerance, cycles_stage, history, save);
  memory = memory_of(cycles_stage, result);
  context.result.message = cycles_advice(result.status, tolerance, context.settings.pseudo_time);
  ForcedFlowResult forced{.status = result.status, .residual = result.residual};
  forced.cycles = result.cycles;
  return forced;
}

ForcedFlowStage solve_forced(Context& context, FlowLevel<2>& level, const TimeSpectral& time,
                             ForcedFlowStart start, History& history) {
  const CaseSettings& settings = context.settings;
  const SolverSettings& solver = settings.solver;
  FlowEquations<2> flow(level.domain, level.steady.model(), time);
  const std::vector<MotionState> motions = motions_of(forced_motion(settings.pitch), time, kappa(settings));
  const bool by_cycles = solver.flow_solver() != "newton";
  const FlowCycles::Save save = [&](std::vector<double> w, const std::optional<SolverMemory>& memory) {
    write_checkpoint(context, level, moved_state(settings, time, std::move(w)), memory);
  };
  ForcedFlowResult result;
  std::optional<SolverMemory> memory;
  if (by_cycles) result = solve_by_cycles(context, level, flow, start.w, motions, history, save, memory);
  if (!by_cycles || (result.status == SolveStatus::converged && solver.ends_with_newton())) {
    if (!start.factors.mean)
      start.factors = unfactored(level.comm(), level.subdomain, state_size<2>, time.harmonics());
    const int cycles = result.cycles;
    result = solve_with_progress(context, flow, start, motions, history, save);
    result.cycles = cycles;
    if (result.status == SolveStatus::diverged) note_breakdown(context, level, start.w);
    context.result.message = forced_advice(result.status, solver);
  }
  history.write();
  const auto part = context.timer.measure("output");
  std::vector<Coefficients> loads;
  for (std::size_t n = 0; const Loads<double>& instance : flow.loads(start.w, motions))
    loads.push_back(coefficients(settings, instance, motions[n++].pitch));
  write_solution_files(context, level, moved_state(settings, time, start.w), memory);
  report_forced_loads(context, time, loads, result);
  return {result.status, std::move(start)};
}

}  // namespace

ForcedFlowStage run_pitch_stage(Context& context, FlowLevels<2>& levels, History& history, bool needs_rest) {
  const CaseSettings& settings = context.settings;
  const TimeSpectral time(settings.time.harmonics);
  FlowLevel<2>& level = *levels.back();
  ForcedFlowStart start;
  if (context.restart) {
    // A periodic solution goes straight to Newton; a steady one is where the steady flow starts.
    AeroelasticState state = read_restart(context, level, {1, time.instances()});
    const bool is_periodic = state.y.size() > 4;
    level.w = is_periodic ? mean_instance(state.w, time) : state.w;
    if (is_periodic) {
      start = steady_start<2>(level, time);
      start.w = std::move(state.w);
    }
  }
  // Cycles start by full multigrid, Newton from the steady flow and its linear response.
  const bool by_cycles = settings.solver.flow_solver() != "newton";
  if ((start.w.empty() && !by_cycles) || needs_rest) {
    const SolveStatus steady = run_steady_stage(context, levels, history);
    if (steady != SolveStatus::converged) return {steady, {}};
  }
  if (start.w.empty() && !by_cycles) {
    const auto part = context.timer.measure("linear response");
    start = linear_start<2>(level, time, forced_motion(settings.pitch), kappa(settings),
                            gmres_options(settings.solver));
  }
  return solve_forced(context, level, time, std::move(start), history);
}

}  // namespace wingbeat
