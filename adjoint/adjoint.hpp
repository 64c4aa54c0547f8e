#pragma once

#include "adjoint/functional.hpp"
#include "adjoint/parameter_map.hpp"

namespace wingbeat {

struct AdjointSolution {
  std::vector<double> multipliers;  // lambda, in the layout of the problem
  GmresResult solve;
};

// (dF/du)^T lambda = -(dJ/du)^T by GMRES with the problem's own operators, transposed (eq:adjoint).
// Collective.
AdjointSolution solve_adjoint(const Comm& comm, const Problem& problem, std::span<const double> by_state,
                              const GmresOptions& options);

struct TangentSolution {
  std::vector<double> state;  // du
  GmresResult solve;
};

// (dF/du) du = -dF. Collective.
TangentSolution solve_tangent(const Comm& comm, const Problem& problem, std::span<const double> rows,
                              const GmresOptions& options);

// dJ/dp of a solution of the adjoint, with respect to all parameters (eq:total-derivative).
template <int Dim>
Parameters<Dim> total_derivative(const Functional<Dim>& functional, const ParameterPoint<Dim>& point,
                                 const AdjointSolution& adjoint) {
  return parameter_sensitivity(point, functional.sensitivity(adjoint.multipliers));
}

// The change of J with a change of the parameters, by one tangent solve.
struct DirectionalDerivative {
  double value = 0.0;
  GmresResult solve;
};
template <int Dim>
DirectionalDerivative directional_derivative(const Functional<Dim>& functional,
                                             const ParameterPoint<Dim>& point, const Parameters<Dim>& change,
                                             const GmresOptions& options);

}  // namespace wingbeat
