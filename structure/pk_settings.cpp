#include "structure/pk_settings.hpp"

#include <algorithm>
#include <functional>

namespace wingbeat {

std::vector<double> PkSettings::velocities() const {
  if (!reduced_velocities.empty()) return reduced_velocities;
  const auto [first, last] = reduced_velocity_range;
  std::vector<double> velocities;
  for (int i = 0; i < samples; ++i) velocities.push_back(first + (last - first) * i / (samples - 1));
  return velocities;
}

void PkSettings::describe(SettingSection& keys) {
  keys.add(
      "aerodynamics", &aerodynamics,
      {.help = "where Q(k) comes from: the linearised flow, forced motions of pitch.derivative_amplitude_deg "
               "by the time-spectral method, or pk.table_file",
       .allowed = {"linearized", "forced", "table"}});
  keys.add(
      "table_file", &table_file,
      {.help = "Q(k) as CSV: columns k, Q11_re, Q11_im, Q12_re, ... row by row; an aerodynamic_matrix.csv "
               "will do. Neither mesh nor flow is then needed",
       .path = PathRule::file});
  keys.add("reduced_velocities", &reduced_velocities,
           {.help = "V = U/(c omega_alpha) of the table, rising; empty: the range below", .range = above(0)});
  keys.add("reduced_velocity_range", &reduced_velocity_range,
           {.help = "V [first, last] of the table", .range = above(0)});
  keys.add("frequencies", &frequencies,
           {.help = "reduced frequencies at which Q(k) is computed, over flutter.reduced_frequency_range",
            .range = between(4, 1000)});
  keys.add("samples", &samples, {.help = "rows of the table over the range", .range = between(2, 100000)});
  keys.add_rule(
      "aerodynamics", [this] { return !reads_table() || table_file; }, "give the table as pk.table_file");
  keys.add_rule(
      "table_file", [this] { return reads_table() || !table_file; },
      "is read with pk.aerodynamics = \"table\" only");
  keys.add_rule(
      "reduced_velocities",
      [this] {
        return std::ranges::adjacent_find(reduced_velocities, std::greater_equal()) ==
               reduced_velocities.end();
      },
      "must rise, so that the branches can be followed");
  keys.add_rule(
      "reduced_velocity_range", [this] { return reduced_velocity_range[0] < reduced_velocity_range[1]; },
      "the first must be below the second");
}

}  // namespace wingbeat
