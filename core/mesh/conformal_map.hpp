#pragma once

#include <complex>
#include <span>
#include <vector>

#include "core/mesh/airfoil.hpp"
#include "core/mesh/fourier.hpp"

namespace wingbeat {

// Karman-Trefftz transformation (z - edge)/(z - focus) = ((zeta - 1)/(zeta + 1))^power of the plane
// outside a section to that outside a smooth curve: it opens the corner at the trailing edge.
// Source: Karman & Trefftz, Z. Flugtech. Motorluftschiffahrt 9 (1918).
struct KarmanTrefftz {
  std::complex<double> edge;   // trailing edge: zeta = 1
  std::complex<double> focus;  // half a nose radius behind the nose: zeta = -1
  double power = 2.0;          // 2 - (trailing-edge angle)/pi

  // Physical point of a point outside the smooth curve.
  std::complex<double> physical(std::complex<double> zeta) const;
  // dz/dzeta at infinity.
  std::complex<double> scale() const { return (edge - focus) / (2.0 * power); }
};

// Conformal map of |Z| >= 1 to the outside of a section, the trailing edge at Z = 1:
//   Z -> zeta = centre + Z exp(sum_k c_k Z^-k) -> z,
// the first step by Theodorsen-Garrick iteration for the smooth curve, the second Karman-Trefftz.
// Source: Theodorsen & Garrick, NACA Report 452 (1933); Henrici, SIAM Review 21 (1979) for the use
// of the fast Fourier transform.
class ConformalMap {
 public:
  // `around` equidistant points of the circle are mapped at a time. Throws InputError if the
  // section cannot be mapped.
  ConformalMap(const Airfoil& airfoil, int around);

  // z(r e^{-2 pi i k/around}), k = 0..around-1: from the trailing edge along the lower surface
  // first. `radius` >= 1.
  void ring(double radius, std::span<std::complex<double>> z) const;
  // Curve parameters of the section at the points of radius 1.
  std::span<const double> wall_parameters() const { return wall_parameters_; }
  // |dz/dZ| at infinity, chords.
  double conformal_radius() const;

  int iterations() const { return iterations_; }
  // Last change of the circle-plane angles, radians.
  double last_correction() const { return last_correction_; }

 private:
  KarmanTrefftz corner_;
  std::complex<double> centre_;
  FourierTransform fourier_;  // of `around` points
  std::vector<std::complex<double>> coefficients_;
  std::vector<double> wall_parameters_;
  int iterations_ = 0;
  double last_correction_ = 0.0;
};

}  // namespace wingbeat
