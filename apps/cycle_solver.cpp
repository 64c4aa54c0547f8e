#include "apps/cycle_solver.hpp"

#include <algorithm>
#include <cmath>

#include "apps/breakdown.hpp"
#include "apps/flow_cycles.hpp"
#include "apps/flow_setup.hpp"
#include "apps/kept_factors.hpp"
#include "apps/memory_packing.hpp"
#include "apps/solution_output.hpp"
#include "core/io/progress.hpp"
#include "core/spectral/mean_instance.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"

namespace wingbeat {
namespace {

// Structure, phase and energy residuals with which cycles hand over to Newton.
constexpr double structure_switch = 1e-2;
constexpr int steps_a_line = 20;

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

// Along the branch r changes by some hundred times the energy's change: the linear solve must show it
// beside terms of order one.
double slope_tolerance(double energy) { return std::clamp(1e-3 * energy, 1e-10, 1e-3); }

// The row of a cycle of given energy or speed.
CycleCondition condition_of(const CycleAmplitude& amplitude, const StructureModel& model) {
  if (const auto* given = std::get_if<GivenEnergy>(&amplitude)) return energy_condition(model, given->energy);
  const auto& given = std::get<GivenSpeed>(amplitude);
  CycleCondition condition(energy_condition(model, given.initial_energy));
  condition.by_energy = 0.0;
  condition.by_speed = 1.0;
  condition.reduced_velocity = given.reduced_velocity;
  return condition;
}

}  // namespace

TimeSpectral time_of(const AeroelasticState& state) {
  return TimeSpectral((static_cast<int>(state.y.size() / 4) - 1) / 2);
}

CycleStart CycleSolver::linear_start(LinearFlutterSolution<2>& linear, const FlutterRoot& root,
                                     const FlowLevel<2>& linearized, double energy) {
  const Eigen::VectorXcd u_hat = scaled_to_energy(model_, root.mode, root.frequency, energy);
  CycleStart start;
  start.state = linear.section->harmonic_state(model_, time_, u_hat, root.frequency, root.reduced_velocity);
  start.rest = linear.section->rest();
  start.factors = unfactored(level_.comm(), level_.subdomain, state_size<2>, time_.harmonics());
  if (&linearized == &level_) {
    // The steady flow's factors are of a step on the way to it; those of the state of rest, where the level
    // is linearized, save more iterations than they cost.
    level_.solver->factor<state_size<2>>(level_.steady.jacobians()[0], {});
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
  if (const auto& memory = context_.checkpoints.memory(); memory && is_of_turns(*memory))
    start.rest = unpacked_turns(*memory).rest;
  start.factors = unfactored(level_.comm(), level_.subdomain, state_size<2>, time_.harmonics());
  return start;
}

CycleStart CycleSolver::moved(AeroelasticState cycle, double energy) {
  AeroelasticState rest{mean_instance(cycle.w, time_), mean_instance(cycle.y, time_), 0.0, cycle.r};
  const std::vector<MotionState> unmoved{{section_kinematics(context_.settings).mean_pitch, 0.0, 0.0}};
  if (!is_deflected(level_.steady.loads(level_.w, unmoved)[0])) {
    for (std::size_t i = 0; i < cycle.w.size(); ++i)
      cycle.w[i] += level_.w[i % level_.w.size()] - rest.w[i % level_.w.size()];
    rest.w = level_.w;
  }
  CycleStart start = grown(std::move(cycle), rest, energy);
  // Sought from nearby, the steady flow has left factors that are as good as the state of rest's own.
  start.factors.mean = level_.solver;
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

void CycleSolver::lend_factors(CycleStart& start) const {
  if (!context_.kept_factors) return;
  auto harmonics = context_.kept_factors->lent(level_, time_.harmonics());
  if (!harmonics.empty()) start.factors.harmonics = std::move(harmonics);
}

void CycleSolver::keep_factors(const CycleStart& start, const CycleSolution& solution) const {
  if (!context_.kept_factors || context_.settings.solver.is_staggered()) return;
  if (solution.status == SolveStatus::converged)
    context_.kept_factors->keep(start.factors.harmonics, solution.linear_iterations, solution.factorizations);
  else
    context_.kept_factors->let_go();
}

void CycleSolver::add_harmonic(HarmonicFactors& factors) const {
  const HarmonicFactors more = unfactored(level_.comm(), level_.subdomain, state_size<2>, 1);
  factors.harmonics.push_back(more.harmonics.front());
}

AeroelasticTolerances CycleSolver::tolerances(double looseness) const {
  const SolverSettings& solver = context_.settings.solver;
  return {looseness * solver.flow_tolerance, looseness * solver.structure_tolerance};
}

CycleSolution CycleSolver::solve(const std::string& stage, const CycleStart& start,
                                 const CycleAmplitude& amplitude) {
  const SolverSettings& solver = context_.settings.solver;
  if (!solver.is_staggered()) return solve_to_the_end(stage, start, condition_of(amplitude, model_));
  CycleSolution turns = solve_by_turns(stage, start, amplitude);
  if (solver.flow_solver() != "runge_kutta_newton" || turns.status != SolveStatus::converged) return turns;
  // Newton finishes on all rows at once, near what the turns arrived at.
  CycleCondition condition = condition_of(amplitude, model_);
  if (std::holds_alternative<GivenSpeed>(amplitude))
    condition.energy.energy = fluctuating_energy(model_, turns.state.y);
  CycleSolution solution = solve_to_the_end(stage, restart(turns.state), condition);
  solution.staggered_iterations = turns.staggered_iterations;
  solution.flow_cycles = turns.flow_cycles;
  return solution;
}

CycleSolution CycleSolver::solve_to_the_end(const std::string& stage, const CycleStart& start,
                                            const CycleCondition& condition) {
  CoupledOptions how;
  how.max_iterations = context_.settings.solver.max_newton_iterations;
  how.is_kept = true;
  return solve_coupled(stage, start, condition, how);
}

CycleSolution CycleSolver::solve_coupled(const std::string& stage, const CycleStart& start,
                                         const CycleCondition& condition, const CoupledOptions& how) {
  const CaseSettings& settings = context_.settings;
  const SectionKinematics kinematics = section_kinematics(settings);
  const auto part = context_.timer.measure("newton");
  const TimeSpectral time = time_of(start.state);
  FlowEquations<2> flow(level_.domain, level_.steady.model(), time);
  AeroelasticProblem<2> problem(flow, StructuralEquation(model_, time), kinematics, condition, start.rest,
                                start.factors, tolerances(how.looseness));
  std::vector<double> u = problem.unknowns(start.state);
  NewtonOptions options;
  options.max_iterations = how.max_iterations;
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
               if (!how.is_kept) return !context_.stop.is_set();
               return context_.checkpoints.goes_on([&] { write_checkpoint(context_, level_, now); });
             });
  solution.status = result.status;
  solution.state = problem.state(u);
  if (solution.status == SolveStatus::diverged) note_breakdown(context_, level_, solution.state.w);
  if (solution.status == SolveStatus::converged && is_at_rest(condition, solution.state.y))
    solution.status = SolveStatus::stalled;
  solution.newton_iterations = result.iterations;
  solution.linear_iterations = result.linear_iterations;
  solution.factorizations = result.factorizations;
  solution.factor_bytes = context_.comm.sum(factor_bytes(start.factors));
  solution.loads = flow.loads(solution.state.w, problem.motions(solution.state));
  if (how.with_tangent && solution.status == SolveStatus::converged) {
    const auto slope = context_.timer.measure("branch slope");
    GmresOptions gmres = options.gmres;
    gmres.relative_tolerance = slope_tolerance(condition.energy.energy);
    const CycleTangent tangent = cycle_tangent<2>(context_.comm, problem, model_, kinematics, u, gmres);
    if (tangent.status == GmresStatus::converged)
      solution.tangent = tangent;
    else
      context_.log.line("the slope of the branch was not found: {} Krylov iterations did not do",
                        tangent.linear_iterations);
  }
  return solution;
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
  std::optional<StaggeredMemory> earlier;
  if (auto memory = context_.checkpoints.recall(turns_stage(stage)))
    earlier = unpacked_turns(*std::move(memory)).staggered;
  Progress progress(
      context_.log,
      fmt::format("{}, staggered, Runge-Kutta on {} meshes", stage, cycles.multigrid().levels()),
      {"iter", "|R|", "|S|", "omega", "V", "relaxation"});
  double first = 0.0;
  BreakdownWatch watch(context_, level_);
  StaggeredResult result = solve_staggered<2>(
      [&](std::span<double> w, std::span<const MotionState> motions, double kappa) {
        cycles.multigrid().cycle(w, motions, kappa, cycles.step());
        watch.look(w);
      },
      flow, StructuralEquation(model_, time_), section_kinematics(settings), amplitude, solution.state,
      settings.staggered.options(target),
      [&](const StaggeredIteration& i) {
        history_.staggered(stage, i);
        if (first == 0.0) first = i.residuals.flow;
        const double fraction = converged_fraction(first, i.residuals.flow, target.flow);
        if (i.iteration % steps_a_line == 0)
          progress.row({fmt::format("{}", i.iteration), fmt::format("{:.2e}", i.residuals.flow),
                        fmt::format("{:.2e}", i.residuals.structure), fmt::format("{:.6f}", i.omega),
                        fmt::format("{:.6f}", i.reduced_velocity), fmt::format("{:.2g}", i.relaxation)},
                       fraction);
        else
          progress.show(fraction);
        return context_.checkpoints.goes_on([&] {
          write_checkpoint(context_, level_, solution.state,
                           packed(turns_stage(stage), i.memory(), start.rest));
        });
      },
      earlier ? &*earlier : nullptr);
  solution.status = result.status;
  solution.residuals = result.residuals;
  solution.staggered_iterations = result.iterations;
  solution.flow_cycles = result.flow_cycles;
  if (result.memory) solution.memory = packed(turns_stage(stage), *std::move(result.memory), start.rest);
  std::vector<MotionState> motions;
  for (std::size_t n = 0; n < solution.state.y.size(); n += 4)
    motions.push_back(section_kinematics(settings).motion(
        std::span<const double>(solution.state.y).subspan(n, 4), solution.state.r));
  solution.loads = flow.loads(solution.state.w, motions);
  return solution;
}

}  // namespace wingbeat
