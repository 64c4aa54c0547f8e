#pragma once

#include <functional>
#include <optional>
#include <span>
#include <variant>

#include "structure/aeroelastic_problem.hpp"
#include "structure/staggered_energy_search.hpp"

namespace wingbeat {

// One iteration of a flow solver for all instances at given motions and kappa: w is advanced in
// place. Collective.
using FlowCycle =
    std::function<void(std::span<double> w, std::span<const MotionState> motions, double kappa)>;

// What the amplitude of the cycle follows from.
struct GivenEnergy {
  double energy = 0.0;  // E_0
};
struct GivenSpeed {
  double reduced_velocity = 0.0;
  double initial_energy = 0.0;  // where the search for the cycle's energy starts
};
using CycleAmplitude = std::variant<GivenEnergy, GivenSpeed>;

struct StaggeredOptions {
  int flow_cycles = 5;            // N_F, between structural steps
  int frequency_interval = 1;     // N_omega: structural steps between updates of omega and r
  double pseudo_time_step = 1.0;  // of the structure, in periods of the cycle
  double relaxation = 1.0;        // share of every step of y, omega and r that is taken
  int max_iterations = 5000;      // structural steps
  int max_recoveries = 6;
  AeroelasticTolerances tolerances{};
};

// What the iteration goes on with, bit for bit, beside the state.
struct StaggeredMemory {
  int iterations = 0;
  int flow_cycles = 0;
  int recoveries = 0;
  int steps_since_best = 0;
  int settled_steps = 0;
  double relaxation = 1.0;
  double energy = 0.0;  // E_fl of the state
  double previous_r = 0.0;
  double start_omega = 0.0;  // omega and r may not leave a range about these
  double start_r = 0.0;
  std::optional<EnergySearch::Point> last_point;  // of the search for the energy of a speed
  AeroelasticState best;                          // to recover from
  AeroelasticResiduals best_residuals;
};

struct StaggeredIteration {
  int iteration = 0;  // structural steps taken so far
  AeroelasticResiduals residuals;
  double omega = 0.0;
  double reduced_velocity = 0.0;
  double energy = 0.0;  // E_fl
  double relaxation = 1.0;
  std::function<StaggeredMemory()> memory{};  // what belongs to the state as it is now
};
// Return false to stop early.
using StaggeredObserver = std::function<bool(const StaggeredIteration&)>;

struct StaggeredResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
  int flow_cycles = 0;
  int recoveries = 0;
  AeroelasticResiduals residuals;         // of the state returned
  std::optional<StaggeredMemory> memory;  // where it was stopped: to go on with
};

// Flutter or limit cycle by turns (eq:staggered): cycles of the flow solver at given motion; then, on
// rank 0, an implicit structural step at given loads, the cycle scaled to its energy and shifted to
// its phase, omega and r fitted. `state`: a start near the solution, as from linear flutter, then the
// solution; on failure the best state met. Residuals are those of AeroelasticProblem, with
// s = sqrt(E_fl); at given speed `energy` is |V^2/V_given^2 - 1|, for the energy is then sought whose
// cycle has that speed (eq:energy-search).
// An iterate that is not finite or physical, whose omega or r leave a factor of 3 about the start's, or
// that is no better than one 300 steps ago is given up for the best one, and the relaxation halved;
// after max_recoveries of these the status is `diverged` or, in the last case, `stalled`. Throws InputError
// where the phase mode is at rest in the start. With the `earlier` memory that belongs to the state it goes
// on as if it had not been stopped; max_iterations are then allowed anew. Collective.
template <int Dim>
StaggeredResult solve_staggered(const FlowCycle& cycle, FlowEquations<Dim>& flow,
                                const StructuralEquation& structure, const SectionKinematics& kinematics,
                                const CycleAmplitude& amplitude, AeroelasticState& state,
                                const StaggeredOptions& options, const StaggeredObserver& observer = {},
                                const StaggeredMemory* earlier = nullptr);

}  // namespace wingbeat
