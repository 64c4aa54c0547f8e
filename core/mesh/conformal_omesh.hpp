#pragma once

#include <optional>
#include <vector>

#include "core/mesh/airfoil.hpp"
#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

struct OmeshOptions {
  int around = 128;               // cells around the section, >= 16
  int normal = 32;                // cells from wall to far field, >= 4
  double farfield_chords = 60.0;  // radius of the far field, > 1
  // Ratio of successive steps in the logarithm of the circle-plane radius, > 0; chosen so that the
  // cells at the wall are square if not given.
  std::optional<double> stretching = std::nullopt;
  int blocks = 1;
};

// O-mesh about a section: the image of circles and rays under the conformal map of the outside of
// the unit circle to that of the section, hence orthogonal but for its finite spacing. i runs from
// the lower trailing edge over the leading edge to the upper trailing edge, j from the wall out;
// this is right-handed, and the first and last column coincide (the cut of the O). The angle is
// equidistant in the circle plane; the far field is the circle that the map multiplies to a radius
// of farfield_chords, its centre near the mid-chord.
//
// Zones are called "block-1", ..., patches and families "wall" and "farfield", the two sides of the
// O's cut "cut-lower" and "cut-upper". The nodes are the same, bit for bit, for any number of blocks.
// Throws InputError if an option is out of range or the section cannot be mapped.
// Source of the mesh family: Vassberg & Jameson, J. Aircraft 47 (2010), doi 10.2514/1.46737.
MultiblockMesh<2> conformal_omesh(const Airfoil& airfoil, const OmeshOptions& options);

// Logarithms of the circle-plane radii of the mesh lines, from 0 at the wall to `log_farfield`:
// steps in geometric progression, the first of them 2 pi/around unless a ratio is given. Where so
// many steps overshoot the far field, they are equal and shorter.
std::vector<double> logarithmic_radii(double log_farfield, const OmeshOptions& options);

}  // namespace wingbeat
