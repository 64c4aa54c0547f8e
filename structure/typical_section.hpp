#pragma once

#include <array>

#include "structure/structure_model.hpp"

namespace wingbeat {

// What a spring adds to its linear part, u in semichords (plunge) or radians (pitch) and forces in the
// units of the mode's row of K.
struct SectionSpring {
  double cubic = 0.0;     // of u^3  (eq:polynomial-spring)
  double quintic = 0.0;   // of u^5
  double freeplay = 0.0;  // half the dead zone of the linear spring; 0: none  (eq:freeplay-spring)
};

// Two-degree-of-freedom section on springs: plunge h/b, positive down, and pitch alpha, positive
// nose-up, both at the elastic axis. Lengths in semichords b, time in 1/omega_alpha.
struct TypicalSection {
  double elastic_axis = 0.0;             // a, aft of mid-chord
  double static_unbalance = 0.0;         // x_alpha, centre of gravity aft of the elastic axis
  double gyration_radius_squared = 0.0;  // r_alpha^2, about the elastic axis
  double frequency_ratio = 0.0;          // omega_h/omega_alpha
  double mass_ratio = 0.0;               // mu = m/(pi rho b^2)
  std::array<double, 2> damping{};       // fraction of critical of the vacuum modes, by frequency
  SectionSpring plunge_spring{};
  SectionSpring pitch_spring{};
  double freeplay_smoothing = 0.1;  // rounding of the dead zones' corners over their half widths
};

inline constexpr int plunge_mode = 0;
inline constexpr int pitch_mode = 1;

// Elastic axis in chords from the leading edge, x_ea = (1 + a)/2.
double elastic_axis_in_chords(const TypicalSection& section);

// M = [1 x_a; x_a r_a^2], K = diag((omega_h/omega_alpha)^2, r_a^2), modal damping, c = 4/(pi mu), for
// forces f = (-C_l, 2 C_m) with C_m about the elastic axis; the phase mode is pitch
// (eq:typical-section). Nonlinear springs become restoring forces; K stays that of the
// springs at u = 0 without freeplay. Throws InputError where a value has no physical meaning.
StructureModel structure_model(const TypicalSection& section);

// Flutter speed index V* = 2 V/sqrt(mu) = U/(b omega_alpha sqrt(mu)).
double speed_index(const TypicalSection& section, double reduced_velocity);

}  // namespace wingbeat
