#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/algebra/newton.hpp"
#include "core/algebra/schwarz.hpp"
#include "flow/flow_equations.hpp"

namespace wingbeat {

struct PseudoTransientOptions {
  double tolerance = 1e-12;  // on |R| relative to that of uniform flow
  int max_iterations = 200;
  double cfl_initial = 10.0;
  double cfl_growth = 1.5;   // CFL = initial / |R|^growth, R relative to uniform flow
  double step_limit = 0.25;  // largest relative change of density and pressure in a step
  double forcing = 1e-2;     // linear tolerance
  int refactor_iterations = 20;
  GmresOptions gmres{};
};

struct PseudoTransientIteration {
  int iteration = 0;
  double residual = 0.0;  // relative to uniform flow
  double cfl = 0.0;
  double step = 0.0;
  int linear_iterations = 0;
  bool refactored = false;
};

struct PseudoTransientResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
  int linear_iterations = 0;
  int factorizations = 0;
  double residual = 1.0;
};

// Return false to stop early.
using PseudoTransientObserver = std::function<bool(const PseudoTransientIteration&)>;

// Steady flow by implicit pseudo-time steps that grow into Newton steps (eq:pseudo-transient):
//   (Omega/dt + dR/dw) dw = -R,  Omega/dt = (sum of spectral radii)/CFL, the CFL number growing as
// the residual falls. The linear system is solved by GMRES, preconditioned by `solver`, which is
// left holding factors of a matrix near the final Jacobian. `source` (empty, or a value a state
// entry) is subtracted from R: manufactured solutions need it. w: the start, then the solution.
// Collective.
template <int Dim>
PseudoTransientResult pseudo_transient(FlowEquations<Dim>& flow, const MotionState& motion,
                                       SchwarzSolver<double>& solver, std::span<double> w,
                                       const PseudoTransientOptions& options,
                                       const PseudoTransientObserver& observer = {},
                                       std::span<const double> source = {});

}  // namespace wingbeat
