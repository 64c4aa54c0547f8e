#pragma once

#include <span>
#include <string_view>

#include "core/algebra/linear_operator.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

struct GmresOptions {
  double relative_tolerance = 1e-10;  // on the true residual, relative to the right-hand side
  int restart = 60;
  int max_iterations = 600;
  // Harmonic Ritz vectors kept at a restart, fewer than the restart length; 0: plain restarts.
  int deflation = 20;
};

enum class GmresStatus { converged, iteration_limit, stagnated, not_finite };
std::string_view to_string(GmresStatus status);

struct GmresResult {
  GmresStatus status = GmresStatus::iteration_limit;
  int iterations = 0;
  double relative_residual = 1.0;  // true one, recomputed at the end
};

// Flexible, right-preconditioned, restarted GMRES (Saad 1993, doi:10.1137/0914028): solves
// op x = rhs from the given x. A restart keeps the directions that converge slowest
// (eq:deflated-restart; Giraud et al. 2010, doi:10.1137/080741847). Gram-Schmidt is done twice. Use
// TransposedOperator for the transpose.
// T is double or std::complex<double>. Collective.
template <class T>
GmresResult gmres(const Comm& comm, const LinearOperator<T>& op, const LinearOperator<T>& preconditioner,
                  std::span<const T> rhs, std::span<T> x, const GmresOptions& options);

}  // namespace wingbeat
