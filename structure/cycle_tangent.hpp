#pragma once

#include "core/algebra/gmres.hpp"
#include "structure/aeroelastic_problem.hpp"

namespace wingbeat {

// How a cycle changes along its branch, at a solution (eq:branch-slope).
struct CycleTangent {
  double velocity_slope = 0.0;   // dV/dE_fl
  double frequency_slope = 0.0;  // d omega/dE_fl
  GmresStatus status = GmresStatus::converged;
  int linear_iterations = 0;

  // True where greater cycles need a greater speed: from its onset such a branch is stable.
  bool is_supercritical() const { return velocity_slope > 0.0; }
};

// One linear solve with the problem's Jacobian and preconditioner: J t = e, e the cycle's row.
// Linearizes the problem at u, a solution. Collective.
template <int Dim>
CycleTangent cycle_tangent(const Comm& comm, AeroelasticProblem<Dim>& problem, const StructureModel& model,
                           const SectionKinematics& kinematics, std::span<const double> u,
                           const GmresOptions& options);

}  // namespace wingbeat
