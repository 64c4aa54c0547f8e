#pragma once

#include <cmath>
#include <span>

#include "flow/motion.hpp"

namespace wingbeat {

// How the states of a typical section, y_n = (h/b, alpha, (h/b)', alpha') in the structure's time,
// move the mesh on the flow's clock (eq:two-clocks, eq:rigid-motion).
struct SectionKinematics {
  double flow_speed = 0.0;          // U = M sqrt(gamma)
  double mean_pitch = 0.0;          // radians, added to the structural pitch
  double reference_velocity = 1.0;  // V_ref: V = V_ref sqrt(r)

  static constexpr double semichord = 0.5;

  double reduced_velocity(double r) const { return reference_velocity * std::sqrt(r); }
  // Seconds of the structure's clock in one of the flow's: U/V.
  double clock_ratio(double r) const { return flow_speed / reduced_velocity(r); }
  double kappa(double omega, double r) const { return omega * clock_ratio(r); }

  MotionState motion(std::span<const double> y, double r) const {
    const double rate = clock_ratio(r);
    return {mean_pitch + y[1], rate * y[3], semichord * rate * y[2]};
  }
  // The motion that a change dy of the states adds, at given r: linear.
  MotionState motion_change(std::span<const double> dy, double r) const {
    const double rate = clock_ratio(r);
    return {dy[1], rate * dy[3], semichord * rate * dy[2]};
  }
  // Its transpose: adds to dy what multipliers of (pitch, pitch_rate, plunge_rate) contribute.
  void add_motion_adjoint(const MotionState& multipliers, double r, std::span<double> dy) const {
    const double rate = clock_ratio(r);
    dy[1] += multipliers.pitch;
    dy[3] += rate * multipliers.pitch_rate;
    dy[2] += semichord * rate * multipliers.plunge_rate;
  }
  // Rates fall as r grows, at given structural states: d motion / d r.
  MotionState motion_by_r(const MotionState& motion, double r) const {
    return {0.0, -motion.pitch_rate / (2.0 * r), -motion.plunge_rate / (2.0 * r)};
  }
};

}  // namespace wingbeat
