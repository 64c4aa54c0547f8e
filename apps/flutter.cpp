#include <cmath>
#include <numbers>

#include "apps/advice.hpp"
#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/history.hpp"
#include "apps/linear_flutter_output.hpp"
#include "apps/solution_output.hpp"
#include "apps/steady_stage.hpp"
#include "apps/verbs.hpp"
#include "core/io/progress.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"

namespace wingbeat {
namespace {

// Where the coupled Newton iteration starts, and the factors it starts with.
struct Start {
  AeroelasticState state;
  AeroelasticState rest;  // one instance
  HarmonicFactors factors;
};

Start linear_start(const CaseSettings& settings, FlowLevel<2>& level, const StructureModel& model,
                   const TimeSpectral& time, LinearFlutterSolution<2>& linear) {
  const FlutterRoot& root = *linear.flutter.root;
  const Eigen::VectorXcd u_hat = scaled_to_energy(model, root.mode, root.frequency, settings.flutter.energy);
  Start start;
  start.state = linear.section->harmonic_state(model, time, u_hat, root.frequency, root.reduced_velocity);
  start.rest = linear.section->rest();
  start.factors = unfactored(level.comm(), level.subdomain, state_size<2>, time.harmonics());
  start.factors.mean = level.solver;
  start.factors.harmonics[0] = linear.section->factors();
  return start;
}

// Mean over the instances of a field [instance][width].
std::vector<double> mean_instance(const std::vector<double>& field, const TimeSpectral& time) {
  const auto instances = static_cast<std::size_t>(time.instances()), width = field.size() / instances;
  std::vector<double> mean(width, 0.0);
  for (std::size_t i = 0; i < field.size(); ++i) mean[i % width] += field[i] / static_cast<double>(instances);
  return mean;
}

Start restarted(FlowLevel<2>& level, const TimeSpectral& time, AeroelasticState state) {
  Start start;
  start.state = std::move(state);
  start.rest = {mean_instance(start.state.w, time), mean_instance(start.state.y, time), 0.0, start.state.r};
  start.factors = unfactored(level.comm(), level.subdomain, state_size<2>, time.harmonics());
  return start;
}

void report_flutter(Context& context, const StructureModel& model, const TimeSpectral& time,
                    const AeroelasticState& state, const AeroelasticResiduals& residuals,
                    const NewtonResult& newton) {
  const double v = section_kinematics(context.settings).reduced_velocity(state.r);
  const Eigen::VectorXcd u = first_harmonic(model, time, state.y);
  const double pitch_deg = std::abs(u[pitch_mode]) * 180.0 / std::numbers::pi;
  auto entry = flutter_point(context.settings, v, state.omega);
  entry["freestream_parameter"] = state.r;
  entry["energy"] = fluctuating_energy(model, state.y);
  entry["average_energy"] = average_energy(model, state.y);
  entry["pitch_amplitude_deg"] = pitch_deg;
  entry["plunge_amplitude"] = std::abs(u[plunge_mode]);
  entry["residuals"] = {{"flow", residuals.flow},
                        {"structure", residuals.structure},
                        {"phase", residuals.phase},
                        {"energy", residuals.energy}};
  entry["newton_iterations"] = newton.iterations;
  entry["linear_iterations"] = newton.linear_iterations;
  entry["factorizations"] = newton.factorizations;
  context.result.findings["flutter"] = entry;
  context.result.message = newton.status == SolveStatus::converged
                               ? fmt::format("V_F = {:.6f}, omega = {:.6f}", v, state.omega)
                               : coupled_advice(newton.status, context.settings.solver);

  context.log.line("\n{:<34}{:.8f}", "reduced velocity V = U/(c w_a)", v);
  context.log.line("{:<34}{:.8f}", "speed index 2V/sqrt(mu)", entry["speed_index"].get<double>());
  context.log.line("{:<34}{:.8f}", "frequency ratio omega/w_a", state.omega);
  context.log.line("{:<34}{:.8f}", "reduced frequency k", state.omega / (2.0 * v));
  context.log.line("{:<34}{:.6f} deg, plunge {:.3e} semichords", "pitch amplitude", pitch_deg,
                   std::abs(u[plunge_mode]));
  context.log.line("{:<34}flow {:.1e}, structure {:.1e}, phase {:.1e}, energy {:.1e}", "residuals",
                   residuals.flow, residuals.structure, residuals.phase, residuals.energy);
  context.log.line("{:<34}{} Newton, {} Krylov, {} new factorizations\n", "iterations", newton.iterations,
                   newton.linear_iterations, newton.factorizations);
}

// Newton on flow, structure, phase and energy together, with progress lines.
SolveStatus solve_coupled(Context& context, FlowLevel<2>& level, const StructureModel& model, Start start,
                          History& history) {
  const CaseSettings& settings = context.settings;
  const TimeSpectral time(settings.time.harmonics);
  FlowEquations<2> flow(level.domain, level.steady.model(), time);
  AeroelasticProblem<2> problem(flow, StructuralEquation(model, time), section_kinematics(settings),
                                energy_condition(model, settings.flutter.energy), start.rest, start.factors,
                                {settings.solver.flow_tolerance, settings.solver.structure_tolerance});
  std::vector<double> u = problem.unknowns(start.state);
  NewtonOptions options;
  options.max_iterations = settings.solver.max_newton_iterations;
  options.gmres = gmres_options(settings.solver);
  AeroelasticResiduals residuals;
  NewtonResult result;
  {
    const auto part = context.timer.measure("newton");
    Progress progress(context.log, "coupled Newton", {"iter", "|R|", "|S|", "omega", "V", "linear"});
    double first = 0.0;
    result =
        newton(context.comm, problem, u, options,
               [&](const NewtonIteration& i, std::span<const double> at, std::span<const double> f) {
                 const AeroelasticState now = problem.state(at);
                 residuals = problem.measure(f);
                 const double v = section_kinematics(settings).reduced_velocity(now.r);
                 history.coupled("flutter", i, residuals, now.omega, v);
                 if (i.iteration == 0) first = residuals.flow;
                 progress.row({fmt::format("{}", i.iteration), fmt::format("{:.2e}", residuals.flow),
                               fmt::format("{:.2e}", residuals.structure), fmt::format("{:.6f}", now.omega),
                               fmt::format("{:.6f}", v), fmt::format("{}", i.linear_iterations)},
                              converged_fraction(first, residuals.flow, settings.solver.flow_tolerance));
                 return !context.stop.is_set();
               });
  }
  history.write();
  const auto part = context.timer.measure("output");
  const AeroelasticState state = problem.state(u);
  write_solution_files(context, level, state);
  report_flutter(context, model, time, state, residuals, result);
  return result.status;
}

}  // namespace

SolveStatus run_flutter(Context& context) {
  const CaseSettings& settings = context.settings;
  const StructureModel model = structure_model(typical_section(settings.structure));
  const TimeSpectral time(settings.time.harmonics);
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(settings.mesh));
  FlowLevel<2>& level = *levels.back();
  History history(context);
  if (context.restart) {
    // A periodic solution goes straight to Newton; a steady one is where the steady flow starts.
    AeroelasticState state = read_restart(context, level, {1, time.instances()});
    if (state.y.size() > 4)
      return solve_coupled(context, level, model, restarted(level, time, std::move(state)), history);
    level.w = std::move(state.w);
  }
  const SolveStatus steady = run_steady_stage(context, levels, history);
  if (steady != SolveStatus::converged) return steady;

  LinearFlutterSolution<2> linear;
  {
    const auto part = context.timer.measure("linear flutter");
    linear =
        solve_linear_flutter<2>(levels, model, section_kinematics(settings), linear_flutter_options(context));
  }
  report_linear_flutter(context, linear.flutter);
  if (!linear.flutter.root) {
    context.result.message = no_flutter_message(settings);
    return SolveStatus::stalled;
  }
  return solve_coupled(context, level, model, linear_start(settings, level, model, time, linear), history);
}

}  // namespace wingbeat
