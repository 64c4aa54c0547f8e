#include "adjoint/parameter_map.hpp"

#include <algorithm>
#include <numbers>

#include "adjoint/geometry_map.hpp"

namespace wingbeat {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double semichord = 0.5;  // in chords

}  // namespace

template <int Dim>
Inputs<Dim> input_change(const ParameterPoint<Dim>& point, const Parameters<Dim>& change) {
  Inputs<Dim> inputs{FlowInputs<Dim>(point.flow)};
  const FlowDomain<Dim>& domain = point.flow.domain();
  if (point.turns_about_elastic_axis) inputs.axis[0] = semichord * change[Scalar::elastic_axis];
  for (std::size_t b = 0; b < domain.blocks().size(); ++b)
    inputs.flow.geometry[b] =
        geometry_change<Dim>(point.mesh.blocks[b], point.nodes.blocks[b], domain.blocks()[b].geometry,
                             domain.axis(), change.nodes, inputs.axis);
  inputs.flow.mach = change[Scalar::mach];
  inputs.flow.angle = degree * change[Scalar::angle_of_attack];
  const double faster = change[Scalar::mach] / point.flow.model().freestream.mach;
  inputs.flow.kappa = faster * point.at.kappa;
  for (std::size_t n = 0; n < point.at.motions.size(); ++n)
    inputs.flow.motions[n] = {0.0, faster * point.at.motions[n].pitch_rate,
                              faster * point.at.motions[n].plunge_rate};
  std::copy_n(change.scalars.begin() + first_section_scalar, section_scalar_count, inputs.section.begin());
  return inputs;
}

template <int Dim>
Parameters<Dim> parameter_sensitivity(const ParameterPoint<Dim>& point, const Inputs<Dim>& sensitivity) {
  const FlowDomain<Dim>& domain = point.flow.domain();
  const FlowInputs<Dim>& flow = sensitivity.flow;
  Parameters<Dim> result;
  result.nodes.resize(point.nodes.numbers.size());
  Vec<double, 2> by_axis{};
  for (std::size_t b = 0; b < domain.blocks().size(); ++b)
    by_axis +=
        add_node_sensitivity<Dim>(point.mesh.blocks[b], point.nodes.blocks[b], domain.blocks()[b].geometry,
                                  domain.axis(), flow.geometry[b], result.nodes);
  if (point.turns_about_elastic_axis)
    result[Scalar::elastic_axis] = semichord * (domain.comm().sum(by_axis[0]) + sensitivity.axis[0]);
  double by_rates = flow.kappa * point.at.kappa;
  for (std::size_t n = 0; n < point.at.motions.size(); ++n)
    by_rates += flow.motions[n].pitch_rate * point.at.motions[n].pitch_rate +
                flow.motions[n].plunge_rate * point.at.motions[n].plunge_rate;
  result[Scalar::mach] = flow.mach + by_rates / point.flow.model().freestream.mach;
  result[Scalar::angle_of_attack] = degree * flow.angle;
  std::copy(sensitivity.section.begin(), sensitivity.section.end(),
            result.scalars.begin() + first_section_scalar);
  return result;
}

template Inputs<2> input_change<2>(const ParameterPoint<2>&, const Parameters<2>&);
template Inputs<3> input_change<3>(const ParameterPoint<3>&, const Parameters<3>&);
template Parameters<2> parameter_sensitivity<2>(const ParameterPoint<2>&, const Inputs<2>&);
template Parameters<3> parameter_sensitivity<3>(const ParameterPoint<3>&, const Inputs<3>&);

}  // namespace wingbeat
