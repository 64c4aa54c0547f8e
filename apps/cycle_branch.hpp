#pragma once

#include <memory>
#include <string>

#include "apps/cycle_solver.hpp"
#include "core/algebra/continuation.hpp"

namespace wingbeat {

// The branch of limit cycles of a case, followed by the coupled method from one cycle on: in the plane of
// the amplitude sqrt(E_fl) and the speed V. Where the case asks for it, harmonics are added as the highest
// one comes to carry more than its share of the energy. All methods are collective.
class CycleBranch {
 public:
  // `start`: near the first cycle, of the energy given. `largest_energy`: to be expected on the way.
  CycleBranch(Context& context, const StructureModel& model, CycleSolver& solver, CycleStart start,
              double largest_energy);

  // Solves the first cycle.
  SolveStatus begin(double energy);
  // A step towards a cycle of that energy or speed; see BranchFollower::advance.
  BranchStep advance_to_energy(double energy);
  BranchStep advance_to_speed(double reduced_velocity);
  // The cycle of that speed, if the last step went over one.
  std::optional<BranchStep> look_back_for_speed(double reduced_velocity);

  // What a later run goes on with from the cycle solved last.
  std::optional<SolverMemory> memory() const;
  // State of rest and factors that serve every cycle.
  const CycleStart& start() const { return start_; }
  // The cycle solved last, with how it was solved. After `failed`, the one that did not converge.
  const CycleSolution& solution() const { return solution_; }
  // The last cycle on the way: where it ended if a step failed.
  double energy() const { return last().amplitude * last().amplitude; }
  double reduced_velocity() const { return last().speed; }
  std::string why() const { return follower_->why(); }

 private:
  const BranchPoint& last() const { return follower_->last(); }
  Correction correct(BranchPoint& point, const BranchRow& row);
  BranchPoint point_of(const AeroelasticState& state) const;
  AeroelasticState state_of(const std::vector<double>& u) const;
  bool needs_harmonic(const AeroelasticState& state) const;
  void add_harmonic();
  BranchStep advance(const BranchTarget& target);

  Context& context_;
  const StructureModel& model_;
  CycleSolver& solver_;
  CycleStart start_;  // its rest and factors serve every cycle
  double largest_energy_;
  int harmonics_;
  int count_ = 0;  // cycles solved or tried
  CycleSolution solution_;
  std::unique_ptr<BranchFollower> follower_;
};

}  // namespace wingbeat
