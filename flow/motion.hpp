#pragma once

#include "core/number/math.hpp"
#include "core/number/vec.hpp"

namespace wingbeat {

// Rigid motion of the whole mesh at one instant: pitch nose up about an axis parallel to z, and
// plunge along -y, with their rates on the flow's clock (eq:rigid-motion). Positions do not enter:
// a rigid translation leaves every face's area vector and moment about the axis as they are.
template <class T>
struct RigidMotion {
  T cosine = T(1.0);  // of the pitch angle
  T sine{};
  T pitch_rate{};   // d alpha / d t
  T plunge_rate{};  // d h / d t in chords, positive down

  // Area vector of the rotated face.
  template <int Dim>
  Vec<T, Dim> turned(const Vec<T, Dim>& normal) const {
    Vec<T, Dim> result = normal;
    result[0] = cosine * normal[0] + sine * normal[1];
    result[1] = cosine * normal[1] - sine * normal[0];
    return result;
  }

  // Volume a face sweeps in unit time: integral of v_g . dS over the rotated face, from its area
  // vector and its moment about the axis, which the rotation leaves unchanged.
  template <int Dim>
  T sweep(const Vec<T, Dim>& turned_normal, const T& moment_z) const {
    return -pitch_rate * moment_z - plunge_rate * turned_normal[1];
  }
};

// What a rigid motion depends on: pitch in radians nose up, d alpha / d t and d h / d t (in chords,
// positive down) on the flow's clock.
struct MotionState {
  double pitch = 0.0;
  double pitch_rate = 0.0;
  double plunge_rate = 0.0;
};

inline RigidMotion<double> rigid_motion(const MotionState& m) {
  return {std::cos(m.pitch), std::sin(m.pitch), m.pitch_rate, m.plunge_rate};
}

// The same with seeds 0, 1, 2 on (pitch, pitch_rate, plunge_rate).
inline RigidMotion<Dual<double, 3>> seeded_motion(const MotionState& m) {
  using D = Dual<double, 3>;
  const D pitch = D::seed(m.pitch, 0);
  return {chain(pitch, std::cos(m.pitch), -std::sin(m.pitch)),
          chain(pitch, std::sin(m.pitch), std::cos(m.pitch)), D::seed(m.pitch_rate, 1),
          D::seed(m.plunge_rate, 2)};
}

}  // namespace wingbeat
