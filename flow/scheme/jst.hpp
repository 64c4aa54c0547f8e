#pragma once

#include <array>

#include "flow/gas.hpp"

namespace wingbeat {

// Coefficients of the scalar Jameson-Schmidt-Turkel dissipation (doi:10.2514/6.1981-1259).
struct JstCoefficients {
  double k2 = 0.25;
  double k4 = 1.0 / 64.0;
  double smoothing = 1.0;  // sigma: 0 gives the classical switches

  // Sensor level at which the fourth difference switches off.
  double threshold() const { return k4 / k2; }
};

// |x| rounded off over a width and without bias at large |x|; |x| itself where width is 0.
template <class T>
T rounded_abs(const T& x, const T& width) {
  return sqrt(x * x + width * width) - width;
}

// Pressure sensor of a cell from its two neighbours in line (eq:jst-sensor).
template <class T>
T pressure_sensor(const T& p_minus, const T& p, const T& p_plus, const JstCoefficients& jst) {
  const T sum = p_plus + 2.0 * p + p_minus;
  const T difference = p_plus - 2.0 * p + p_minus;
  if (jst.smoothing == 0.0) return abs(difference) / sum;
  return rounded_abs<T>(difference, jst.smoothing * jst.threshold() * sum) / sum;
}

// max(a, b), rounded where the two are close (eq:jst-switch).
template <class T>
T rounded_max(const T& a, const T& b, const JstCoefficients& jst) {
  if (jst.smoothing == 0.0) return max(a, b);
  return 0.5 * (a + b + rounded_abs<T>(a - b, T(jst.smoothing * jst.threshold())));
}

// max(0, k4 - e2), rounded at the switch (eq:jst-switch).
template <class T>
T fourth_difference_coefficient(const T& e2, const JstCoefficients& jst) {
  const T z = jst.k4 - e2;
  if (jst.smoothing == 0.0) return max(T(0.0), z);
  const double width = jst.smoothing * jst.k4;
  return 0.5 * (z + sqrt(z * z + width * width));
}

// What the scheme reads of the four cells in line with a face: ordered along the face normal,
// the face between cells 1 and 2. Radii are the scaled spectral radii of cells 1 and 2 in the
// direction of the face. The number type P of pressures and radii may differ from that of states.
template <int Dim, class T, class P = T>
struct FaceStencil {
  Vec<State<Dim, T>, 4> w;
  Vec<P, 4> p;
  Vec<P, 2> radius;
};

// Weights of the second and fourth differences at a face, spectral radius included (eq:jst-switch).
template <class T>
struct JstWeights {
  T second;
  T fourth;
};

template <class T>
JstWeights<T> jst_weights(const T& sensor_left, const T& sensor_right, const Vec<T, 2>& radius,
                          const JstCoefficients& jst) {
  const T mean_radius = 0.5 * (radius[0] + radius[1]);
  const T e2 = jst.k2 * rounded_max(sensor_left, sensor_right, jst);
  return {mean_radius * e2, mean_radius * fourth_difference_coefficient(e2, jst)};
}

// Differences across the face as coefficients of the four cells: what the dissipation, linear in
// (rho, rho u, rho H) at given weights, is differentiated by.
inline constexpr std::array<double, 4> first_difference{0.0, -1.0, 1.0, 0.0};
inline constexpr std::array<double, 4> third_difference{-1.0, 3.0, -3.0, 1.0};

// Dissipative flux d of (rho, rho u, rho H) (eq:jst).
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

// Numerical flux F - d through an interior face, F in excess of a uniform flow's (none by default):
// mean of the two cells' fluxes less the dissipation.
template <int Dim, class T>
State<Dim, T> jst_flux(const FaceStencil<Dim, T>& cells, const T& sensor_left, const T& sensor_right,
                       const Vec<T, Dim>& normal, const T& sweep, const JstCoefficients& jst,
                       const UniformFlow<Dim, T>& uniform = {}) {
  State<Dim, T> flux = excess_flux<Dim, T>(cells.w[1], cells.p[1], uniform, normal, sweep) +
                       excess_flux<Dim, T>(cells.w[2], cells.p[2], uniform, normal, sweep);
  flux *= 0.5;
  flux -= jst_dissipation<Dim>(cells, jst_weights(sensor_left, sensor_right, cells.radius, jst));
  return flux;
}

}  // namespace wingbeat
