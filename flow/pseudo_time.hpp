#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/algebra/newton.hpp"
#include "flow/multigrid.hpp"

namespace wingbeat {

struct PseudoTimeOptions {
  double tolerance = 1e-10;  // on |R| relative to that of uniform flow on the mesh at rest
  int max_cycles = 5000;
  int max_retreats = 6;
  MultigridOptions multigrid;
};

struct PseudoTimeIteration {
  int cycle = 0;
  double residual = 0.0;  // relative to uniform flow, before the cycle
  double cfl = 0.0;
  int retreats = 0;                // times that the CFL number was lowered so far
  std::span<const double> w{};     // before the cycle
  std::span<const double> good{};  // the state that a retreat goes back to
};

// What a solve goes on with, bit for bit, beside w: taken from an iteration or a result.
struct PseudoTimeMemory {
  int cycles = 0;
  int retreats = 0;
  double cfl = 0.0;
  std::vector<double> good;
};

struct PseudoTimeResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int cycles = 0;
  int retreats = 0;
  double residual = 1.0;
  double cfl = 0.0;  // in the end
  // Where it was stopped or met its limit: to go on with.
  std::optional<PseudoTimeMemory> memory;
};

// Return false to stop early.
using PseudoTimeObserver = std::function<bool(const PseudoTimeIteration&)>;

// Drives R(w) = 0 of all instances to the tolerance by multigrid cycles. Where a cycle leaves no
// flow (a density or pressure that is not positive, or not a number) or a residual that has grown
// out of proportion, it goes back to the last good state and goes on with half the CFL number;
// after max_retreats it gives up as `diverged`, w being that state. w: the start, then the
// solution. With the `earlier` memory that belongs to w it goes on as if it had not been left; max_cycles
// are then allowed anew. Collective.
template <int Dim>
PseudoTimeResult pseudo_time(FlowEquations<Dim>& flow, Multigrid<Dim>& multigrid, std::span<double> w,
                             std::span<const MotionState> motions, TimeTerm term,
                             const PseudoTimeOptions& options, const PseudoTimeObserver& observer = {},
                             const PseudoTimeMemory* earlier = nullptr);

// The start of pseudo_time: uniform flow on the coarsest mesh, brought by cycles to a modest
// tolerance with the scheme of the finest mesh and interpolated to the next, up to the finest
// (eq:full-multigrid). A mesh whose cycles diverge hands on uniform flow. The observer is shown each
// level's iterations. Collective.
template <int Dim>
std::vector<double> full_multigrid_start(const FlowEquations<Dim>& flow, const DividedMesh<Dim>& mesh,
                                         std::span<const MotionState> motions, TimeTerm term,
                                         const PseudoTimeOptions& options,
                                         const PseudoTimeObserver& observer = {});

}  // namespace wingbeat
