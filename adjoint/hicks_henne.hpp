#pragma once

#include <span>
#include <vector>

#include "adjoint/section_wall.hpp"

namespace wingbeat {

struct BumpOptions {
  int bumps = 24;          // >= 1
  double width = 3.0;      // exponent t > 0: the larger, the narrower
  bool symmetric = false;  // one variable drives a bump and its mirror image
};

// Bumps on a section, from the lower trailing edge to the upper one, that move its wall along the outward
// normal (eq:hicks-henne). R. M. Hicks, P. A. Henne, J. Aircraft 15 (1978), doi 10.2514/3.58379. Amplitudes
// are in chords, outward positive, one a variable: a bump, or a mirrored pair where symmetric (the middle one
// of an odd number stands alone).
class HicksHenne {
 public:
  HicksHenne(const SectionWall& wall, const BumpOptions& options);

  int bumps() const { return options_.bumps; }
  int variables() const;

  // Arc parameter of the crest of bump i, 0 <= i < bumps(); bump i and bump bumps() - 1 - i are mirror
  // images.
  double peak(int i) const;
  // Bump i at arc parameter s: 1 at its peak, 0 at the trailing edge, and where it would be below 1e-16.
  double bump(int i, double s) const;

  // Displacement of each node of the wall, for one amplitude a variable.
  std::vector<Vec<double, 2>> displacement(std::span<const double> amplitudes) const;
  // The transpose: derivative with respect to each variable, from those with respect to the wall's nodes.
  std::vector<double> amplitude_gradient(std::span<const Vec<double, 2>> wall) const;

 private:
  template <class F>
  void for_each_value(F&& f) const;

  BumpOptions options_;
  std::vector<double> s_;
  std::vector<Vec<double, 2>> normals_;
};

}  // namespace wingbeat
