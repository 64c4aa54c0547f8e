#pragma once

#include <span>
#include <vector>

#include "adjoint/section_wall.hpp"

namespace wingbeat {

struct SectionMeasure {
  double value = 0;
  std::vector<Vec<double, 2>> by_wall;  // derivative with respect to the position of each node of the wall
};

// Area: of the polygon, in chords^2.
//
// Thickness: the greatest distance in y of upper and lower surface at equal x, each a cubic between its nodes
// with the slopes of parabolas through three of them, aft of 2 % of the chord. It is continuous in the
// positions, and differentiable where the greatest is attained once: there its derivative is that of the
// distance at fixed x.
//
// Leading edge radius: R of the parabola x = x_0 + b y + y^2/(2R) that fits the five nodes nearest to the
// leading edge of the undeformed wall, by arc length, best in the sense of least squares in x. On a
// four-digit section the error falls as the distance of nodes does. Infinite, or negative, where the nose is
// flat or hollow.
struct SectionMeasures {
  SectionMeasure area, thickness, leading_edge_radius;
};

// Of the wall with its nodes displaced.
SectionMeasures measure_section(const SectionWall& wall, std::span<const Vec<double, 2>> displacement);

}  // namespace wingbeat
