#pragma once

#include <variant>

#include "flow/scheme/cusp.hpp"
#include "flow/scheme/first_order.hpp"
#include "flow/scheme/jst.hpp"
#include "flow/scheme/matrix.hpp"
#include "flow/scheme/roe.hpp"
#include "flow/scheme/van_leer.hpp"

// A scheme is a value that holds its coefficients and the dissipation d that it takes from the
// central flux:  F = 1/2 (F(w_1) + F(w_2)) - d  (eq:scheme). Upwind schemes, too, are written so:
// Runge-Kutta stages may then keep d while the central part is renewed.
namespace wingbeat {

using Scheme = std::variant<JstScheme, MatrixScheme, CuspScheme, RoeScheme, VanLeerScheme, FirstOrderScheme>;

// Mean of the fluxes of the two cells beside the face, in excess of a uniform flow's.
template <int Dim, class T, class P>
State<Dim, T> central_flux(const FaceStencil<Dim, T, P>& cells, const MovedFace<Dim, T>& face,
                           const UniformFlow<Dim, T>& uniform) {
  State<Dim, T> flux = excess_flux<Dim, T>(cells.w[1], cells.p[1], uniform, face.normal, face.sweep) +
                       excess_flux<Dim, T>(cells.w[2], cells.p[2], uniform, face.normal, face.sweep);
  flux *= 0.5;
  return flux;
}

// The numerical flux F (eq:scheme), in excess of a uniform flow's (none by default).
template <int Dim, class T, class S>
State<Dim, T> numerical_flux(const S& scheme, const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>& face,
                             double gamma, const UniformFlow<Dim, T>& uniform = {}) {
  return central_flux<Dim, T>(cells, face, uniform) - scheme.dissipation(cells, face, uniform, gamma);
}

}  // namespace wingbeat
