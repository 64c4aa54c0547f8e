#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/algebra/newton.hpp"
#include "flow/flow_level.hpp"
#include "flow/forced_motion.hpp"
#include "flow/harmonic_preconditioner.hpp"

namespace wingbeat {

struct ForcedFlowOptions {
  double tolerance = 1e-10;  // on |R| relative to that of uniform flow on the mesh at rest
  NewtonOptions newton{};
};

struct ForcedFlowIteration {
  int iteration = 0;
  double residual = 0.0;  // relative
  double step = 0.0;
  int linear_iterations = 0;
};
// Return false to stop early.
using ForcedFlowObserver = std::function<bool(const ForcedFlowIteration&)>;

struct ForcedFlowResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
  int linear_iterations = 0;
  int factorizations = 0;
  int cycles = 0;  // of Runge-Kutta multigrid, where that came first
  double residual = 1.0;
};

// Where the solution of a forced motion starts: w of all instances, and factors worth starting with.
struct ForcedFlowStart {
  std::vector<double> w;
  HarmonicFactors factors;
};

// The steady flow of the level, in all instances.
template <int Dim>
ForcedFlowStart steady_start(const FlowLevel<Dim>& level, const TimeSpectral& time);

// The steady flow and its linear response to each harmonic of the motion (eq:frequency-domain); its
// steady state alone where that sum is no state of a gas. Linearizes level.steady. Collective; throws
// SolveFailure where a linear solve fails.
template <int Dim>
ForcedFlowStart linear_start(FlowLevel<Dim>& level, const TimeSpectral& time, const ForcedMotion& motion,
                             double kappa, const GmresOptions& gmres = {});

// Periodic flow R(w) = 0 under given motions, one an instance, by Newton's method. w: the start,
// then the solution. Collective.
template <int Dim>
ForcedFlowResult solve_forced_flow(FlowEquations<Dim>& flow, HarmonicFactors factors,
                                   const std::vector<MotionState>& motions, double kappa, std::span<double> w,
                                   const ForcedFlowOptions& options, const ForcedFlowObserver& observer = {});

}  // namespace wingbeat
