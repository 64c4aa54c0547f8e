#pragma once

#include "flow/scheme/characteristics.hpp"
#include "flow/scheme/jst.hpp"

namespace wingbeat {

// Matrix dissipation of Swanson and Turkel (doi:10.1016/0021-9991(92)90007-L): the differences of
// the scalar scheme, each wave damped by its own speed.
struct MatrixScheme {
  static constexpr bool uses_radii = false;

  double k2 = 0.5;  // upwind where the sensor is 1
  double k4 = 1.0 / 64.0;
  double smoothing = 1.0;  // sigma, as in the scalar scheme
  // Least speeds of the waves as shares of the largest, that of the fast acoustic wave.
  double acoustic_floor = 0.25;
  double linear_floor = 0.025;

  // Dissipative flux d of the conservative variables (eq:matrix).
  template <int Dim, class T>
  State<Dim, T> dissipation(const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>& face,
                            const UniformFlow<Dim, T>& /*uniform*/, double gamma) const {
    const JstScheme switches{k2, k4, smoothing};
    const T e2 = k2 * rounded_max<T>(sensor(cells.p[0], cells.p[1], cells.p[2]),
                                     sensor(cells.p[1], cells.p[2], cells.p[3]), switches);
    const T e4 = fourth_difference_coefficient<T>(e2, switches);
    State<Dim, T> difference;
    for (int v = 0; v < state_size<Dim>; ++v) {
      const T first = cells.w[2][v] - cells.w[1][v];
      difference[v] = e2 * first - e4 * (cells.w[3][v] - cells.w[0][v] - 3.0 * first);
    }

    const State<Dim, T> w = 0.5 * (cells.w[1] + cells.w[2]);
    MeanFlow<Dim, T> mean;
    mean.u = velocity<Dim>(w);
    mean.sound_speed_squared = 0.5 * gamma * (cells.p[1] + cells.p[2]) / w[0];
    mean.enthalpy = mean.sound_speed_squared / (gamma - 1.0) + 0.5 * dot(mean.u, mean.u);
    const auto unit = unit_face(face);
    const T c = sqrt(mean.sound_speed_squared);
    const T through = dot(mean.u, unit.normal) - unit.speed;
    const T largest = abs(through) + c;
    const WaveSpeeds<T> speeds{floored_abs<T>(through, linear_floor * largest),
                               floored_abs<T>(through - c, acoustic_floor * largest),
                               floored_abs<T>(through + c, acoustic_floor * largest)};
    return unit.area * absolute_jacobian<Dim, T>(mean, c, unit.normal, speeds, difference, gamma);
  }

  // Pressure sensor of a cell from its two neighbours in line (eq:matrix-sensor): between the scalar
  // scheme's and one that is 1 at every kink.
  template <class T>
  T sensor(const T& p_minus, const T& p, const T& p_plus) const {
    const T sum = p_plus + 2.0 * p + p_minus;
    const T ahead = p_plus - p, behind = p - p_minus;
    const T size = smoothing == 0.0 ? abs<T>(ahead - behind)
                                    : rounded_abs<T>(ahead - behind, smoothing * (k4 / k2) * sum);
    return 2.0 * size / (sum + abs(ahead) + abs(behind));
  }
};

}  // namespace wingbeat
