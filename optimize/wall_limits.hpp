#pragma once

#include <span>
#include <vector>

#include "adjoint/hicks_henne.hpp"

namespace wingbeat {

// lower <= sum of coefficients times variables.
struct LinearLimit {
  std::vector<double> coefficients;
  double lower = 0.0;
};

// Keeps the wall from folding: a face of it, projected on where it lay undeformed, keeps at least the part
// `least` of its length, 0 < least < 1 (eq:wall-limits). Linear in the amplitudes: of use to an optimiser,
// which then need not find out by failures. Those that no amplitudes within +-bound can violate are left out.
std::vector<LinearLimit> wall_limits(const SectionWall& wall, const HicksHenne& bumps, double bound,
                                     double least);

}  // namespace wingbeat
