#pragma once

#include "flow/flow_domain.hpp"
#include "flow/moved_face.hpp"

// Boundary fluxes are functions of interior states only: there is no ghost state to keep filled.
// Normals point out of the flow.
namespace wingbeat {

// Wall pressure, extrapolated linearly from the first two cells to the face.
template <class T>
T wall_pressure(const T& p_first, const T& p_second) {
  return 1.5 * p_first - 0.5 * p_second;
}

// Slip wall: no flow relative to the moving wall; pressure acts, and does work (eq:wall-flux).
template <int Dim, class T, class G>
State<Dim, T> wall_flux(const T& p_wall, const Vec<G, Dim>& normal, const G& sweep) {
  State<Dim, T> flux{};
  for (int d = 0; d < Dim; ++d) flux[1 + d] = p_wall * normal[d];
  flux[Dim + 1] = p_wall * sweep;
  return flux;
}

// Characteristic far field (eq:farfield): Riemann invariants along the normal, one from each side;
// entropy and tangential velocity from upwind, seen from the moving face.
template <int Dim, class T>
struct FarfieldState {
  State<Dim, T> w;
  T p;
};

template <int Dim, class T, class G>
FarfieldState<Dim, T> farfield_state(const State<Dim, T>& interior, const State<Dim, T>& outside,
                                     const Vec<G, Dim>& normal, const G& sweep, double gamma) {
  const G area = sqrt(dot(normal, normal));
  const Vec<G, Dim> n = (G(1.0) / area) * normal;
  const G face_speed = sweep / area;

  const T p_in = pressure<Dim, T>(interior, gamma);
  const T p_out = pressure<Dim, T>(outside, gamma);
  const T c_in = sqrt(gamma * p_in / interior[0]);
  const T c_out = sqrt(gamma * p_out / outside[0]);
  const Vec<T, Dim> u_in = velocity<Dim>(interior);
  const Vec<T, Dim> u_out = velocity<Dim>(outside);
  const T q_in = dot(u_in, n);
  const T q_out = dot(u_out, n);

  // Invariants of the two sides in excess of the outside's; supersonic relative to the face, both
  // come from one side.
  const double g = 2.0 / (gamma - 1.0);
  const T q_relative = q_in - face_speed;
  const T dq = q_in - q_out, dc = c_in - c_out;
  const T leaving = select(q_relative < -c_in, T(0.0), dq + g * dc);
  const T entering = select(c_in < q_relative, dq - g * dc, T(0.0));
  const T q = q_out + 0.5 * (leaving + entering);
  const T c = c_out + 0.25 * (gamma - 1.0) * (leaving - entering);

  const auto outflow = T(0.0) < q - face_speed;
  const T density_up = select(outflow, interior[0], outside[0]);
  const T p_up = select(outflow, p_in, p_out);
  const T c_up = select(outflow, c_in, c_out);
  const T q_up = select(outflow, q_in, q_out);
  // Isentropic change from upwind: rho ~ c^(2/(gamma-1)).
  const T ratio = c / c_up;
  const T density = density_up * power(ratio, g);
  const T p = p_up * (density / density_up) * ratio * ratio;
  Vec<T, Dim> u;
  for (int d = 0; d < Dim; ++d) u[d] = select(outflow, u_in[d], u_out[d]) + (q - q_up) * n[d];
  return {conservative<Dim, T>(density, u, p, gamma), p};
}

template <int Dim, class T, class G>
State<Dim, T> farfield_flux(const State<Dim, T>& interior, const State<Dim, T>& outside,
                            const Vec<G, Dim>& normal, const G& sweep, double gamma) {
  const auto boundary = farfield_state<Dim, T, G>(interior, outside, normal, sweep, gamma);
  return euler_flux<Dim, T, G>(boundary.w, boundary.p, normal, sweep);
}

// A face of a physical boundary with its normal and sweep out of the flow.
template <int Dim, class S, class Geometry>
MovedFace<Dim, S> outward_face(const Geometry& geometry, const RigidMotion<S>& motion,
                               const BoundaryFace& boundary) {
  const auto face = moved_face<Dim, S>(geometry, motion, boundary.direction, boundary.face);
  return {boundary.outward * face.normal, boundary.outward * face.sweep};
}

// Flux out through a face of a physical boundary, in excess of the free stream's (eq:excess-flux), from
// the state and pressure of the cell there and the pressure of the one behind it.
template <int Dim, class S>
State<Dim, S> boundary_flux(BoundaryType type, const State<Dim, S>& w, const S& p_first, const S& p_second,
                            const MovedFace<Dim, S>& outward, const Freestream<Dim, S>& freestream) {
  const UniformFlow<Dim, S> uniform = freestream.flow();
  if (type == BoundaryType::farfield) {
    const auto at_face =
        farfield_state<Dim, S, S>(w, uniform.w, outward.normal, outward.sweep, freestream.gamma);
    return excess_flux<Dim, S>(at_face.w, at_face.p, uniform, outward.normal, outward.sweep);
  }
  return wall_flux<Dim, S, S>(wall_pressure<S>(p_first, p_second), outward.normal, outward.sweep) -
         euler_flux<Dim, S, S>(uniform.w, uniform.p, outward.normal, outward.sweep);
}

}  // namespace wingbeat
