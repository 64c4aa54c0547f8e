#pragma once

#include <string>
#include <vector>

#include "apps/case_settings.hpp"
#include "apps/sweep/sweep_order.hpp"
#include "apps/sweep/sweep_points.hpp"

namespace wingbeat {

// The case of a point: that of the sweep, its verb's defaults and the point's values. Throws InputError
// naming the point's values where the verb refuses it.
CaseSettings point_settings(const ResolvedCase& sweep, const SweepPoints& points, std::size_t point);

// Places of points, and which may start from one another: those on one mesh with equal instances.
PointPlaces places_of(const SweepPoints& points);

// "flow.mach = 0.8, structure.mass_ratio = 60"
std::string point_label(const SweepPoints& points, std::size_t point);

}  // namespace wingbeat
