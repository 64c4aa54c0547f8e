#include "adjoint/analysis.hpp"

namespace wingbeat {

void solve_near_roundoff(const Comm& comm, Problem& problem, std::span<double> u,
                         const NewtonOptions& options, double slack, const std::string& what) {
  const NewtonResult solved = newton(comm, problem, u, options);
  if (solved.status == SolveStatus::converged) return;
  std::vector<double> f(u.size());
  const bool is_evaluated = problem.residual(u, f);
  if (comm.any(!is_evaluated) || !(comm.max(problem.excess(f)) <= slack))
    throw SolveFailure(solved.status,
                       what + " has not converged near its solution; raise solver.max_newton_iterations");
}

}  // namespace wingbeat
