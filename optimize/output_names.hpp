#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wingbeat {

// The analysis that gives an output.
enum class OutputSource {
  steady,           // flow at the case's angle of attack or lift
  flutter,          // flutter point at flutter.energy
  cycle_of_energy,  // limit cycles at lco.energies
  cycle_of_speed,   // limit cycle at lco.reduced_velocity
  onset,            // cycles near the flutter boundary
  geometry          // the wall alone
};

// Which way an output is optimised where its name stands alone.
enum class NaturalSense { maximize, minimize, none };

struct OutputInfo {
  std::string name;
  std::string unit;  // empty: dimensionless
  NaturalSense sense = NaturalSense::none;
  OutputSource source = OutputSource::steady;
  std::string help;
};

// All outputs that objectives and constraints may name.
std::span<const OutputInfo> optimization_outputs();
std::vector<std::string> output_names();
// Null where there is none of that name.
const OutputInfo* find_output(std::string_view name);
// The sentence that answers a name that is not an output's, with the nearest and all others.
std::string unknown_output(std::string_view name);

}  // namespace wingbeat
