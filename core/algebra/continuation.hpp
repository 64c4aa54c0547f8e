#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/algebra/newton.hpp"

namespace wingbeat {

// One solution of a family with one free parameter. The family is followed in the plane of two numbers,
// an amplitude and a speed. u may be any layout of which linear combinations make sense: [rank's part].
struct BranchPoint {
  std::vector<double> u;
  double amplitude = 0.0;  // > 0, but for a state of rest that the family grows from
  double speed = 0.0;      // > 0
};

// The equation that picks one solution of the family, by the predicted one (eq:branch-row):
//   by_amplitude (amplitude/amplitude_0 - 1) + by_speed (speed/speed_0 - 1) = 0.
struct BranchRow {
  double amplitude = 1.0;
  double speed = 1.0;
  double by_amplitude = 1.0;
  double by_speed = 0.0;
};

// Solves from the predicted point with that row; on success the point is the solution, with the
// amplitude and speed it has. Collective.
struct Correction {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
};
using Corrector = std::function<Correction(BranchPoint& point, const BranchRow& row)>;

struct BranchOptions {
  double amplitude_scale = 1.0;  // what counts as one in the plane
  double speed_scale = 1.0;
  double step = 0.1;  // length of the first step, in these scales
  double largest_step = 0.35;
  double least_step = 1e-3;
  int wanted_iterations = 5;  // of a correction: fewer lengthen the next step, more shorten it
  int order = 2;              // of the prediction: 1, a line; 2, a parabola
};

// Where to stop on the family: at an amplitude or at a speed.
struct BranchTarget {
  enum class Kind { amplitude, speed } kind = Kind::amplitude;
  double value = 0.0;
  bool operator==(const BranchTarget&) const = default;
};

enum class BranchStep { advanced, reached, failed, interrupted };

// Follows a family by pseudo-arclength continuation (Keller 1977): predicts by a line or parabola in
// the length along the family, corrects on a line across the predicted direction, and sets the step by the
// iterations a correction takes. Folds in amplitude or speed are passed like any other point.
class BranchFollower {
 public:
  // Begins at the solution `first` and goes on in the direction from `behind` to it: the state of rest
  // that the family grows from, or an earlier solution. Both differ in amplitude or speed.
  BranchFollower(BranchPoint behind, BranchPoint first, const BranchOptions& options, Corrector corrector);

  // A step towards the target: `advanced` when last() is a new solution, short of the target or just over
  // it; `reached` when found() is the solution at the target, last() being that or one beyond it. A step that
  // fails is tried again with half the length; below the least one it is given up: `failed`, see why().
  BranchStep advance(const BranchTarget& target);
  // Solves at a target that the last step went over, if it did: found(). Nothing where there is none that
  // was not found before; advance does this for its own target.
  std::optional<BranchStep> look_back(const BranchTarget& target);
  // From now on the other way.
  void turn() { direction_ = -direction_; }

  const BranchPoint& last() const { return nodes_.back().point; }
  const BranchPoint& found() const { return found_; }
  const std::string& why() const { return why_; }
  // The length of the next step: what a branch goes on with, beside a solution of it.
  double step() const { return step_; }
  // True where the way goes towards greater amplitudes.
  bool grows() const;
  // Gives all solutions kept another layout.
  void convert(const std::function<std::vector<double>(const std::vector<double>&)>& layout);

 private:
  struct Node {
    BranchPoint point;
    double length = 0.0;
  };

  std::vector<double> weights(double length) const;
  BranchPoint predicted(double length) const;
  std::array<double, 2> place(double length) const;  // amplitude and speed predicted
  std::optional<double> length_to(const BranchTarget& target, double from, double to) const;
  std::optional<double> length_onto(const BranchTarget& target) const;
  BranchRow row_across(const BranchPoint& point) const;
  std::optional<BranchStep> try_step(const BranchTarget& target);
  void accept(BranchPoint point);

  BranchOptions options_;
  Corrector corrector_;
  std::vector<Node> nodes_;  // the newest last
  double direction_ = 1.0;
  double step_;
  BranchPoint found_;
  // What was sought between the last two nodes, and up to which length.
  std::vector<std::pair<BranchTarget, double>> searched_;
  std::string why_;
};

}  // namespace wingbeat
