#pragma once

#include <span>
#include <vector>

#include "flow/flow_domain.hpp"
#include "flow/motion.hpp"

namespace wingbeat {

// Spectral radii |u . S_d - sweep_d| + c |S_d| of every owned cell of one instance in each
// direction (eq:spectral-radius). w: [owned cell][variable] -> [owned cell][Dim].
template <int Dim>
std::vector<double> directional_radii(const FlowDomain<Dim>& domain, std::span<const double> w,
                                      const MotionState& motion, double gamma);

// Their sums over the directions: the reciprocal of the time in which waves cross the cell, times
// its volume.
template <int Dim>
std::vector<double> spectral_radius_sums(const FlowDomain<Dim>& domain, std::span<const double> w,
                                         const MotionState& motion, double gamma);

}  // namespace wingbeat
