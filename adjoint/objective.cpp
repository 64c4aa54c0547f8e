#include "adjoint/objective.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

// Solutions within this of the tolerance are as good as round-off lets them be.
constexpr double near = 1e3;
constexpr int fair_try = 60;  // Krylov iterations

}  // namespace

template <int Dim>
void Objective<Dim>::solve(const Parameters<Dim>& change) {
  for (const Term& term : terms) term.analysis->solve(change);
}

template <int Dim>
void Objective<Dim>::keep() {
  for (const Term& term : terms) term.analysis->keep();
}

template <int Dim>
double Objective<Dim>::value() const {
  double sum = 0.0;
  for (const Term& term : terms) sum += term.weight * term.analysis->functional().value();
  return sum;
}

template <int Dim>
std::vector<double> Objective<Dim>::weights() const {
  std::vector<double> result;
  for (const Term& term : terms) result.push_back(term.weight);
  return result;
}

int AdjointSolutions::iterations() const {
  int sum = 0;
  for (const auto& term : terms) sum += term.solve.iterations;
  return sum;
}

double AdjointSolutions::relative_residual() const {
  double worst = 0.0;
  for (const auto& term : terms) worst = std::max(worst, term.solve.relative_residual);
  return worst;
}

GmresStatus AdjointSolutions::status() const {
  for (const auto& term : terms)
    if (term.solve.status != GmresStatus::converged) return term.solve.status;
  return GmresStatus::converged;
}

bool is_near(const GmresResult& solve, const GmresOptions& options) {
  return solve.relative_residual <= near * options.relative_tolerance;
}

template <int Dim>
AdjointSolution solve_adjoint(Analysis<Dim>& analysis, const GmresOptions& options, int& factorizations) {
  const Functional<Dim>& functional = analysis.functional();
  const std::vector<double> by_state = functional.by_state();
  // Factors of another solution get a fair try, not a long one.
  GmresOptions first = options;
  first.max_iterations = std::min(options.max_iterations, fair_try);
  AdjointSolution adjoint = solve_adjoint(functional.comm(), functional.problem(), by_state, first);
  if (is_near(adjoint.solve, options)) return adjoint;
  analysis.refactor();
  ++factorizations;
  const int iterations = adjoint.solve.iterations;
  adjoint = solve_adjoint(functional.comm(), functional.problem(), by_state, options);
  adjoint.solve.iterations += iterations;
  return adjoint;
}

template <int Dim>
AdjointSolutions solve_adjoints(const Objective<Dim>& objective, const GmresOptions& options) {
  AdjointSolutions result;
  for (const auto& [weight, analysis] : objective.terms)
    result.terms.push_back(solve_adjoint(*analysis, options, result.factorizations));
  return result;
}

template <int Dim>
std::vector<Parameters<Dim>> term_derivatives(const Objective<Dim>& objective,
                                              const AdjointSolutions& adjoints) {
  std::vector<Parameters<Dim>> result;
  for (std::size_t i = 0; i < objective.terms.size(); ++i) {
    const Analysis<Dim>& analysis = *objective.terms[i].analysis;
    result.push_back(total_derivative(analysis.functional(), analysis.point(), adjoints.terms[i]));
  }
  return result;
}

template <int Dim>
Parameters<Dim> weighted_sum(const std::vector<Parameters<Dim>>& terms, const std::vector<double>& weights) {
  Parameters<Dim> sum;
  sum.nodes.resize(terms.front().nodes.size());
  for (std::size_t t = 0; t < terms.size(); ++t) {
    for (std::size_t i = 0; i < sum.nodes.size(); ++i) sum.nodes[i] += weights[t] * terms[t].nodes[i];
    for (std::size_t k = 0; k < scalar_count; ++k) sum.scalars[k] += weights[t] * terms[t].scalars[k];
  }
  return sum;
}

template <int Dim>
DirectionalDerivative objective_derivative(const Objective<Dim>& objective, const Parameters<Dim>& change,
                                           const GmresOptions& options) {
  DirectionalDerivative result;
  result.solve = {GmresStatus::converged, 0, 0.0};
  for (const auto& [weight, analysis] : objective.terms) {
    const auto part = directional_derivative(analysis->functional(), analysis->point(), change, options);
    result.value += weight * part.value;
    result.solve.iterations += part.solve.iterations;
    result.solve.relative_residual = std::max(result.solve.relative_residual, part.solve.relative_residual);
    if (part.solve.status != GmresStatus::converged) result.solve.status = part.solve.status;
  }
  return result;
}

template struct Objective<2>;
template AdjointSolution solve_adjoint<2>(Analysis<2>&, const GmresOptions&, int&);
template AdjointSolutions solve_adjoints<2>(const Objective<2>&, const GmresOptions&);
template std::vector<Parameters<2>> term_derivatives<2>(const Objective<2>&, const AdjointSolutions&);
template Parameters<2> weighted_sum<2>(const std::vector<Parameters<2>>&, const std::vector<double>&);
template DirectionalDerivative objective_derivative<2>(const Objective<2>&, const Parameters<2>&,
                                                       const GmresOptions&);

}  // namespace wingbeat
