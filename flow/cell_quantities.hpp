#pragma once

#include "flow/gas.hpp"
#include "flow/motion.hpp"

namespace wingbeat {

// Spectral radii of one cell in each direction,
//   lambda_d = |u . S_d - sweep_d| + c |S_d|  (eq:spectral-radius),
// with S_d and sweep_d the means of the cell's two faces in direction d.
template <int Dim, class T, class G>
Vec<T, Dim> spectral_radii(const State<Dim, T>& w, const T& p, const Vec<Vec<G, Dim>, Dim>& normals,
                           const Vec<G, Dim>& sweeps, double gamma) {
  const Vec<T, Dim> u = velocity<Dim>(w);
  const T c = sqrt(gamma * p / w[0]);
  Vec<T, Dim> lambda;
  for (int d = 0; d < Dim; ++d) {
    const G area = sqrt(dot(normals[d], normals[d]));
    lambda[d] = abs<T>(dot(u, normals[d]) - sweeps[d]) + c * area;
  }
  return lambda;
}

// The radii scaled for cells of high aspect ratio (eq:jst-radius):
//   radius_d = lambda_d (1 + sum over the other directions e of (lambda_e / lambda_d)^(2/3)).
// The power is taken once a pair: the other direction's is its reciprocal.
template <int Dim, class T>
Vec<T, Dim> scaled_radii(const Vec<T, Dim>& lambda) {
  Vec<T, Dim> scale;
  for (int d = 0; d < Dim; ++d) scale[d] = T(1.0);
  for (int d = 0; d < Dim; ++d)
    for (int e = d + 1; e < Dim; ++e) {
      const T ratio = power_two_thirds(lambda[e] / lambda[d]);
      scale[d] += ratio;
      scale[e] += 1.0 / ratio;
    }
  for (int d = 0; d < Dim; ++d) scale[d] *= lambda[d];
  return scale;
}

}  // namespace wingbeat
