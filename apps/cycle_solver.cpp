#include "apps/cycle_solver.hpp"

#include <algorithm>
#include <cmath>

#include "apps/flow_cycles.hpp"
#include "apps/flow_setup.hpp"
#include "core/io/progress.hpp"
#include "core/spectral/mean_instance.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"
#include "structure/staggered_energy_search.hpp"

namespace wingbeat {
namespace {

// Structure, phase and energy residuals with which cycles hand over to Newton.
constexpr double structure_switch = 1e-2;
constexpr int steps_a_line = 20;
constexpr int max_speed_iterations = 12;

// The cycle's flow on a finer mesh: that mesh's steady flow and the coarse mesh's departure from its own.
std::vector<double> refined_flow(const FlowLevel<2>& from, const std::vector<double>& rest,
                                 const std::vector<double>& w, const FlowLevel<2>& to) {
  std::vector<double> fine;
  for (std::size_t begin = 0; begin < w.size(); begin += rest.size()) {
    std::vector<double> departure(w.begin() + static_cast<std::ptrdiff_t>(begin),
                                  w.begin() + static_cast<std::ptrdiff_t>(begin + rest.size()));
    for (std::size_t i = 0; i < rest.size(); ++i) departure[i] -= rest[i];
    departure = transferred_state<2>(from, departure, to);
    for (std::size_t i = 0; i < departure.size(); ++i) fine.push_back(to.w[i] + departure[i]);
  }
  return fine;
}

double amplitude_energy(const CycleAmplitude& amplitude) {
  if (const auto* given = std::get_if<GivenEnergy>(&amplitude)) return given->energy;
  return std::get<GivenSpeed>(amplitude).initial_energy;
}

}  // namespace

CycleStart CycleSolver::linear_start(LinearFlutterSolution<2>& linear, const FlowLevel<2>& linearized,
                                     double energy) {
  const FlutterRoot& root = *linear.flutter.root;
  const Eigen::VectorXcd u_hat = scaled_to_energy(model_, root.mode, root.frequency, energy);
  CycleStart start;
  start.state = linear.section->harmonic_state(model_, time_, u_hat, root.frequency, root.reduced_velocity);
  start.rest = linear.section->rest();
  start.factors = unfactored(level_.comm(), level_.subdomain, state_size<2>, time_.harmonics());
  if (&linearized == &level_) {
    start.factors.mean = level_.solver;
    start.factors.harmonics[0] = linear.section->factors();
  } else {
    start.state.w = refined_flow(linearized, start.rest.w, start.state.w, level_);
    start.rest.w = level_.w;
  }
  return start;
}

CycleStart CycleSolver::restart(AeroelasticState state) {
  CycleStart start;
  start.state = std::move(state);
  start.rest = {mean_instance(start.state.w, time_), mean_instance(start.state.y, time_), 0.0, start.state.r};
  start.factors = unfactored(level_.comm(), level_.subdomain, state_size<2>, time_.harmonics());
  return start;
}

CycleStart CycleSolver::grown(AeroelasticState state, const AeroelasticState& rest, double energy) {
  const double ratio = std::sqrt(energy / fluctuating_energy(model_, state.y));
  const auto grow = [&](std::vector<double>& values, const std::vector<double>& about) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double origin = about[i % about.size()];
      values[i] = origin + ratio * (values[i] - origin);
    }
  };
  grow(state.w, rest.w);
  grow(state.y, rest.y);
  CycleStart start = restart(std::move(state));
  start.rest = rest;
  return start;
}

AeroelasticTolerances CycleSolver::tolerances() const {
  const SolverSettings& solver = context_.settings.solver;
  return {solver.flow_tolerance, solver.structure_tolerance};
}

CycleSolution CycleSolver::solve(const std::string& stage, const CycleStart& start,
                                 const CycleAmplitude& amplitude) {
  const SolverSettings& solver = context_.settings.solver;
  if (!solver.is_staggered()) {
    if (const auto* speed = std::get_if<GivenSpeed>(&amplitude))
      return solve_coupled_at_speed(stage, start, *speed);
    return solve_coupled(stage, start, amplitude_energy(amplitude));
  }
  CycleSolution turns = solve_by_turns(stage, start, amplitude);
  if (solver.flow_solver() != "runge_kutta_newton" || turns.status != SolveStatus::converged) return turns;
  // Newton finishes on all rows at once, at the energy that the turns arrived at.
  const CycleStart near = restart(turns.state);
  CycleSolution solution = std::holds_alternative<GivenSpeed>(amplitude)
                               ? solve_coupled_at_speed(stage, near,
                                                        {std::get<GivenSpeed>(amplitude).reduced_velocity,
                                                         fluctuating_energy(model_, turns.state.y)})
                               : solve_coupled(stage, near, amplitude_energy(amplitude));
  solution.staggered_iterations = turns.staggered_iterations;
  solution.flow_cycles = turns.flow_cycles;
  return solution;
}

