#pragma once

#include "flow/gas.hpp"

namespace wingbeat {

// What a scheme reads of the four cells in line with a face: ordered along the face normal, the
// face between cells 1 and 2. Pressures are given apart from the states: beyond a physical boundary
// both are extrapolated. Radii are the scaled spectral radii of cells 1 and 2 in the direction of
// the face (eq:jst-radius), given to schemes that use them. The number type P of pressures and
// radii may differ from that of states.
template <int Dim, class T, class P = T>
struct FaceStencil {
  Vec<State<Dim, T>, 4> w;
  Vec<P, 4> p;
  Vec<P, 2> radius;
};

}  // namespace wingbeat
