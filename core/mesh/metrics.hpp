#pragma once

#include <array>

#include "core/number/vec.hpp"

// Exact integrals over faces and cells: straight edges in 2-D, bilinear faces in 3-D. T is double, or a
// dual number where nodes move.
namespace wingbeat {

// Area vector, first moment and volume flux of one face with respect to the origin.
template <int Dim, class T = double>
struct FaceMetrics {
  Vec<T, Dim> normal{};  // integral of dS
  T moment_z{};          // z component of the integral of x cross dS
  T volume_flux{};       // integral of x . dS
};

// 2-D face from node a to node b. The normal points to the right of a -> b.
template <class T>
FaceMetrics<2, T> face_metrics(const Vec<T, 2>& a, const Vec<T, 2>& b) {
  FaceMetrics<2, T> face;
  face.normal = {{{b[1] - a[1], a[0] - b[0]}}};
  const Vec<T, 2> centre = 0.5 * (a + b);
  face.moment_z = centre[0] * face.normal[1] - centre[1] * face.normal[0];
  face.volume_flux = dot(centre, face.normal);
  return face;
}

template <class T>
Vec<T, 3> cross(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return {{{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}}};
}

// 3-D bilinear face with corners x(s, t): x00, x10, x01, x11; its normal is along x_s cross x_t.
// Two Gauss points a direction integrate the quadratic integrands exactly (eq:face-moment).
template <class T>
FaceMetrics<3, T> face_metrics(const Vec<T, 3>& x00, const Vec<T, 3>& x10, const Vec<T, 3>& x01,
                               const Vec<T, 3>& x11) {
  constexpr std::array<double, 2> points{0.21132486540518711775, 0.78867513459481288225};
  FaceMetrics<3, T> face;
  for (double s : points)
    for (double t : points) {
      const auto x = (1 - s) * (1 - t) * x00 + s * (1 - t) * x10 + (1 - s) * t * x01 + s * t * x11;
      const auto along_s = (1 - t) * (x10 - x00) + t * (x11 - x01);
      const auto along_t = (1 - s) * (x01 - x00) + s * (x11 - x10);
      const auto area = 0.25 * cross(along_s, along_t);
      face.normal += area;
      face.moment_z += x[0] * area[1] - x[1] * area[0];
      face.volume_flux += dot(x, area);
    }
  return face;
}

}  // namespace wingbeat
