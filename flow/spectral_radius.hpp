#pragma once

#include <span>
#include <vector>

#include "flow/flow_domain.hpp"
#include "flow/motion.hpp"

namespace wingbeat {

// Sum over the directions of |u . S - sweep| + c |S| of every owned cell of one instance: the
// reciprocal of the time in which waves cross the cell, times its volume.
template <int Dim>
std::vector<double> spectral_radius_sums(const FlowDomain<Dim>& domain, std::span<const double> w,
                                         const MotionState& motion, double gamma);

}  // namespace wingbeat
