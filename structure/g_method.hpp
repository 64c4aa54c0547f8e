#pragma once

#include <span>

#include "structure/aerodynamic_table.hpp"
#include "structure/pk.hpp"

namespace wingbeat {

// g method (P. C. Chen, AIAA Journal 38(9), 2000, 1519-1524): p-k with Q continued to damped motion to first
// order, Q(ik + g) = Q(k) - i g dQ/dk, g = Re p/(2V), as Q is analytic              (eq:g-method)
// Arguments, result and the way modes are followed are those of pk(); the two agree where Re p = 0. Beyond
// the range of the table Q is held and has no derivative.
PkResult g_method(const StructureModel& model, const AerodynamicTable& table,
                  std::span<const double> reduced_velocities, const PkOptions& options = {});

}  // namespace wingbeat
