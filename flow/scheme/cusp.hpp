#pragma once

#include "flow/scheme/characteristics.hpp"

namespace wingbeat {

// Jameson's convective upwind and split pressure scheme in total enthalpy, H-CUSP, between states
// of symmetric limited positivity, SLIP (A. Jameson, Int. J. Comput. Fluid Dyn. 4 and 5, 1995).
// Keeps uniform total enthalpy, contacts at rest on the face, and steady shocks of one inner cell.
struct CuspScheme {
  static constexpr bool uses_radii = false;

  // Diffusive flux d (eq:cusp).
  template <int Dim, class T>
  State<Dim, T> dissipation(const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>& face,
                            const UniformFlow<Dim, T>& /*uniform*/, double gamma) const;
};

// State with total enthalpy in the last row: (rho, rho u, rho H).
template <int Dim, class T>
State<Dim, T> with_enthalpy(State<Dim, T> w, const T& p) {
  w[Dim + 1] += p;
  return w;
}

// Share D of the mean of two differences that the limited average keeps (eq:slip), one for all
// variables: what is linear in them, uniform enthalpy or the velocity and pressure of a contact,
// outlives the limiter. The differences' size is that of density, momentum at given density and
// pressure, in units of the free stream; it knows neither frame nor direction.
template <int Dim, class T>
T slip_share(const FaceStencil<Dim, T>& cells, double gamma) {
  const T inverse_density = 1.0 / (cells.w[1][0] + cells.w[2][0]);
  Vec<T, Dim> u;
  for (int d = 0; d < Dim; ++d) u[d] = inverse_density * (cells.w[1][1 + d] + cells.w[2][1 + d]);
  const auto difference = [&](int from) {
    State<Dim, T> q = cells.w[from + 1] - cells.w[from];
    for (int d = 0; d < Dim; ++d) q[1 + d] = (1.0 / std::sqrt(gamma)) * (q[1 + d] - u[d] * q[0]);
    q[Dim + 1] = cells.p[from + 1] - cells.p[from];
    return q;
  };
  const auto ahead = difference(2), behind = difference(0), change = ahead - behind;
  constexpr double smooth_squared = smooth_share * smooth_share;
  const T ahead_squared = dot(ahead, ahead), behind_squared = dot(behind, behind);
  // |ahead| |behind|, rounded off where either vanishes.
  const T product = sqrt(ahead_squared * behind_squared + smooth_squared * smooth_squared) - smooth_squared;
  return 1.0 - dot(change, change) / (ahead_squared + behind_squared + 2.0 * product + smooth_squared);
}

template <int Dim, class T>
State<Dim, T> CuspScheme::dissipation(const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>& face,
                                      const UniformFlow<Dim, T>&, double gamma) const {
  // The sides of the face: density, momentum and total enthalpy are moved towards each other.
  Vec<State<Dim, T>, 4> w;
  for (int k = 0; k < 4; ++k) w[k] = with_enthalpy<Dim, T>(cells.w[k], cells.p[k]);
  const T weight = 0.25 * slip_share<Dim, T>(cells, gamma);
  const State<Dim, T> increment = weight * ((w[3] - w[2]) + (w[1] - w[0]));
  const State<Dim, T> w_left = w[1] + increment, w_right = w[2] - increment;
  const auto gas = [&](const State<Dim, T>& side) {
    const Vec<T, Dim> u = velocity<Dim>(side);
    return GasState<Dim, T>{side[0], u, (gamma - 1.0) / gamma * (side[Dim + 1] - 0.5 * side[0] * dot(u, u))};
  };
  const GasState<Dim, T> left = gas(w_left), right = gas(w_right);

  // Speeds of the pressure waves of (rho, rho u, rho H) at |V|, V the mean speed through the face.
  const auto unit = unit_face(face);
  const auto mean = roe_average(left, right, gamma);
  const T through = dot(mean.u, unit.normal) - unit.speed;
  const T size = abs(through);
  const double half = 0.5 * (gamma - 1.0) / gamma;
  const T root = sqrt(half * half * through * through + mean.sound_speed_squared / gamma);
  const T slow = 0.5 * (gamma + 1.0) / gamma * size - root;
  const T share = 1.0 / (size - slow);
  const T of_fluxes = min<T>(max<T>((size + slow) * share, T(0.0)), T(1.0));
  const T of_states = max<T>(min<T>(size, -2.0 * size * slow * share), T(0.0));
  const T signed_share = select(through < T(0.0), -of_fluxes, of_fluxes);

  const auto flux = [&](const State<Dim, T>& side, const GasState<Dim, T>& state) {
    State<Dim, T> result = (dot(state.u, unit.normal) - unit.speed) * side;
    for (int d = 0; d < Dim; ++d) result[1 + d] += state.p * unit.normal[d];
    result[Dim + 1] += state.p * unit.speed;
    return result;
  };
  const State<Dim, T> difference = of_states * (w_right - w_left);
  return 0.5 * unit.area * (difference + signed_share * (flux(w_right, right) - flux(w_left, left)));
}

}  // namespace wingbeat
