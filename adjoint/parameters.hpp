#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "flow/flow_inputs.hpp"

namespace wingbeat {

// Parameters that are single numbers.
enum class Scalar {
  mach,
  angle_of_attack,          // degrees
  elastic_axis,             // a, semichords
  static_unbalance,         // x_alpha
  gyration_radius_squared,  // r_alpha^2
  frequency_ratio,          // omega_h/omega_alpha
  mass_ratio                // mu
};
inline constexpr std::array scalar_names{"mach",
                                         "angle_of_attack_deg",
                                         "elastic_axis",
                                         "static_unbalance",
                                         "gyration_radius_squared",
                                         "frequency_ratio",
                                         "mass_ratio"};
inline constexpr std::size_t scalar_count = scalar_names.size();
// Those that only the structure reads, counted from the first of them.
inline constexpr std::size_t first_section_scalar = static_cast<std::size_t>(Scalar::static_unbalance);
inline constexpr std::size_t section_scalar_count = scalar_count - first_section_scalar;

// All that a gradient can be taken with respect to, as a change of it or as sensitivities to it.
template <int Dim>
struct Parameters {
  std::vector<Vec<double, Dim>> nodes;  // [local node], see LocalNodes
  std::array<double, scalar_count> scalars{};

  double& operator[](Scalar s) { return scalars[static_cast<std::size_t>(s)]; }
  double operator[](Scalar s) const { return scalars[static_cast<std::size_t>(s)]; }
};

// What the equations and objectives read of the parameters, as a change of it or as sensitivities to it.
template <int Dim>
struct Inputs {
  FlowInputs<Dim> flow;
  Vec<double, 2> axis{};  // of rotation, chords: where it is read beside the moments of the faces
  std::array<double, section_scalar_count> section{};

  explicit Inputs(FlowInputs<Dim> flow_inputs) : flow(std::move(flow_inputs)) {}
};

}  // namespace wingbeat
