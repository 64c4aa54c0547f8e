#include "apps/cycle_primal.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/analysis_setup.hpp"
#include "apps/cycle_branch.hpp"
#include "apps/cycle_record.hpp"
#include "apps/cycle_stage.hpp"
#include "apps/flow_setup.hpp"
#include "apps/solution_output.hpp"
#include "structure/energy.hpp"

namespace wingbeat {
namespace {

// With --check.
constexpr double round_off_flow = 2e-12, round_off_structure = 1e-12;

std::optional<double> speed_of(const CycleAmplitude& amplitude) {
  if (const auto* given = std::get_if<GivenSpeed>(&amplitude)) return given->reduced_velocity;
  return std::nullopt;
}

std::string not_reached(const LcoSettings& lco, const CycleBranch& branch, const CycleAmplitude& target) {
  if (const auto speed = speed_of(target))
    return fmt::format(
        "no cycle was found at lco.reduced_velocity = {:g}: the branch was followed to E_0 = {:.3e}, V = "
        "{:.6f}; choose a speed that it reaches, or raise lco.max_energy = {:g}",
        *speed, branch.energy(), branch.reduced_velocity(), lco.max_energy);
  return fmt::format(
      "the cycle of lco.energies = {:g} was not reached: the branch was followed to E_0 = {:.3e}, V = "
      "{:.6f}; a smaller energy, a finer mesh or other time.harmonics may do",
      std::get<GivenEnergy>(target).energy, branch.energy(), branch.reduced_velocity());
}

}  // namespace

std::array<double, 3> onset_weights(double energy) { return {-1.5 / energy, 2.0 / energy, -0.5 / energy}; }

CyclePrimal::CyclePrimal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape,
                         History& history)
    : context_(context),
      settings_(context.settings),
      levels_(levels),
      level_(*levels.back()),
      shape_(shape),
      history_(history),
      model_(structure_model(typical_section(settings_.structure))),
      solver_(context, level_, model_, history) {}

CyclePrimal::Cycles CyclePrimal::flutter() {
  return single("flutter", GivenEnergy{settings_.flutter.energy});
}

CyclePrimal::Cycles CyclePrimal::of_energies(const std::vector<double>& energies) {
  std::vector<CycleAmplitude> targets;
  for (const double energy : energies) targets.push_back(GivenEnergy{energy});
  if (!settings_.solver.is_staggered())
    return on_branch(std::min(settings_.flutter.energy, energies.front()), energies.back(), targets);
  Cycles all;
  for (const auto& target : targets) {
    Cycles one = single("cycle", target);
    all.status = one.status;
    if (one.status != SolveStatus::converged) break;
    all.analyses.push_back(std::move(one.analyses.front()));
  }
  return all;
}

CyclePrimal::Cycles CyclePrimal::at_speed(double reduced_velocity) {
  const GivenSpeed target{reduced_velocity, settings_.flutter.energy};
  if (settings_.solver.is_staggered()) return single("cycle", target);
  return on_branch(std::min(settings_.flutter.energy, settings_.lco.max_energy), settings_.lco.max_energy,
                   {target});
}

std::optional<CycleStart> CyclePrimal::approach(double energy, Cycles& cycles) {
  CycleApproach found = approach_cycle(context_, levels_, model_, solver_, energy, history_);
  cycles.status = found.status;
  return std::move(found.start);
}

// Straight from the start that linear flutter, or a restart, gives.
CyclePrimal::Cycles CyclePrimal::single(const std::string& stage, const CycleAmplitude& amplitude) {
  Cycles cycles;
  const auto* given = std::get_if<GivenEnergy>(&amplitude);
  const auto start = approach(given ? given->energy : settings_.flutter.energy, cycles);
  if (!start) return cycles;
  const CycleSolution solution = solver_.solve(stage, *start, amplitude);
  if (finish(cycles, solution, stage == "flutter")) add(solution, *start, speed_of(amplitude), cycles);
  return cycles;
}

// Along the branch from small motion, as the coupled method goes.
CyclePrimal::Cycles CyclePrimal::on_branch(double first_energy, double largest_energy,
                                           const std::vector<CycleAmplitude>& targets) {
  Cycles cycles;
  const auto start = approach(first_energy, cycles);
  if (!start) return cycles;
  if (context_.restart) first_energy = fluctuating_energy(model_, start->state.y);
  CycleBranch branch(context_, model_, solver_, *start, largest_energy);
  cycles.status = branch.begin(first_energy);
  if (cycles.status != SolveStatus::converged) finish(cycles, branch.solution(), false);
  for (const CycleAmplitude& target : targets) {
    if (cycles.status != SolveStatus::converged) break;
    follow(branch, target, cycles);
  }
  return cycles;
}

