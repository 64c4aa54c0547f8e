#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "core/mesh/airfoil.hpp"
#include "core/mesh/conformal_map.hpp"

namespace wingbeat {

// The smooth curve that the inverse Karman-Trefftz transformation makes of a section, in polar
// coordinates about its centre: zeta = centre + exp(log_radius - i angle), the angle clockwise.
// It is traversed by the eccentric angle e in (0, 2 pi), t = -cos(e/2), in which it is regular at
// the nose and at the trailing edge.
class NearCircle {
 public:
  struct Polar {
    double angle = 0.0;
    double log_radius = 0.0;
    double angle_slope = 0.0;  // d(angle)/de
  };

  // Throws InputError if the curve is not star-shaped about its centre. `airfoil` must outlive it.
  explicit NearCircle(const Airfoil& airfoil);

  Polar at(double eccentric) const;
  // Moves `eccentric`, a guess within (0, 2 pi), to the point seen at `angle`. Returns log_radius.
  double find(double angle, double& eccentric) const;
  // Angle at which the trailing edge is seen.
  double trailing_edge_angle() const { return trailing_edge_angle_; }
  double trailing_edge_log_radius() const { return trailing_edge_log_radius_; }

  const KarmanTrefftz& corner() const { return corner_; }
  std::complex<double> centre() const { return centre_; }

  static double curve_parameter(double eccentric) { return -std::cos(0.5 * eccentric); }

 private:
  struct Image {
    std::complex<double> zeta;
    std::complex<double> slope;  // d(zeta)/de
  };
  Image image(double eccentric) const;
  void tabulate_branch();
  void find_centre();
  void check_star_shaped() const;

  const Airfoil& airfoil_;
  KarmanTrefftz corner_;
  std::vector<double> branch_;  // argument of (z - edge)/(z - focus), continuous along the section
  std::complex<double> centre_;
  double trailing_edge_angle_ = 0.0;
  double trailing_edge_log_radius_ = 0.0;
};

}  // namespace wingbeat
