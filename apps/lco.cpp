#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/case_mesh.hpp"
#include "apps/cycle_branch.hpp"
#include "apps/cycle_record.hpp"
#include "apps/cycle_stage.hpp"
#include "apps/flow_setup.hpp"
#include "apps/memory_packing.hpp"
#include "apps/solution_output.hpp"
#include "apps/verbs.hpp"
#include "core/io/counted.hpp"
#include "structure/energy.hpp"

namespace wingbeat {
namespace {

// The search for a cycle: what both methods need, and what they do with a cycle found.
struct LcoRun {
  Context& context;
  const FlowLevel<2>& level;
  const StructureModel& model;
  const History& history;
  CycleRecord& record;

  void save(const CycleSolution& solution, bool is_asked, const std::optional<SolverMemory>& memory) const {
    history.write();
    const auto part = context.timer.measure("output");
    write_solution_files(context, level, solution.state, memory);
    const auto entry = cycle_entry(context.settings, model, solution);
    record.add(entry, solution, is_asked);
    context.result.findings["lco"] = record.asked();
    if (is_asked) print_cycle(context, entry);
  }

  SolveStatus end(SolveStatus status, const std::string& why) const {
    context.result.message = why;
    return status;
  }
  SolveStatus end_well() const {
    const std::size_t count = record.asked().size();
    return end(SolveStatus::converged, counted(count, "limit cycle"));
  }
};

std::string where_it_ended(const CycleBranch& branch) {
  return fmt::format("the branch ends at E_0 = {:.3e}, V = {:.6f}", branch.energy(),
                     branch.reduced_velocity());
}

// Why a step along the branch gave no cycle, and what to do.
SolveStatus end_at(const LcoRun& run, const CycleBranch& branch, BranchStep step, const std::string& target) {
  if (step == BranchStep::interrupted)
    return run.end(SolveStatus::interrupted,
                   fmt::format("stopped by a signal or --walltime before {}; continue with --restart "
                               "and this folder",
                               target));
  return run.end(
      SolveStatus::stalled,
      fmt::format("{} was not reached: {}: {}; the cycles so far are in lco.csv. A finer mesh, other "
                  "time.harmonics or lco.harmonic_share may carry it on; solver.method = staggered "
                  "is another way",
                  target, where_it_ended(branch), branch.why()));
}

// Follows the branch over the energies in the order given and meets the speed asked for where it lies on the
// way, else beyond.
class BranchWalk {
 public:
  BranchWalk(const LcoRun& run, CycleBranch& branch)
      : run_(run),
        branch_(branch),
        is_speed_met_(lco().reduced_velocity && run.record.has_speed(*lco().reduced_velocity)) {}

  // Both go on while there is no status to end with.
  std::optional<SolveStatus> to_energy(double energy) {
    while (true) {
      const BranchStep step = branch_.advance_to_energy(energy);
      if (is_end(step)) return end_at(run_, branch_, step, fmt::format("E_0 = {:g}", energy));
      save(step == BranchStep::reached);
      if (const auto ended = meet_speed()) return ended;
      if (step == BranchStep::reached) return std::nullopt;
    }
  }

  SolveStatus to_speed() {
    while (seeks_speed() && branch_.energy() < lco().max_energy) {
      const BranchStep step = branch_.advance_to_speed(*lco().reduced_velocity);
      if (is_end(step)) return end_at(run_, branch_, step, fmt::format("V = {:g}", *lco().reduced_velocity));
      save(step == BranchStep::reached);
      is_speed_met_ = is_speed_met_ || step == BranchStep::reached;
      if (const auto ended = meet_speed()) return *ended;
    }
    if (!lco().reduced_velocity || is_speed_met_) return run_.end_well();
    return run_.end(
        SolveStatus::stalled,
        fmt::format("no cycle was found at lco.reduced_velocity = {:g} up to lco.max_energy = {:g}: "
                    "{}; lco.csv shows which speeds the branch has",
                    *lco().reduced_velocity, lco().max_energy, where_it_ended(branch_)));
  }

 private:
  const LcoSettings& lco() const { return run_.context.settings.lco; }
  static bool is_end(BranchStep step) {
    return step == BranchStep::failed || step == BranchStep::interrupted;
  }
  bool seeks_speed() const { return lco().reduced_velocity && (!is_speed_met_ || lco().all_crossings); }
  void save(bool is_asked) { run_.save(branch_.solution(), is_asked, branch_.memory()); }

