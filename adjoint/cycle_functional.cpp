#include "adjoint/cycle_functional.hpp"

#include <cmath>
#include <numbers>

#include "core/algebra/krylov_kernels.hpp"
#include "flow/flow_sensitivity.hpp"
#include "flow/flow_tangent.hpp"
#include "structure/energy.hpp"

namespace wingbeat {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

// Sine and cosine of the first harmonic of pitch.
std::array<HarmonicCondition, 2> first_harmonic(const StructuralEquation& structure) {
  const StructureModel& model = structure.model();
  HarmonicCondition sine = first_harmonic_condition(model, structure.time(), pitch_mode, 1.0);
  HarmonicCondition cosine = phase_condition(model, structure.time());
  sine.offset = 0.0;
  return {sine, cosine};
}

}  // namespace

template <int Dim>
CycleFunctional<Dim>::CycleFunctional(AeroelasticProblem<Dim>& problem, const TypicalSection& section,
                                      AeroelasticState state, CycleQuantity quantity)
    : problem_(problem),
      state_(std::move(state)),
      quantity_(quantity),
      motions_(problem.motions(state_)),
      kappa_(problem.kinematics().kappa(state_.omega, state_.r)) {
  const std::vector<double> f = problem_.forces(state_);
  for (std::size_t k = 0; k < section_scalar_count; ++k) {
    const ModelChange change = section_derivative(section, k);
    structure_by_[k] = structure_tangent(problem_.structure(), state_.y, reduced_velocity(), f, change);
    energy_by_[k] = fluctuating_energy_change(change, state_.y);
  }
}

template <int Dim>
double CycleFunctional<Dim>::value() const {
  switch (quantity_) {
    case CycleQuantity::speed:
      return reduced_velocity();
    case CycleQuantity::frequency:
      return state_.omega;
    case CycleQuantity::energy:
      return fluctuating_energy(problem_.structure().model(), state_.y);
    case CycleQuantity::amplitude:
      break;
  }
  const auto [sine, cosine] = first_harmonic(problem_.structure());
  return degrees * std::hypot(wingbeat::value(AmplitudeCondition(sine), state_.y),
                              wingbeat::value(AmplitudeCondition(cosine), state_.y));
}

template <int Dim>
std::vector<double> CycleFunctional<Dim>::by_state() const {
  AeroelasticState by{std::vector<double>(state_.w.size(), 0.0), std::vector<double>(state_.y.size(), 0.0),
                      0.0, 0.0};
  switch (quantity_) {
    case CycleQuantity::speed:
      by.r = reduced_velocity() / (2.0 * state_.r);
      break;
    case CycleQuantity::frequency:
      by.omega = 1.0;
      break;
    case CycleQuantity::energy:
      add_fluctuating_energy_gradient(problem_.structure().model(), state_.y, 1.0, by.y);
      break;
    case CycleQuantity::amplitude: {
      const double size = value() / degrees;
      for (const AmplitudeCondition part : first_harmonic(problem_.structure()))
        add_gradient(part, state_.y, degrees * wingbeat::value(part, state_.y) / size, by.y);
      break;
    }
  }
  return problem_.by_unknowns(by);
}

template <int Dim>
InputTangent CycleFunctional<Dim>::tangent(const Inputs<Dim>& change) const {
  const FlowTangent flow = flow_tangent<Dim>(problem_.flow(), point(), change.flow);
  std::vector<double> f;
  for (const Loads<double>& loads : flow.loads) f.insert(f.end(), {-loads.force_y, 2.0 * loads.moment});
  std::vector<double> structure(state_.y.size(), 0.0);
  problem_.structure().add_force_tangent(load(), f, 1.0, structure);
  double energy = 0.0;
  for (std::size_t k = 0; k < section_scalar_count; ++k) {
    energy += change.section[k] * energy_by_[k];
    for (std::size_t i = 0; i < structure.size(); ++i)
      structure[i] += change.section[k] * structure_by_[k][i];
  }
  const CycleCondition& cycle = *problem_.cycle();
  return {problem_.rows(flow.residual, structure, cycle.by_energy * energy / cycle.energy.energy),
          quantity_ == CycleQuantity::energy ? energy : 0.0};
}

template <int Dim>
Inputs<Dim> CycleFunctional<Dim>::sensitivity(std::span<const double> multipliers) const {
  const AeroelasticMultipliers lambda = problem_.multipliers(multipliers);
  std::vector<double> by_force(problem_.structure().force_size(), 0.0);
  problem_.structure().add_force_adjoint(load(), lambda.structure, 1.0, by_force);
  std::vector<Loads<double>> weights;
  for (std::size_t j = 0; j < by_force.size(); j += 2)
    weights.push_back({0.0, -by_force[j], 2.0 * by_force[j + 1]});
  Inputs<Dim> result(flow_sensitivity<Dim>(problem_.flow(), point(), lambda.flow, weights));
  const CycleCondition& cycle = *problem_.cycle();
  const double by_energy =
      lambda.cycle * cycle.by_energy / cycle.energy.energy + (quantity_ == CycleQuantity::energy ? 1.0 : 0.0);
  for (std::size_t k = 0; k < section_scalar_count; ++k)
    result.section[k] = local_dot(lambda.structure, structure_by_[k]) + by_energy * energy_by_[k];
  return result;
}

template class CycleFunctional<2>;
template class CycleFunctional<3>;

}  // namespace wingbeat
