#include <cmath>
#include <numbers>

#include "apps/advice.hpp"
#include "apps/cycle_solver.hpp"
#include "apps/flow_setup.hpp"
#include "apps/linear_flutter_output.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"

namespace wingbeat {

nlohmann::ordered_json cycle_entry(const CaseSettings& settings, const StructureModel& model,
                                   const CycleSolution& solution) {
  const AeroelasticState& state = solution.state;
  const double v = section_kinematics(settings).reduced_velocity(state.r);
  const TimeSpectral time = time_of(state);
  const Eigen::VectorXcd u = first_harmonic(model, time, state.y);
  auto entry = flutter_point(settings, v, state.omega);
  entry["freestream_parameter"] = state.r;
  entry["energy"] = fluctuating_energy(model, state.y);
  entry["average_energy"] = average_energy(model, state.y);
  entry["pitch_amplitude_deg"] = std::abs(u[pitch_mode]) * 180.0 / std::numbers::pi;
  entry["plunge_amplitude"] = std::abs(u[plunge_mode]);
  entry["harmonics"] = time.harmonics();
  entry["highest_harmonic_share"] = highest_harmonic_share(model, time, state.y);
  if (solution.tangent) {
    entry["velocity_slope"] = solution.tangent->velocity_slope;
    entry["frequency_slope"] = solution.tangent->frequency_slope;
    entry["supercritical"] = solution.tangent->is_supercritical();
  }
  entry["status"] = to_string(solution.status);
  const AeroelasticResiduals& residuals = solution.residuals;
  entry["residuals"] = {{"flow", residuals.flow},
                        {"structure", residuals.structure},
                        {"phase", residuals.phase},
                        {"energy", residuals.energy}};
  entry["newton_iterations"] = solution.newton_iterations;
  entry["linear_iterations"] = solution.linear_iterations;
  entry["factorizations"] = solution.factorizations;
  entry["factor_megabytes"] = 1e-6 * solution.factor_bytes;
  entry["staggered_iterations"] = solution.staggered_iterations;
  entry["flow_cycles"] = solution.flow_cycles;
  return entry;
}

void print_cycle(Context& context, const nlohmann::ordered_json& entry) {
  const auto number = [&](const char* key) { return entry[key].get<double>(); };
  const auto count = [&](const char* key) { return entry[key].get<int>(); };
  const auto residual = [&](const char* key) { return entry["residuals"][key].get<double>(); };
  Log& log = context.log;
  log.line("\n{:<34}{:.8f}", "reduced velocity V = U/(c w_a)", number("reduced_velocity"));
  log.line("{:<34}{:.8f}", "speed index 2V/sqrt(mu)", number("speed_index"));
  log.line("{:<34}{:.8f}", "frequency ratio omega/w_a", number("frequency_ratio"));
  log.line("{:<34}{:.8f}", "reduced frequency k", number("reduced_frequency"));
  log.line("{:<34}{:.6f} deg, plunge {:.3e} semichords", "pitch amplitude", number("pitch_amplitude_deg"),
           number("plunge_amplitude"));
  if (entry.contains("velocity_slope"))
    log.line("{:<34}{:+.4f}: {}", "dV/dE_0 along the branch", number("velocity_slope"),
             entry["supercritical"].get<bool>() ? "greater cycles need greater speed (supercritical)"
                                                : "greater cycles at lower speed (subcritical)");
  if (count("harmonics") > 1)
    log.line("{:<34}{}, the highest with {:.1e} of the energy", "harmonics", count("harmonics"),
             number("highest_harmonic_share"));
  log.line("{:<34}flow {:.1e}, structure {:.1e}, phase {:.1e}, energy {:.1e}", "residuals", residual("flow"),
           residual("structure"), residual("phase"), residual("energy"));
  if (count("flow_cycles") > 0)
    log.line("{:<34}{} structural steps, {} flow cycles", "staggered", count("staggered_iterations"),
             count("flow_cycles"));
  if (count("newton_iterations") > 0)
    log.line("{:<34}{} Newton, {} Krylov, {} new factorizations", "iterations", count("newton_iterations"),
             count("linear_iterations"), count("factorizations"));
  if (number("factor_megabytes") > 0.0)
    log.line("{:<34}{:.1f} MB on all ranks", "factors", number("factor_megabytes"));
  log.line("");
}

std::string cycle_advice(const CaseSettings& settings, const CycleSolution& solution) {
  const bool by_turns = settings.solver.is_staggered() && solution.newton_iterations == 0;
  return by_turns ? staggered_advice(solution.status, settings.staggered)
                  : coupled_advice(solution.status, settings.solver);
}

}  // namespace wingbeat
