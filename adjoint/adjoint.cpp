#include "adjoint/adjoint.hpp"

#include "core/algebra/krylov_kernels.hpp"

namespace wingbeat {
namespace {

std::vector<double> negative(std::span<const double> x) {
  std::vector<double> result(x.begin(), x.end());
  for (double& value : result) value = -value;
  return result;
}

}  // namespace

AdjointSolution solve_adjoint(const Comm& comm, const Problem& problem, std::span<const double> by_state,
                              const GmresOptions& options) {
  AdjointSolution solution{std::vector<double>(by_state.size(), 0.0), {}};
  const std::vector<double> rhs = negative(by_state);
  solution.solve =
      gmres<double>(comm, TransposedOperator<double>(problem.jacobian()),
                    TransposedOperator<double>(problem.preconditioner()), rhs, solution.multipliers, options);
  return solution;
}

TangentSolution solve_tangent(const Comm& comm, const Problem& problem, std::span<const double> rows,
                              const GmresOptions& options) {
  TangentSolution solution{std::vector<double>(rows.size(), 0.0), {}};
  const std::vector<double> rhs = negative(rows);
  solution.solve =
      gmres<double>(comm, problem.jacobian(), problem.preconditioner(), rhs, solution.state, options);
  return solution;
}

template <int Dim>
DirectionalDerivative directional_derivative(const Functional<Dim>& functional,
                                             const ParameterPoint<Dim>& point, const Parameters<Dim>& change,
                                             const GmresOptions& options) {
  const InputTangent by_inputs = functional.tangent(input_change(point, change));
  const TangentSolution tangent =
      solve_tangent(functional.comm(), functional.problem(), by_inputs.rows, options);
  const std::vector<double> by_state = functional.by_state();
  return {by_inputs.objective + functional.comm().sum(local_dot(by_state, tangent.state)), tangent.solve};
}

template DirectionalDerivative directional_derivative<2>(const Functional<2>&, const ParameterPoint<2>&,
                                                         const Parameters<2>&, const GmresOptions&);
template DirectionalDerivative directional_derivative<3>(const Functional<3>&, const ParameterPoint<3>&,
                                                         const Parameters<3>&, const GmresOptions&);

}  // namespace wingbeat