  std::optional<SolveStatus> meet_speed() {
    while (seeks_speed()) {
      const auto step = branch_.look_back_for_speed(*lco().reduced_velocity);
      if (!step) break;
      if (is_end(*step))
        return end_at(run_, branch_, *step, fmt::format("V = {:g}", *lco().reduced_velocity));
      save(true);
      is_speed_met_ = true;
    }
    return std::nullopt;
  }

  const LcoRun& run_;
  CycleBranch& branch_;
  bool is_speed_met_;
};

SolveStatus follow_branch(const LcoRun& run, CycleSolver& solver, const CycleStart& start,
                          const std::vector<double>& energies, double first_energy) {
  const LcoSettings& lco = run.context.settings.lco;
  double largest = lco.reduced_velocity ? lco.max_energy : first_energy;
  for (double energy : energies) largest = std::max(largest, energy);
  CycleBranch branch(run.context, run.model, solver, start, largest);
  const SolveStatus begun = branch.begin(first_energy);
  run.save(branch.solution(),
           std::ranges::any_of(energies,
                               [&](double energy) { return CycleRecord::is_same(energy, first_energy); }),
           branch.memory());
  if (begun != SolveStatus::converged)
    return run.end(begun, cycle_advice(run.context.settings, branch.solution()));

  BranchWalk walk(run, branch);
  for (double energy : energies) {
    if (run.record.has_energy(energy)) continue;
    if (const auto ended = walk.to_energy(energy)) return *ended;
  }
  return walk.to_speed();
}

// By turns each cycle starts from the last one, scaled.
SolveStatus solve_list(const LcoRun& run, CycleSolver& solver, CycleStart start,
                       const std::vector<double>& energies, double first_energy) {
  const CaseSettings& settings = run.context.settings;
  std::vector<CycleAmplitude> list;
  for (double energy : energies) list.push_back(GivenEnergy{energy});
  if (const auto& v = settings.lco.reduced_velocity)
    list.push_back(GivenSpeed{*v, energies.empty() ? first_energy : energies.back()});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string stage = fmt::format("cycle {}", i + 1);
    if (const auto* given = std::get_if<GivenEnergy>(&list[i])) {
      if (run.record.has_energy(given->energy)) continue;
      if (!run.context.checkpoints.remembers(turns_stage(stage)))
        start = solver.grown(start.state, start.rest, given->energy);
    }
    const CycleSolution solution = solver.solve(stage, start, list[i]);
    run.save(solution, true, solution.memory);
    if (solution.status != SolveStatus::converged) {
      std::string why = cycle_advice(settings, solution);
      const double energy = fluctuating_energy(run.model, solution.state.y);
      const auto* given = std::get_if<GivenSpeed>(&list[i]);
      // At a speed that has no cycle the energy of the search vanishes.
      if (given && solution.status != SolveStatus::interrupted && energy < 1e-3 * given->initial_energy)
        why = fmt::format(
            "no cycle was found at lco.reduced_velocity = {:g}; see the V of some lco.energies, "
            "since the branch may not reach that speed, and start from the nearest",
            given->reduced_velocity);
      return run.end(solution.status, fmt::format("cycle {} of {}: {}", i + 1, list.size(), why));
    }
    start.state = solution.state;
  }
  return run.end_well();
}

}  // namespace

std::vector<std::string> lco_faults(const CaseSettings& settings) {
  if (!settings.lco.all_energies().empty() || settings.lco.reduced_velocity) return {};
  return {
      "lco.energies: no cycle is asked for; give this key (a list of E_0), lco.energy_range or "
      "lco.reduced_velocity"};
}

SolveStatus run_lco(Context& context) {
  const CaseSettings& settings = context.settings;
  const StructureModel model = structure_model(typical_section(settings.structure));
  CycleRecord record(context);
  record.resume();
  context.result.findings["lco"] = record.asked();
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(context.comm, settings.mesh));
  FlowLevel<2>& level = *levels.back();
  History history(context);
  CycleSolver solver(context, level, model, history);

  // A branch begins small, where linear flutter is a good start.
  const std::vector<double> energies = settings.lco.all_energies();
  double first_energy = settings.flutter.energy;
  if (!energies.empty())
    first_energy =
        settings.solver.is_staggered() ? energies.front() : std::min(first_energy, energies.front());
  const CycleApproach approach = approach_cycle(context, levels, model, solver, first_energy, history);
  if (!approach.start) return approach.status;
  if (context.restart) first_energy = fluctuating_energy(model, approach.start->state.y);

  const LcoRun run{context, level, model, history, record};
  if (settings.solver.is_staggered()) return solve_list(run, solver, *approach.start, energies, first_energy);
  return follow_branch(run, solver, *approach.start, energies, first_energy);
}

}  // namespace wingbeat
