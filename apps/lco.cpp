#include <fmt/format.h>

#include "apps/case_mesh.hpp"
#include "apps/cycle_stage.hpp"
#include "apps/flow_setup.hpp"
#include "apps/on_root.hpp"
#include "apps/solution_output.hpp"
#include "apps/verbs.hpp"
#include "core/io/csv.hpp"

namespace wingbeat {
namespace {

// The cycles to compute: those of given energy in the order given, then that of given speed.
std::vector<CycleAmplitude> amplitudes(const CaseSettings& settings) {
  std::vector<CycleAmplitude> list;
  for (double energy : settings.lco.energies) list.push_back(GivenEnergy{energy});
  if (const auto& v = settings.lco.reduced_velocity) {
    const auto& energies = settings.lco.energies;
    list.push_back(GivenSpeed{*v, energies.empty() ? settings.flutter.energy : energies.back()});
  }
  return list;
}

double first_energy(const CycleAmplitude& amplitude) {
  if (const auto* given = std::get_if<GivenEnergy>(&amplitude)) return given->energy;
  return std::get<GivenSpeed>(amplitude).initial_energy;
}

// What to do about a cycle that was not found. At the speed given there may be none: the energy of the
// search then vanishes.
std::string advice(const CaseSettings& settings, const CycleAmplitude& amplitude,
                   const CycleSolution& solution, double energy) {
  const auto* given = std::get_if<GivenSpeed>(&amplitude);
  const bool has_vanished = given && energy < 1e-3 * given->initial_energy;
  if (solution.status == SolveStatus::interrupted || !(solution.is_search_exhausted || has_vanished))
    return cycle_advice(settings, solution);
  return fmt::format(
      "no cycle was found at lco.reduced_velocity = {:g}; the last one tried has V = {:.6f} at E_0 = {:.1e}; "
      "see the V of some lco.energies, since the branch may not reach that speed, and start from the nearest",
      given->reduced_velocity, section_kinematics(settings).reduced_velocity(solution.state.r), energy);
}

void write_table(Context& context, const nlohmann::ordered_json& cycles) {
  CsvTable table({"energy", "reduced_velocity", "frequency_ratio", "pitch_amplitude_deg", "plunge_amplitude",
                  "flow_residual", "structure_residual"});
  for (const auto& entry : cycles)
    table.add(std::vector<double>{
        entry["energy"].get<double>(), entry["reduced_velocity"].get<double>(),
        entry["frequency_ratio"].get<double>(), entry["pitch_amplitude_deg"].get<double>(),
        entry["plunge_amplitude"].get<double>(), entry["residuals"]["flow"].get<double>(),
        entry["residuals"]["structure"].get<double>()});
  on_root(context.comm, [&] { table.write(context.output / "lco.csv"); });
}

}  // namespace

std::vector<std::string> lco_faults(const CaseSettings& settings) {
  if (!settings.lco.energies.empty() || settings.lco.reduced_velocity) return {};
  return {"lco.energies: no cycle is asked for; give this key (a list of E_0) or lco.reduced_velocity"};
}

SolveStatus run_lco(Context& context) {
  const CaseSettings& settings = context.settings;
  const StructureModel model = structure_model(typical_section(settings.structure));
  const std::vector<CycleAmplitude> list = amplitudes(settings);
  FlowLevels<2> levels = make_levels<2>(context, make_plane_mesh(settings.mesh));
  FlowLevel<2>& level = *levels.back();
  History history(context);
  CycleSolver solver(context, level, model, history);
  const CycleApproach approach =
      approach_cycle(context, levels, model, solver, first_energy(list.front()), history);
  if (!approach.start) return approach.status;

  CycleStart start = *approach.start;
  auto& cycles = context.result.findings["lco"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const CycleSolution solution = solver.solve(fmt::format("cycle {}", i + 1), start, list[i]);
    history.write();
    const auto part = context.timer.measure("output");
    write_solution_files(context, level, solution.state);
    cycles.push_back(cycle_entry(settings, model, solution));
    print_cycle(context, cycles.back());
    write_table(context, cycles);
    if (solution.status != SolveStatus::converged) {
      context.result.message =
          fmt::format("cycle {} of {}: {}", i + 1, list.size(),
                      advice(settings, list[i], solution, cycles.back()["energy"].get<double>()));
      return solution.status;
    }
    if (i + 1 < list.size()) start = solver.grown(solution.state, start.rest, first_energy(list[i + 1]));
  }
  context.result.message = fmt::format("{} limit cycles", list.size());
  return SolveStatus::converged;
}

}  // namespace wingbeat
