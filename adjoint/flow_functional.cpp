#include "adjoint/flow_functional.hpp"

#include "flow/flow_sensitivity.hpp"
#include "flow/flow_tangent.hpp"

namespace wingbeat {

template <int Dim>
FlowFunctional<Dim>::FlowFunctional(FlowEquations<Dim>& flow, const Problem& problem, const FlowPoint& at,
                                    LoadFunctional objective)
    : flow_(flow),
      problem_(problem),
      at_(at),
      objective_(std::move(objective)),
      loads_(flow.loads(at.w, at.motions)) {}

template <int Dim>
std::vector<double> FlowFunctional<Dim>::by_state() const {
  std::vector<double> result;
  result.reserve(flow_.state_count());
  for (std::size_t n = 0; n < flow_.instance_count(); ++n) {
    const LoadGradients& by = flow_.load_gradients(n);
    const Loads<double>& weight = objective_.weights[n];
    for (std::size_t i = 0; i < by.force_x.size(); ++i)
      result.push_back(weight.force_x * by.force_x[i] + weight.force_y * by.force_y[i] +
                       weight.moment * by.moment[i]);
  }
  return result;
}

template <int Dim>
InputTangent FlowFunctional<Dim>::tangent(const Inputs<Dim>& change) const {
  FlowTangent flow = flow_tangent<Dim>(flow_, at_, change.flow);
  const double by_loads = load_dot(objective_.weights, flow.loads);
  return {std::move(flow.residual), by_loads + change.flow.angle * load_dot(objective_.by_angle, loads_) +
                                        change.axis[0] * load_dot(objective_.by_axis[0], loads_) +
                                        change.axis[1] * load_dot(objective_.by_axis[1], loads_)};
}

template <int Dim>
Inputs<Dim> FlowFunctional<Dim>::sensitivity(std::span<const double> multipliers) const {
  Inputs<Dim> result(flow_sensitivity<Dim>(flow_, at_, multipliers, objective_.weights));
  result.flow.angle += load_dot(objective_.by_angle, loads_);
  for (int k = 0; k < 2; ++k)
    result.axis[k] = load_dot(objective_.by_axis[static_cast<std::size_t>(k)], loads_);
  return result;
}

template class FlowFunctional<2>;
template class FlowFunctional<3>;

}  // namespace wingbeat
