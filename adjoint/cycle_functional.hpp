#pragma once

#include "adjoint/functional.hpp"
#include "adjoint/section_derivatives.hpp"
#include "structure/aeroelastic_problem.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat {

enum class CycleQuantity {
  speed,      // reduced velocity V
  frequency,  // omega
  energy,     // E_fl
  amplitude   // |first harmonic of pitch|, degrees
};

// A number of a flutter point or limit cycle: F = (R, S, Y, E), of given energy or given speed.
template <int Dim>
class CycleFunctional final : public Functional<Dim> {
 public:
  // `problem` is linearized at its solution `state`; it is kept by reference.
  CycleFunctional(AeroelasticProblem<Dim>& problem, const TypicalSection& section, AeroelasticState state,
                  CycleQuantity quantity);

  const Comm& comm() const override { return problem_.flow().domain().comm(); }
  const Problem& problem() const override { return problem_; }
  FlowPoint point() const override { return {state_.w, motions_, kappa_}; }
  double value() const override;
  std::vector<double> by_state() const override;
  InputTangent tangent(const Inputs<Dim>& change) const override;
  Inputs<Dim> sensitivity(std::span<const double> multipliers) const override;

 private:
  double reduced_velocity() const { return problem_.kinematics().reduced_velocity(state_.r); }
  double load() const { return problem_.structure().model().load(reduced_velocity()); }

  AeroelasticProblem<Dim>& problem_;
  AeroelasticState state_;
  CycleQuantity quantity_;
  std::vector<MotionState> motions_;
  double kappa_;
  // Of each parameter of the section, at the solution: dS, and d E_fl.
  std::array<std::vector<double>, section_scalar_count> structure_by_;
  std::array<double, section_scalar_count> energy_by_;
};

}  // namespace wingbeat
