#include "adjoint/gradient_settings.hpp"

#include <algorithm>

namespace wingbeat {

bool GradientSettings::has(const std::string& parameter) const {
  return std::ranges::find(parameters, parameter) != parameters.end();
}

bool GradientSettings::is_of_loads() const {
  return objective == "drag" || objective == "lift" || objective == "moment";
}

bool GradientSettings::is_of_given_speed() const {
  return objective == "lco_energy" || objective == "lco_amplitude";
}

void GradientSettings::describe(SettingSection& keys) {
  keys.add(
      "objective", &objective,
      {.help = "drag, lift, moment: of the flow named by analysis; flutter_speed (V), flutter_frequency "
               "(omega): at flutter.energy; lco_speed, lco_frequency: at the energy lco.energies; "
               "lco_amplitude (first harmonic of pitch, deg), lco_energy: at the speed "
               "lco.reduced_velocity; onset_slope: dV/dE_0 near the onset, by differences of three cycles",
       .allowed = {"drag", "lift", "moment", "flutter_speed", "flutter_frequency", "lco_speed",
                   "lco_frequency", "lco_amplitude", "lco_energy", "onset_slope"}});
  keys.add(
      "parameters", &parameters,
      {.help = "bumps: amplitudes of the shape variables (see design), in chords; mach; angle_of_attack, "
               "in degrees; structure: elastic axis, static unbalance, radius of gyration squared, "
               "frequency and mass ratio; nodes: every node of the mesh, to nodes.csv",
       .allowed = {"bumps", "mach", "angle_of_attack", "structure", "nodes"}});
  keys.add("analysis", &analysis,
           {.help = "flow that drag, lift and moment are of: steady, or pitch, in the prescribed motion",
            .allowed = {"steady", "pitch"}});
  keys.add("harmonic", &harmonic,
           {.help = "harmonic of the loads in prescribed motion; 0: the mean", .range = between(0, 100)});
  keys.add("part", &part,
           {.help = "part of that harmonic's amplitude f_h, f = Re sum f_h exp(i h theta)",
            .allowed = {"real", "imaginary"}});
  keys.add("fixed_lift", &fixed_lift,
           {.help = "steady drag or moment at the lift of the case, which the angle of attack is to hold"});
  keys.add("tolerance", &tolerance,
           {.help = "residual of the adjoint equations relative to the derivative of the objective",
            .range = open_interval(0, 1)});
  keys.add("onset_energy", &onset_energy,
           {.help = "E_0 of the first of three cycles, E_0, 2 E_0 and 3 E_0, whose speeds give onset_slope",
            .unit = "m b^2 omega_alpha^2",
            .range = above(0)});
  keys.add("difference_step", &difference_step,
           {.help = "with --check: step of the central differences, as a part of each parameter's scale "
                    "(bumps: design.bound)",
            .range = open_interval(0, 1)});
  keys.add(
      "max_differences", &max_differences,
      {.help = "with --check: parameters that are differenced one by one; of more, a random direction is",
       .range = between(0, 100000)});
}

}  // namespace wingbeat
