#include "optimize/output_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/io/nearest_name.hpp"

namespace wingbeat {

std::span<const OutputInfo> optimization_outputs() {
  using enum NaturalSense;
  using enum OutputSource;
  static const std::vector<OutputInfo> outputs{
      {"drag", "", minimize, steady, "C_D of steady flow"},
      {"lift", "", maximize, steady, "C_L of steady flow"},
      {"moment", "", none, steady, "C_m of steady flow about the elastic axis, nose-up"},
      {"flutter_speed", "", maximize, flutter, "V at flutter.energy, the lowest root"},
      {"flutter_frequency", "omega_alpha", none, flutter, "omega at flutter.energy"},
      {"lco_speed", "", maximize, cycle_of_energy, "V of the cycle of the one energy lco.energies"},
      {"lco_frequency", "omega_alpha", none, cycle_of_energy,
       "omega of the cycle of the one energy lco.energies"},
      {"least_lco_speed", "", maximize, cycle_of_energy,
       "smooth minimum of V over the cycles of lco.energies"},
      {"lco_amplitude", "deg", minimize, cycle_of_speed,
       "first harmonic of pitch of the cycle at lco.reduced_velocity"},
      {"lco_energy", "m b^2 omega_alpha^2", minimize, cycle_of_speed,
       "E_0 of the cycle at lco.reduced_velocity"},
      {"onset_slope", "1/(m b^2 omega_alpha^2)", none, onset,
       "dV/dE_0 near the flutter boundary, by differences of cycles; negative: subcritical"},
      {"area", "chords^2", none, geometry, "area of the section"},
      {"thickness", "chords", none, geometry, "greatest thickness of the section"},
      {"leading_edge_radius", "chords", none, geometry, "radius of curvature at the leading edge"}};
  return outputs;
}

std::vector<std::string> output_names() {
  std::vector<std::string> names;
  for (const OutputInfo& output : optimization_outputs()) names.push_back(output.name);
  return names;
}

const OutputInfo* find_output(std::string_view name) {
  const auto outputs = optimization_outputs();
  const auto found = std::ranges::find(outputs, name, &OutputInfo::name);
  return found == outputs.end() ? nullptr : &*found;
}

std::string unknown_output(std::string_view name) {
  const std::vector<std::string> names = output_names();
  const std::string nearest = nearest_name(name, names);
  return fmt::format("no output \"{}\"; {}outputs are {}", name,
                     nearest.empty() ? "" : fmt::format("the nearest is \"{}\"; ", nearest),
                     fmt::join(names, ", "));
}

}  // namespace wingbeat
