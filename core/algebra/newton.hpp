#pragma once

#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/algebra/gmres.hpp"
#include "core/algebra/linear_operator.hpp"
#include "core/parallel/comm.hpp"

namespace wingbeat {

// F(u) = 0 with its Jacobian and a preconditioner for it. All calls are collective.
class Problem {
 public:
  virtual ~Problem() = default;
  virtual std::size_t local_size() const = 0;
  // Returns false where F cannot be evaluated (a negative pressure, say): the step is then shortened.
  virtual bool residual(std::span<const double> u, std::span<double> f) = 0;
  // Makes jacobian() the exact Jacobian at u.
  virtual void linearize(std::span<const double> u) = 0;
  virtual const LinearOperator<double>& jacobian() const = 0;
  // Rebuilds preconditioner() from the last linearization; called only when worth its cost.
  virtual void refactor() = 0;
  virtual bool is_factored() const = 0;
  virtual const LinearOperator<double>& preconditioner() const = 0;
  // Largest step in (0, 1] that keeps u + step du sensible; 1 unless overridden.
  virtual double step_limit(std::span<const double> /*u*/, std::span<const double> /*du*/) const {
    return 1.0;
  }
  // How many times F(u) is above what is asked, by the problem's own measure of its rows: converged
  // where it is 1 or less on all ranks.
  virtual double excess(std::span<const double> f) const = 0;
};

struct NewtonOptions {
  int max_iterations = 30;
  double forcing_max = 1e-1;  // Eisenstat-Walker, choice 2 (doi:10.1137/0917003)
  double forcing_min = 1e-6;
  // More Krylov iterations than this in a solve, and notably more a digit than new factors took: refactor
  // before the next.
  int refactor_iterations = 25;
  int max_backtracks = 8;
  GmresOptions gmres{};
};

enum class SolveStatus { converged, stalled, iteration_limit, diverged, interrupted };
std::string_view to_string(SolveStatus status);

// A solution that a larger computation cannot go on without was not reached: thrown on all ranks.
// Not a fault of the program: the run ends as not converged, or as interrupted.
class SolveFailure : public std::runtime_error {
 public:
  SolveFailure(SolveStatus status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  SolveStatus status() const { return status_; }

 private:
  SolveStatus status_;
};

// What an observer is shown after every iteration (iteration 0 is the start).
struct NewtonIteration {
  int iteration = 0;
  double residual_norm = 0.0;
  double step = 0.0;
  int linear_iterations = 0;
  bool refactored = false;
};

struct NewtonResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
  int linear_iterations = 0;
  int factorizations = 0;
  double residual_norm = 0.0;
};

// Is shown the iterate u and F(u); returns false to stop early (a signal, a time limit): the status
// is then `interrupted`.
using NewtonObserver =
    std::function<bool(const NewtonIteration&, std::span<const double> u, std::span<const double> f)>;

// Inexact Newton with a backtracking line search on |F|, Eisenstat-Walker forcing and lazy
// refactorization; u holds the start on entry and the solution on return.
NewtonResult newton(const Comm& comm, Problem& problem, std::span<double> u, const NewtonOptions& options,
                    const NewtonObserver& observer = {});

}  // namespace wingbeat
