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

// The same as constants of another number type.
template <class D, int Dim, class T>
FaceStencil<Dim, D> lifted(const FaceStencil<Dim, T>& cells) {
  FaceStencil<Dim, D> result;
  for (int k = 0; k < 4; ++k) result.w[k] = lifted<D>(cells.w[k]);
  result.p = lifted<D>(cells.p);
  result.radius = lifted<D>(cells.radius);
  return result;
}

}  // namespace wingbeat
