#pragma once

#include <optional>

namespace wingbeat {

// Secant search for the energy E of the limit cycle at a given freestream parameter, along the branch
// r(E), which is close to a straight line where it leaves the flutter boundary (eq:energy-search).
class EnergySearch {
 public:
  struct Point {
    double energy, mismatch;
  };

  // `last`: the point before, of a search that goes on.
  EnergySearch(double target_r, double initial_energy, std::optional<Point> last = std::nullopt);

  double energy() const { return energy_; }
  double target_r() const { return target_; }
  const std::optional<Point>& last() const { return last_; }
  // r/r_target - 1.
  double mismatch(double r) const { return r / target_ - 1.0; }
  // Takes in r of the cycle of the present energy and moves on to the next energy, at most a factor
  // of 4 away.
  void advance(double r);

 private:
  double target_;
  double energy_;
  std::optional<Point> last_;
};

}  // namespace wingbeat
