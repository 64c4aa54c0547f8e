#pragma once

#include "flow/moved_face.hpp"
#include "flow/scheme/face_stencil.hpp"
#include "flow/scheme/limiter.hpp"

namespace wingbeat {

// Gas on one side of a face.
template <int Dim, class T>
struct GasState {
  T density;
  Vec<T, Dim> u;
  T p;

  State<Dim, T> state(double gamma) const { return conservative<Dim, T>(density, u, p, gamma); }
};

// Differences of gas states are kept beside the states themselves, and differences of what follows
// from them are formed by the product rule, exact with means of the two ends: in the large cells of
// the far field the residual's round-off then scales with the differences, not with the flow.
template <int Dim, class T>
GasState<Dim, T> halfway(const GasState<Dim, T>& from, const GasState<Dim, T>& change) {
  return {from.density + 0.5 * change.density, from.u + 0.5 * change.u, from.p + 0.5 * change.p};
}

// Change of the conservative state from one end of `change` to the other.
template <int Dim, class T>
State<Dim, T> state_change(const GasState<Dim, T>& middle, const GasState<Dim, T>& change, double gamma) {
  const Vec<T, Dim> momentum = middle.density * change.u + change.density * middle.u;
  const Vec<T, Dim> mean_momentum = middle.density * middle.u + (0.25 * change.density) * change.u;
  State<Dim, T> result;
  result[0] = change.density;
  for (int d = 0; d < Dim; ++d) result[1 + d] = momentum[d];
  result[Dim + 1] = change.p / (gamma - 1.0) + 0.5 * (dot(mean_momentum, change.u) + dot(middle.u, momentum));
  return result;
}

// The same of the flux through a face (eq:euler-ale), its energy row written as
// gamma/(gamma-1) p V + 1/2 rho V |u|^2 + p s, V = u . n - s.
template <int Dim, class T>
State<Dim, T> flux_change(const GasState<Dim, T>& middle, const GasState<Dim, T>& change,
                          const MovedFace<Dim, T>& face, double gamma) {
  const T through = dot(middle.u, face.normal) - face.sweep, through_change = dot(change.u, face.normal);
  const T mass = middle.density * through_change + change.density * through;
  const T mean_mass = middle.density * through + 0.25 * change.density * through_change;
  const T mean_square = dot(middle.u, middle.u) + 0.25 * dot(change.u, change.u);
  State<Dim, T> result;
  result[0] = mass;
  for (int d = 0; d < Dim; ++d)
    result[1 + d] = mean_mass * change.u[d] + mass * middle.u[d] + change.p * face.normal[d];
  result[Dim + 1] = gamma / (gamma - 1.0) * (middle.p * through_change + change.p * through) +
                    mean_mass * dot(middle.u, change.u) + 0.5 * mean_square * mass + change.p * face.sweep;
  return result;
}

// States on the two sides of a face and what they differ by from the cells there and each other.
template <int Dim, class T>
struct FaceStates {
  GasState<Dim, T> left;
  GasState<Dim, T> right;
  GasState<Dim, T> left_change;   // left less cell 1
  GasState<Dim, T> right_change;  // right less cell 2
  GasState<Dim, T> jump;          // right less left
};

// Quantity of N components beside a face (eq:muscl), by the same differences.
template <class T, int N>
struct FaceValues {
  Vec<T, N> left;
  Vec<T, N> right;
  Vec<T, N> left_change;
  Vec<T, N> right_change;
  Vec<T, N> jump;
};
template <class T, int N>
FaceValues<T, N> face_values(const Vec<Vec<T, N>, 4>& q, Limiter limiter, double smooth_squared) {
  const Vec<T, N> across = q[2] - q[1];
  const Vec<T, N> left = limited_increment(limiter, q[1] - q[0], across, smooth_squared);
  const Vec<T, N> right = -limited_increment(limiter, q[3] - q[2], across, smooth_squared);
  return {q[1] + left, q[2] + right, left, right, across + (right - left)};
}

// States on the two sides of a face: density, velocity and pressure, each limited by itself
// (eq:muscl; B. van Leer, doi:10.1016/0021-9991(79)90145-1).
template <int Dim, class T>
FaceStates<Dim, T> face_states(const FaceStencil<Dim, T>& cells, Limiter limiter, double gamma) {
  Vec<Vec<T, 1>, 4> density, p;
  Vec<Vec<T, Dim>, 4> u;
  for (int k = 0; k < 4; ++k) {
    density[k][0] = cells.w[k][0];
    u[k] = velocity<Dim>(cells.w[k]);
    p[k][0] = cells.p[k];
  }
  // The free stream's density and pressure are 1, its speed of sound is sqrt(gamma).
  constexpr double smooth_squared = smooth_share * smooth_share;
  const auto rho = face_values(density, limiter, smooth_squared);
  const auto v = face_values(u, limiter, gamma * smooth_squared);
  const auto q = face_values(p, limiter, smooth_squared);
  return {{rho.left[0], v.left, q.left[0]},
          {rho.right[0], v.right, q.right[0]},
          {rho.left_change[0], v.left_change, q.left_change[0]},
          {rho.right_change[0], v.right_change, q.right_change[0]},
          {rho.jump[0], v.jump, q.jump[0]}};
}

// What the mean of the cells' fluxes exceeds that of the face states' by: the part of d that turns
// the central flux into one of the reconstruction.
template <int Dim, class T>
State<Dim, T> flux_beyond_face_states(const FaceStates<Dim, T>& states, const MovedFace<Dim, T>& face,
                                      double gamma) {
  const auto change = [&](const GasState<Dim, T>& end, const GasState<Dim, T>& by) {
    const GasState<Dim, T> back{-by.density, -by.u, -by.p};
    return flux_change(halfway(end, back), back, face, gamma);
  };
  return 0.5 * (change(states.left, states.left_change) + change(states.right, states.right_change));
}

}  // namespace wingbeat