void CyclePrimal::follow(CycleBranch& branch, const CycleAmplitude& target, Cycles& cycles) {
  const LcoSettings& lco = settings_.lco;
  const auto speed = speed_of(target);
  const double energy = speed ? 0.0 : std::get<GivenEnergy>(target).energy;
  const bool is_there = speed ? CycleRecord::is_same(branch.reduced_velocity(), *speed)
                              : CycleRecord::is_same(branch.energy(), energy);
  BranchStep step = is_there ? BranchStep::reached : BranchStep::advanced;
  while (step == BranchStep::advanced && (!speed || branch.energy() < lco.max_energy))
    step = speed ? branch.advance_to_speed(*speed) : branch.advance_to_energy(energy);
  if (step == BranchStep::reached) {
    if (finish(cycles, branch.solution(), false)) add(branch.solution(), branch.start(), speed, cycles);
    return;
  }
  cycles.status = step == BranchStep::interrupted ? SolveStatus::interrupted : SolveStatus::stalled;
  if (step != BranchStep::interrupted) context_.result.message = not_reached(lco, branch, target);
}

CyclePrimal::Cycles CyclePrimal::onset(double energy) {
  Cycles cycles;
  auto start = approach(energy, cycles);
  for (int i = 1; start && i <= 3; ++i) {
    const CycleSolution solution =
        solver_.solve(fmt::format("cycle {} of 3", i), *start, GivenEnergy{energy * i});
    if (!finish(cycles, solution, false)) return cycles;
    add(solution, *start, std::nullopt, cycles);
    if (i < 3) start = solver_.grown(solution.state, start->rest, energy * (i + 1));
  }
  return cycles;
}

// Reports a cycle; true where it converged.
bool CyclePrimal::finish(Cycles& cycles, const CycleSolution& solution, bool is_flutter) {
  history_.write();
  const auto part = context_.timer.measure("output");
  cycles.status = solution.status;
  write_solution_files(context_, level_, solution.state, solution.memory);
  const auto entry = cycle_entry(settings_, model_, solution);
  if (is_flutter)
    context_.result.findings["flutter"] = entry;
  else
    context_.result.findings["lco"].push_back(entry);
  print_cycle(context_, entry);
  if (solution.status != SolveStatus::converged) context_.result.message = cycle_advice(settings_, solution);
  return solution.status == SolveStatus::converged;
}

void CyclePrimal::add(const CycleSolution& solution, const CycleStart& start,
                      std::optional<double> reduced_velocity, Cycles& cycles) {
  const auto part = context_.timer.measure("linearization");
  HarmonicFactors factors = start.factors;
  if (!factors.mean)
    factors = unfactored(level_.comm(), level_.subdomain, state_size<2>, time_of(solution.state).harmonics());
  auto analysis = cycle_analysis(context_, level_, shape_, solution.state, start.rest, std::move(factors),
                                 reduced_velocity);
  analysis->solve(no_change(shape_.nodes()));
  analysis->keep();
  cycles.analyses.push_back(std::move(analysis));
}

std::unique_ptr<CycleAnalysis<2>> cycle_analysis(const Context& context, const FlowLevel<2>& level,
                                                 const ShapeVariables& shape, AeroelasticState start,
                                                 AeroelasticState rest, HarmonicFactors factors,
                                                 std::optional<double> reduced_velocity) {
  const CaseSettings& settings = context.settings;
  const SolverSettings& solver = settings.solver;
  const TypicalSection section = typical_section(settings.structure);
  CycleAnalysisOptions options;
  options.energy = fluctuating_energy(structure_model(section), start.y);
  options.reduced_velocity = reduced_velocity;
  options.tolerances = {primal_tolerance(context, solver.flow_tolerance, round_off_flow),
                        primal_tolerance(context, solver.structure_tolerance, round_off_structure)};
  options.slack = std::max(solver.flow_tolerance / options.tolerances.flow,
                           solver.structure_tolerance / options.tolerances.structure);
  options.newton = near_options(solver);
  return std::make_unique<CycleAnalysis<2>>(domain_base(context, level, shape), section,
                                            section_kinematics(settings).mean_pitch, std::move(start),
                                            std::move(rest), std::move(factors), options);
}

}  // namespace wingbeat