CycleSolution CycleSolver::solve_coupled(const std::string& stage, const CycleStart& start, double energy) {
  const CaseSettings& settings = context_.settings;
  const SectionKinematics kinematics = section_kinematics(settings);
  const auto part = context_.timer.measure("newton");
  FlowEquations<2> flow(level_.domain, level_.steady.model(), time_);
  AeroelasticProblem<2> problem(flow, StructuralEquation(model_, time_), kinematics,
                                energy_condition(model_, energy), start.rest, start.factors, tolerances());
  std::vector<double> u = problem.unknowns(start.state);
  NewtonOptions options;
  options.max_iterations = settings.solver.max_newton_iterations;
  options.gmres = gmres_options(settings.solver);
  CycleSolution solution;
  Progress progress(context_.log, stage + ", coupled Newton", {"iter", "|R|", "|S|", "omega", "V", "linear"});
  double first = 0.0;
  const NewtonResult result =
      newton(context_.comm, problem, u, options,
             [&](const NewtonIteration& i, std::span<const double> at, std::span<const double> f) {
               const AeroelasticState now = problem.state(at);
               const AeroelasticResiduals residuals = solution.residuals = problem.measure(f);
               const double v = kinematics.reduced_velocity(now.r);
               history_.coupled(stage, i, residuals, now.omega, v);
               if (i.iteration == 0) first = residuals.flow;
               progress.row({fmt::format("{}", i.iteration), fmt::format("{:.2e}", residuals.flow),
                             fmt::format("{:.2e}", residuals.structure), fmt::format("{:.6f}", now.omega),
                             fmt::format("{:.6f}", v), fmt::format("{}", i.linear_iterations)},
                            converged_fraction(first, residuals.flow, settings.solver.flow_tolerance));
               return !context_.stop.is_set();
             });
  solution.status = result.status;
  solution.state = problem.state(u);
  solution.newton_iterations = result.iterations;
  solution.linear_iterations = result.linear_iterations;
  solution.factorizations = result.factorizations;
  return solution;
}

// The energy is sought whose cycle has the speed given: the branch is solved at a sequence of energies.
CycleSolution CycleSolver::solve_coupled_at_speed(const std::string& stage, CycleStart start,
                                                  const GivenSpeed& given) {
  const SectionKinematics kinematics = section_kinematics(context_.settings);
  const double target = std::pow(given.reduced_velocity / kinematics.reference_velocity, 2);
  EnergySearch search(target, given.initial_energy);
  CycleSolution total;
  for (int k = 0; k < max_speed_iterations; ++k) {
    CycleSolution found = solve_coupled(stage, start, search.energy());
    found.newton_iterations += total.newton_iterations;
    found.linear_iterations += total.linear_iterations;
    found.factorizations += total.factorizations;
    total = found;
    if (total.status != SolveStatus::converged) return total;
    total.residuals.energy = std::abs(search.mismatch(total.state.r));
    if (total.residuals.energy <= context_.settings.solver.structure_tolerance) return total;
    search.advance(total.state.r);
    start = grown(total.state, start.rest, search.energy());
  }
  total.status = SolveStatus::iteration_limit;
  total.is_search_exhausted = true;
  return total;
}

CycleSolution CycleSolver::solve_by_turns(const std::string& stage, const CycleStart& start,
                                          const CycleAmplitude& amplitude) {
  const CaseSettings& settings = context_.settings;
  const auto part = context_.timer.measure("staggered");
  AeroelasticTolerances target = tolerances();
  if (settings.solver.flow_solver() == "runge_kutta_newton")
    target = {std::max(settings.solver.newton_switch, target.flow),
              std::max(structure_switch, target.structure)};
  FlowEquations<2> flow(level_.domain, level_.steady.model(), time_);
  FlowCycles cycles(context_, level_, flow);
  CycleSolution solution;
  solution.state = start.state;
  Progress progress(
      context_.log,
      fmt::format("{}, staggered, Runge-Kutta on {} meshes", stage, cycles.multigrid().levels()),
      {"iter", "|R|", "|S|", "omega", "V", "relaxation"});
  double first = 0.0;
  const StaggeredResult result = solve_staggered<2>(
      [&](std::span<double> w, std::span<const MotionState> motions, double kappa) {
        cycles.multigrid().cycle(w, motions, kappa, cycles.step());
      },
      flow, StructuralEquation(model_, time_), section_kinematics(settings), amplitude, solution.state,
      settings.staggered.options(target),
      [&](const StaggeredIteration& i) {
        history_.staggered(stage, i);
        if (i.iteration == 0) first = i.residuals.flow;
        const double fraction = converged_fraction(first, i.residuals.flow, target.flow);
        if (i.iteration % steps_a_line == 0)
          progress.row({fmt::format("{}", i.iteration), fmt::format("{:.2e}", i.residuals.flow),
                        fmt::format("{:.2e}", i.residuals.structure), fmt::format("{:.6f}", i.omega),
                        fmt::format("{:.6f}", i.reduced_velocity), fmt::format("{:.2g}", i.relaxation)},
                       fraction);
        else
          progress.show(fraction);
        return !context_.stop.is_set();
      });
  solution.status = result.status;
  solution.residuals = result.residuals;
  solution.staggered_iterations = result.iterations;
  solution.flow_cycles = result.flow_cycles;
  return solution;
}

}  // namespace wingbeat
