#pragma once

#include "flow/scheme/characteristics.hpp"

namespace wingbeat {

// F+ - F-, the difference of van Leer's split fluxes (Lecture Notes in Physics 170, 1982) per unit
// area: with F+ + F- = F it gives either. Split by the Mach number relative to the face, in whose
// frame energy is split too (eq:van-leer).
template <int Dim, class T>
State<Dim, T> split_flux_difference(const GasState<Dim, T>& gas, const UnitFace<Dim, T>& face, double gamma) {
  const T c = sqrt(gamma * gas.p / gas.density);
  const T through = dot(gas.u, face.normal) - face.speed;
  const T mass = gas.density * through;
  const Vec<T, Dim> along = gas.u - dot(gas.u, face.normal) * face.normal;
  const T tangential = 0.5 * dot(along, along);

  // Subsonic: mass flux, force along the normal and energy in the face's frame.
  const T mass_split = 0.5 * gas.density * (c + through * through / c);
  const T force_split = (gamma - 1.0) / gamma * mass_split * through + 2.0 / gamma * mass * c;
  const T speed_squared = (gamma - 1.0) * (gamma - 1.0) * through * through + 4.0 * c * c;
  const T energy_split = mass_split * (0.5 / (gamma * gamma - 1.0) * speed_squared + tangential) +
                         2.0 / (gamma + 1.0) * mass * through * c;
  // Supersonic: all of it goes one way.
  const T sign = select(through < T(0.0), T(-1.0), T(1.0));
  const T enthalpy = c * c / (gamma - 1.0) + 0.5 * through * through + tangential;

  const auto subsonic = abs(through) < c;
  const T g = select(subsonic, mass_split, sign * mass);
  const T force = select(subsonic, force_split, sign * (mass * through + gas.p));
  const T energy = select(subsonic, energy_split, sign * mass * enthalpy);

  // Back to the frame at rest: the face's speed adds momentum to the mass and work to the force.
  State<Dim, T> result;
  result[0] = g;
  for (int d = 0; d < Dim; ++d) result[1 + d] = g * along[d] + (force + g * face.speed) * face.normal[d];
  result[Dim + 1] = energy + face.speed * force + 0.5 * face.speed * face.speed * g;
  return result;
}

// Van Leer's flux-vector splitting of limited states. Spreads contacts.
struct VanLeerScheme {
  static constexpr bool uses_radii = false;

  Limiter limiter = Limiter::van_albada;

  // d of the split flux F+(left) + F-(right) (eq:van-leer).
  template <int Dim, class T>
  State<Dim, T> dissipation(const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>& face,
                            const UniformFlow<Dim, T>& /*uniform*/, double gamma) const {
    const auto states = face_states(cells, limiter, gamma);
    const auto unit = unit_face(face);
    const auto upwind =
        split_flux_difference(states.right, unit, gamma) - split_flux_difference(states.left, unit, gamma);
    return flux_beyond_face_states(states, face, gamma) + 0.5 * unit.area * upwind;
  }
};

}  // namespace wingbeat
