#pragma once

#include "flow/moved_face.hpp"
#include "flow/scheme/face_stencil.hpp"

namespace wingbeat {

// Scalar dissipation of first order, without sensor (eq:first-order): the damping of multigrid's
// coarse meshes, whose truncation error never reaches the solution. Reads cells 1 and 2 only.
struct FirstOrderScheme {
  static constexpr bool uses_radii = true;

  double k = 0.5;

  template <int Dim, class T>
  State<Dim, T> dissipation(const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>& /*face*/,
                            const UniformFlow<Dim, T>& /*uniform*/, double /*gamma*/) const {
    const T weight = 0.5 * k * (cells.radius[0] + cells.radius[1]);
    State<Dim, T> result;
    for (int v = 0; v < state_size<Dim>; ++v) result[v] = weight * (cells.w[2][v] - cells.w[1][v]);
    result[Dim + 1] += weight * (cells.p[2] - cells.p[1]);
    return result;
  }
};

}  // namespace wingbeat
