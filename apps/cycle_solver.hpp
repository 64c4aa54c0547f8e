#pragma once

#include <limits>
#include <optional>
#include <string>

#include "apps/context.hpp"
#include "apps/history.hpp"
#include "flow/flow_level.hpp"
#include "structure/cycle_tangent.hpp"
#include "structure/linear_flutter.hpp"
#include "structure/staggered.hpp"

namespace wingbeat {

// Where the search for a cycle begins: its state, the state of rest it is measured from (one
// instance) and factors worth starting Newton with.
struct CycleStart {
  AeroelasticState state;
  AeroelasticState rest;
  HarmonicFactors factors;
};

struct CycleSolution {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  SolveStatus status = SolveStatus::iteration_limit;
  AeroelasticState state;
  AeroelasticResiduals residuals{unknown, unknown, unknown, unknown};
  int newton_iterations = 0;
  int linear_iterations = 0;
  int factorizations = 0;
  double factor_bytes = 0.0;  // of all ranks, by Newton's method
  int staggered_iterations = 0;
  int flow_cycles = 0;
  std::vector<Loads<double>> loads;  // of every instance
  std::optional<CycleTangent> tangent;
  std::optional<SolverMemory> memory;  // by turns, where they were stopped
};

struct CoupledOptions {
  int max_iterations = 30;
  double looseness = 1.0;    // times the tolerances of the case
  bool with_tangent = true;  // of a cycle that converged
  bool is_kept = false;      // on the way there, by checkpoints
};

// The period of a state.
TimeSpectral time_of(const AeroelasticState& state);

// Finds flutter and limit cycles on one mesh by the case's method, with lines of progress and of
// history. All methods are collective.
class CycleSolver {
 public:
  CycleSolver(Context& context, FlowLevel<2>& level, const StructureModel& model, History& history)
      : context_(context),
        level_(level),
        model_(model),
        time_(context.settings.time.harmonics),
        history_(history) {}

  // Small motion of the given energy at a flutter root, by the linearization on the level itself or, with
  // a staggered method, on a coarser one: no matrix of the level's size is then factored.
  CycleStart linear_start(LinearFlutterSolution<2>& linear, const FlutterRoot& root,
                          const FlowLevel<2>& linearized, double energy);
  // From a solution. Turns that an earlier run left there go on from the same state of rest.
  CycleStart restart(AeroelasticState state);
  // A cycle of a case like this one, about the level's steady flow where the section rests undeflected.
  CycleStart moved(AeroelasticState cycle, double energy);
  // A solved cycle blown up or down, about the state of rest, to another energy.
  CycleStart grown(AeroelasticState state, const AeroelasticState& rest, double energy);

  // The cycle of given energy or speed near the start, by the case's method. `stage` names it in
  // progress and history.
  CycleSolution solve(const std::string& stage, const CycleStart& start, const CycleAmplitude& amplitude);
  // The cycle of a branch that a row picks, by Newton on all rows at once. The start's factors are used
  // and left renewed.
  CycleSolution solve_coupled(const std::string& stage, const CycleStart& start,
                              const CycleCondition& condition, const CoupledOptions& options);
  // In a sweep: gives a start the factors of the harmonics that a point before this one left; leaves those of
  // a start, after its solution, for the next point.
  void lend_factors(CycleStart& start) const;
  void keep_factors(const CycleStart& start, const CycleSolution& solution) const;
  // Makes room for one harmonic more among factors.
  void add_harmonic(HarmonicFactors& factors) const;

 private:
  CycleSolution solve_by_turns(const std::string& stage, const CycleStart& start,
                               const CycleAmplitude& amplitude);
  AeroelasticTolerances tolerances(double looseness = 1.0) const;
  CycleSolution solve_to_the_end(const std::string& stage, const CycleStart& start,
                                 const CycleCondition& condition);

  Context& context_;
  FlowLevel<2>& level_;
  const StructureModel& model_;
  TimeSpectral time_;
  History& history_;
};

// The numbers of a cycle as result.json names them.
nlohmann::ordered_json cycle_entry(const CaseSettings& settings, const StructureModel& model,
                                   const CycleSolution& solution);
// What was found, as a table; why it was not, as a sentence (empty where it was).
void print_cycle(Context& context, const nlohmann::ordered_json& entry);
std::string cycle_advice(const CaseSettings& settings, const CycleSolution& solution);

}  // namespace wingbeat
