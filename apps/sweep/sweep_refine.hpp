#pragma once

#include <optional>
#include <span>
#include <vector>

namespace wingbeat {

// A point of a curve: its place and what was found there, nothing where the point failed.
struct CurvePoint {
  double place = 0.0;
  std::vector<double> values;  // empty: nothing was found
};

// Where to add points to a curve, halfway between two that follow one another: at most `count` places, those
// by the sharpest bends first. `points` ascend. A bend is how far a value departs from the straight line
// between its neighbours, as a part of that value's range over the curve, least that which `tolerance`
// allows; at the edge of a gap the bend is one. Intervals narrower than `least_width` are left as they are.
std::vector<double> refined_places(std::span<const CurvePoint> points, double tolerance, double least_width,
                                   int count);

}  // namespace wingbeat
