#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/cycle_analysis.hpp"
#include "adjoint/shape_variables.hpp"
#include "apps/cycle_solver.hpp"
#include "flow/steady_sequence.hpp"

namespace wingbeat {

class CycleBranch;

// dV/dE_0 at E from V at E, 2 E and 3 E, with an error of second order (eq:onset-slope).
std::array<double, 3> onset_weights(double energy);

// A cycle as an analysis, to be solved near `start`: of its energy, or of a given speed. What it refers to
// outlives it.
std::unique_ptr<CycleAnalysis<2>> cycle_analysis(const Context& context, const FlowLevel<2>& level,
                                                 const ShapeVariables& shape, AeroelasticState start,
                                                 AeroelasticState rest, HarmonicFactors factors,
                                                 std::optional<double> reduced_velocity);

// Finds the cycles of a case by the stages of `flutter` and `lco`, and makes analyses of them, solved at the
// case's own parameters. Every cycle is reported as it is found. Where one is not, `status` and the result's
// message say why. All methods are collective.
class CyclePrimal {
 public:
  // What they refer to outlives the analyses.
  CyclePrimal(Context& context, FlowLevels<2>& levels, const ShapeVariables& shape, History& history);

  struct Cycles {
    SolveStatus status = SolveStatus::converged;
    std::vector<std::unique_ptr<CycleAnalysis<2>>> analyses;
  };
  // Small motion at the flutter boundary, of the energy flutter.energy.
  Cycles flutter();
  // Limit cycles of given energies, ascending, along the branch from small motion.
  Cycles of_energies(const std::vector<double>& energies);
  // The limit cycle at a given speed, first met along that branch.
  Cycles at_speed(double reduced_velocity);
  // Those of energies E, 2 E and 3 E.
  Cycles onset(double energy);

 private:
  std::optional<CycleStart> approach(double energy, Cycles& cycles);
  Cycles single(const std::string& stage, const CycleAmplitude& amplitude);
  void follow(CycleBranch& branch, const CycleAmplitude& target, Cycles& cycles);
  Cycles on_branch(double first_energy, double largest_energy, const std::vector<CycleAmplitude>& targets);
  bool finish(Cycles& cycles, const CycleSolution& solution, bool is_flutter);
  void add(const CycleSolution& solution, const CycleStart& start, std::optional<double> reduced_velocity,
           Cycles& cycles);

  Context& context_;
  const CaseSettings& settings_;
  FlowLevels<2>& levels_;
  FlowLevel<2>& level_;
  const ShapeVariables& shape_;
  History& history_;
  StructureModel model_;
  CycleSolver solver_;
};

}  // namespace wingbeat
