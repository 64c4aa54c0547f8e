#pragma once

#include <memory>
#include <vector>

#include "adjoint/analysis.hpp"

namespace wingbeat {

// A number that is a sum over solved problems: of one, as a rule; of several where it is a difference of
// them.
template <int Dim>
struct Objective {
  struct Term {
    double weight = 1.0;
    std::unique_ptr<Analysis<Dim>> analysis;
  };
  std::vector<Term> terms;

  // All terms solved at a change of the parameters. Collective; throws SolveFailure.
  void solve(const Parameters<Dim>& change);
  // Keeps the solutions as starts of the next.
  void keep();
  // At the last solution.
  double value() const;
  std::vector<double> weights() const;
};

// The adjoint of an analysis at its last solution. Factors that do not lead near the tolerance are renewed
// once: `factorizations` then goes up. Collective.
template <int Dim>
AdjointSolution solve_adjoint(Analysis<Dim>& analysis, const GmresOptions& options, int& factorizations);
// Whether its residual is as near the tolerance as round-off may leave it.
bool is_near(const GmresResult& solve, const GmresOptions& options);

// The same of every term.
struct AdjointSolutions {
  std::vector<AdjointSolution> terms;
  int factorizations = 0;

  int iterations() const;
  double relative_residual() const;  // the worst
  GmresStatus status() const;        // not converged where one is not
};
template <int Dim>
AdjointSolutions solve_adjoints(const Objective<Dim>& objective, const GmresOptions& options);

// Derivatives of every term, without its weight, with respect to all parameters, as parameter_sensitivity
// gives them; and their weighted sum. Collective.
template <int Dim>
std::vector<Parameters<Dim>> term_derivatives(const Objective<Dim>& objective,
                                              const AdjointSolutions& adjoints);
template <int Dim>
Parameters<Dim> weighted_sum(const std::vector<Parameters<Dim>>& terms, const std::vector<double>& weights);

// The derivative along one change of them, by a tangent solve a term. Collective.
template <int Dim>
DirectionalDerivative objective_derivative(const Objective<Dim>& objective, const Parameters<Dim>& change,
                                           const GmresOptions& options);

}  // namespace wingbeat
