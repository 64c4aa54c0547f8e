#pragma once

#include "flow/scheme/characteristics.hpp"

namespace wingbeat {

// Roe's approximate Riemann solver (doi:10.1016/0021-9991(81)90128-5) between limited states, on
// moving faces.
struct RoeScheme {
  static constexpr bool uses_radii = false;

  Limiter limiter = Limiter::van_albada;
  // Share of the speed of sound below which an acoustic wave's speed is rounded off. Entropy and
  // shear waves keep theirs: a contact at rest on the face stays as it is.
  double entropy_fix = 0.1;

  // d of the upwind flux (eq:roe).
  template <int Dim, class T>
  State<Dim, T> dissipation(const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>& face,
                            const UniformFlow<Dim, T>& /*uniform*/, double gamma) const {
    const auto states = face_states(cells, limiter, gamma);
    const auto unit = unit_face(face);
    const auto mean = roe_average(states.left, states.right, gamma);
    const T c = sqrt(mean.sound_speed_squared);
    const T through = dot(mean.u, unit.normal) - unit.speed;
    const T floor = 0.5 * entropy_fix * c;
    const WaveSpeeds<T> speeds{abs(through), floored_abs<T>(through - c, floor),
                               floored_abs<T>(through + c, floor)};
    const auto jump = state_change(halfway(states.left, states.jump), states.jump, gamma);
    const auto upwind = absolute_jacobian<Dim, T>(mean, c, unit.normal, speeds, jump, gamma);
    return flux_beyond_face_states(states, face, gamma) + 0.5 * unit.area * upwind;
  }
};

}  // namespace wingbeat
