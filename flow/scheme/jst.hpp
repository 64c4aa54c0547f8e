#pragma once

#include <array>

#include "flow/moved_face.hpp"
#include "flow/scheme/face_stencil.hpp"

namespace wingbeat {

// Scalar dissipation of Jameson, Schmidt and Turkel (doi:10.2514/6.1981-1259).
struct JstScheme {
  static constexpr bool uses_radii = true;

  double k2 = 0.25;
  double k4 = 1.0 / 64.0;
  double smoothing = 1.0;  // sigma: 0 gives the classical switches

  // Sensor level at which the fourth difference switches off.
  double threshold() const { return k4 / k2; }

  // Dissipative flux d of (rho, rho u, rho H) (eq:jst).
  template <int Dim, class T>
  State<Dim, T> dissipation(const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>& /*face*/,
                            const UniformFlow<Dim, T>& /*uniform*/, double /*gamma*/) const;
};

// |x| rounded off over a width and without bias at large |x|; |x| itself where width is 0.
template <class T>
T rounded_abs(const T& x, const T& width) {
  return sqrt(x * x + width * width) - width;
}

// Pressure sensor of a cell from its two neighbours in line (eq:jst-sensor).
template <class T>
T pressure_sensor(const T& p_minus, const T& p, const T& p_plus, const JstScheme& jst) {
  const T sum = p_plus + 2.0 * p + p_minus;
  const T difference = p_plus - 2.0 * p + p_minus;
  if (jst.smoothing == 0.0) return abs(difference) / sum;
  return rounded_abs<T>(difference, jst.smoothing * jst.threshold() * sum) / sum;
}

// max(a, b), rounded where the two are close (eq:jst-switch).
template <class T>
T rounded_max(const T& a, const T& b, const JstScheme& jst) {
  if (jst.smoothing == 0.0) return max(a, b);
  return 0.5 * (a + b + rounded_abs<T>(a - b, T(jst.smoothing * jst.threshold())));
}

// max(0, k4 - e2), rounded at the switch (eq:jst-switch).
template <class T>
T fourth_difference_coefficient(const T& e2, const JstScheme& jst) {
  const T z = jst.k4 - e2;
  if (jst.smoothing == 0.0) return max(T(0.0), z);
  const double width = jst.smoothing * jst.k4;
  return 0.5 * (z + sqrt(z * z + width * width));
}

// Weights of the second and fourth differences at a face, spectral radius included (eq:jst-switch).
template <class T>
struct JstWeights {
  T second;
  T fourth;
};

template <int Dim, class T, class P>
JstWeights<P> jst_weights(const FaceStencil<Dim, T, P>& cells, const JstScheme& jst) {
  const P mean_radius = 0.5 * (cells.radius[0] + cells.radius[1]);
  const P left = pressure_sensor(cells.p[0], cells.p[1], cells.p[2], jst);
  const P right = pressure_sensor(cells.p[1], cells.p[2], cells.p[3], jst);
  const P e2 = jst.k2 * rounded_max(left, right, jst);
  return {mean_radius * e2, mean_radius * fourth_difference_coefficient(e2, jst)};
}

// Differences across the face as coefficients of the four cells: what the dissipation, linear in
// (rho, rho u, rho H) at given weights, is differentiated by.
inline constexpr std::array<double, 4> first_difference{0.0, -1.0, 1.0, 0.0};
inline constexpr std::array<double, 4> third_difference{-1.0, 3.0, -3.0, 1.0};

// The dissipation at given weights.
template <int Dim, class T, class P>
State<Dim, P> jst_dissipation(const FaceStencil<Dim, T, P>& cells, const JstWeights<P>& weights) {
  State<Dim, P> dissipation;
  for (int v = 0; v < state_size<Dim>; ++v) {
    const T first = cells.w[2][v] - cells.w[1][v];
    const T third = cells.w[3][v] - cells.w[0][v] - 3.0 * first;
    dissipation[v] = weights.second * first - weights.fourth * third;
  }
  const P first = cells.p[2] - cells.p[1];
  const P third = cells.p[3] - cells.p[0] - 3.0 * first;
  dissipation[Dim + 1] += weights.second * first - weights.fourth * third;
  return dissipation;
}

template <int Dim, class T>
State<Dim, T> JstScheme::dissipation(const FaceStencil<Dim, T>& cells, const MovedFace<Dim, T>&,
                                     const UniformFlow<Dim, T>&, double) const {
  return jst_dissipation<Dim>(cells, jst_weights(cells, *this));
}

}  // namespace wingbeat
