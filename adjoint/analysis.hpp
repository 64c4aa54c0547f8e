#pragma once

#include <span>
#include <string>
#include <vector>

#include "adjoint/adjoint.hpp"

namespace wingbeat {

// A problem over its parameters: solved at a change of them, with a functional of the solution.
template <int Dim>
class Analysis {
 public:
  virtual ~Analysis() = default;
  // Solves at the base's parameters plus `change`, from the solution kept last, at first the base's, and
  // linearizes there. Throws SolveFailure where it does not converge. Collective.
  virtual void solve(const Parameters<Dim>& change) = 0;
  // Keeps the last solution as the start of the next.
  void keep() { start_from(solution()); }
  // The last solution, this rank's part, and one of these as the start of the next.
  virtual std::vector<double> solution() const = 0;
  virtual void start_from(std::span<const double> solution) = 0;
  // At the last solution.
  virtual const Functional<Dim>& functional() const = 0;
  virtual ParameterPoint<Dim> point() const = 0;
  // Makes new factors of the preconditioner at the last solution. Collective.
  virtual void refactor() = 0;
};

// Newton's method from u to the problem's own tolerances or, where round-off keeps it from them, to within
// `slack` times these; throws SolveFailure naming `what`. Collective.
void solve_near_roundoff(const Comm& comm, Problem& problem, std::span<double> u,
                         const NewtonOptions& options, double slack, const std::string& what);

// No change.
template <int Dim>
Parameters<Dim> no_change(const LocalNodes<Dim>& nodes) {
  Parameters<Dim> change;
  change.nodes.resize(nodes.numbers.size());
  return change;
}

}  // namespace wingbeat
