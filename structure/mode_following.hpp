#pragma once

#include <Eigen/Dense>
#include <functional>
#include <span>

#include "structure/pk.hpp"

namespace wingbeat {

// The 2m solutions of [p^2 M + p C + K] u = 0 with complex C and K, in no order.
struct MotionSpectrum {
  Eigen::VectorXcd p;
  Eigen::MatrixXcd modes;  // m x 2m, columns u of unit norm
};
MotionSpectrum motion_spectrum(const Eigen::MatrixXd& inverse_mass, const Eigen::MatrixXcd& damping,
                               const Eigen::MatrixXcd& stiffness);

// The spectrum at a speed V with the aerodynamics of reduced frequency k, which may be negative or
// outside [k_min, k_max].
using SpectrumAt = std::function<MotionSpectrum(double reduced_velocity, double k)>;

// The modes whose own reduced frequency Im p/(2V) is the k their spectrum was formed at, followed from the
// vacuum modes at V = 0 over ascending speeds, with the places where Re p changes sign. Steps in V are
// halved until each mode lies much nearer to its own past than to the others.
PkResult follow_modes(const StructureModel& model, const SpectrumAt& spectrum, double k_min, double k_max,
                      std::span<const double> reduced_velocities, const PkOptions& options);

// Q held at the ends of [k_min, k_max]; Q(-k) is the conjugate of Q(k).
Eigen::MatrixXcd held(const AerodynamicMatrix& q, double k, double k_min, double k_max);

}  // namespace wingbeat
