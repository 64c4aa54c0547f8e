#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/advice.hpp"
#include "apps/case_mesh.hpp"
#include "apps/flow_cycles.hpp"
#include "apps/flow_setup.hpp"
#include "apps/forced_output.hpp"
#include "apps/history.hpp"
#include "apps/solution_output.hpp"
#include "apps/steady_stage.hpp"
#include "apps/verbs.hpp"
#include "core/io/progress.hpp"
#include "core/spectral/mean_instance.hpp"
#include "structure/forced_matrix.hpp"
#include "structure/linear_flutter.hpp"

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
                                     const std::vector<MotionState>& motions, History& history) {
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
                                return !context.stop.is_set();
                              });
}

ForcedFlowResult solve_by_cycles(Context& context, const FlowLevel<2>& level, FlowEquations<2>& flow,
                                 std::vector<double>& w, const std::vector<MotionState>& motions,
                                 History& history) {
  const SolverSettings& solver = context.settings.solver;
  FlowCycles cycles(context, level, flow);
  if (w.empty()) w = cycles.start(motions, kappa(context.settings));
  const double tolerance = solver.ends_with_newton() ? std::max(solver.newton_switch, solver.flow_tolerance)
                                                     : solver.flow_tolerance;
  const PseudoTimeResult result =
      cycles.solve(w, motions, kappa(context.settings), tolerance, "pitch", history);
  context.result.message = cycles_advice(result.status, tolerance, context.settings.pseudo_time);
  ForcedFlowResult forced{.status = result.status, .residual = result.residual};
  forced.cycles = result.cycles;
  return forced;
}

SolveStatus solve_forced(Context& context, FlowLevel<2>& level, const TimeSpectral& time,
                         ForcedFlowStart start, History& history) {
  const CaseSettings& settings = context.settings;
  const SolverSettings& solver = settings.solver;
  FlowEquations<2> flow(level.domain, level.steady.model(), time);
  const std::vector<MotionState> motions = motions_of(forced_motion(settings.pitch), time, kappa(settings));
  const bool by_cycles = solver.flow_solver() != "newton";
  ForcedFlowResult result;
  if (by_cycles) result = solve_by_cycles(context, level, flow, start.w, motions, history);
  if (!by_cycles || (result.status == SolveStatus::converged && solver.ends_with_newton())) {
    if (!start.factors.mean)
      start.factors = unfactored(level.comm(), level.subdomain, state_size<2>, time.harmonics());
    const int cycles = result.cycles;
    result = solve_with_progress(context, flow, start, motions, history);
    result.cycles = cycles;
    context.result.message = forced_advice(result.status, solver);
  }
  history.write();
  const auto part = context.timer.measure("output");
  std::vector<Coefficients> loads;
  for (std::size_t n = 0; const Loads<double>& instance : flow.loads(start.w, motions))
    loads.push_back(coefficients(settings, instance, motions[n++].pitch));
  write_solution_files(context, level, moved_state(settings, time, std::move(start.w)));
  report_forced_loads(context, time, loads, result);
  return result.status;
}

// Q(k) by small forced motions beside the linearized one, about the level's steady flow. With a single
// harmonic the second, of the square of the amplitude, would be taken for the first.
void compute_derivatives(Context& context, FlowLevel<2>& level) {
  const auto part = context.timer.measure("derivatives");
  const CaseSettings& settings = context.settings;
  const double k = *settings.pitch.reduced_frequency;
  const SectionKinematics kinematics = section_kinematics(settings);
  const TimeSpectral time(std::max(2, settings.time.harmonics));
  ForcedMatrixOptions options;
  options.amplitude = settings.pitch.derivative_amplitude_deg * std::numbers::pi / 180.0;
  options.flow = forced_flow_options(settings.solver);
  options.observer = [&](const ForcedFlowIteration&) { return !context.stop.is_set(); };
  const Eigen::Matrix2cd forced = forced_aerodynamic_matrix<2>(level, time, kinematics, k, options);
  LinearizedSection<2> section(level, kinematics, {level.w, std::vector<double>(4, 0.0), 0.0, 1.0}, 1e-10, {},
                               gmres_options(settings.solver));
  report_derivatives(context, forced, section.aerodynamic_matrix(k));
}

}  // namespace

std::vector<std::string> pitch_faults(const CaseSettings& settings) {
  const PitchSettings& pitch = settings.pitch;
  std::vector<std::string> faults;
  if (!pitch.reduced_frequency)
    faults.push_back(
        "pitch.reduced_frequency: missing; wingbeat pitch needs it: k = omega b/U of the motion (number, > "
        "0)");
  const auto check = [&](const char* key, const std::vector<double>& values) {
    int highest = static_cast<int>(values.size());
    while (highest > 0 && values[static_cast<std::size_t>(highest - 1)] == 0.0) --highest;
    if (highest > settings.time.harmonics)
      faults.push_back(
          fmt::format("pitch.{}: moves harmonic {}, beyond time.harmonics = {}; set "
                      "time.harmonics to {} or more",
                      key, highest, settings.time.harmonics, highest));
  };
  check("sine_deg", pitch.sine_deg);
  check("cosine_deg", pitch.cosine_deg);
  check("plunge_sine", pitch.plunge_sine);
  check("plunge_cosine", pitch.plunge_cosine);
  if (forced_motion(pitch).harmonics() == 0)
    faults.push_back(
        "pitch.amplitude_deg: the section does not move; give this key, or one of pitch.sine_deg, "
        "pitch.cosine_deg, pitch.plunge_sine and pitch.plunge_cosine");
  return faults;
}

SolveStatus run_pitch(Context& context) {
  const CaseSettings& settings = context.settings;
  const TimeSpectral time(settings.time.harmonics);
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(settings.mesh));
  FlowLevel<2>& level = *levels.back();
  History history(context);
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
  const bool needs_steady = (start.w.empty() && !by_cycles) || settings.pitch.derivatives;
  if (needs_steady) {
    const SolveStatus steady = run_steady_stage(context, levels, history);
    if (steady != SolveStatus::converged) return steady;
  }
  if (start.w.empty() && !by_cycles) {
    const auto part = context.timer.measure("linear response");
    start = linear_start<2>(level, time, forced_motion(settings.pitch), kappa(settings),
                            gmres_options(settings.solver));
  }
  const SolveStatus status = solve_forced(context, level, time, std::move(start), history);
  if (settings.pitch.derivatives && status == SolveStatus::converged) compute_derivatives(context, level);
  return status;
}

}  // namespace wingbeat
