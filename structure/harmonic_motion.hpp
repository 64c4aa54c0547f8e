#pragma once

#include <Eigen/Dense>
#include <complex>
#include <span>
#include <vector>

#include "core/spectral/time_spectral.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

// States y_n = (u, u') of u = Re(u_hat e^{i theta_n}), u' = omega du/dtheta; u_hat holds m values.
std::vector<double> harmonic_states(const StructureModel& model, const TimeSpectral& time,
                                    const Eigen::VectorXcd& u_hat, double omega);

// Factor e^{-i phase} that turns u_hat so that `mode` is a sine of positive amplitude,
// u_hat[mode] = -i a, a > 0. Throws InputError where that mode is at rest.
std::complex<double> turn_to_sine(const StructureModel& model, const Eigen::VectorXcd& u_hat, int mode);

// u_hat turned and scaled so that E_fl of its motion is `energy` and its phase mode is a sine
// of positive amplitude: u_hat[phase_mode] = -i a, a > 0. Throws InputError where that mode is at rest.
Eigen::VectorXcd scaled_to_energy(const StructureModel& model, const Eigen::VectorXcd& u_hat, double omega,
                                  double energy);
// The same with u_hat[mode] = -i amplitude, for any mode.
Eigen::VectorXcd scaled_to_amplitude(const StructureModel& model, const Eigen::VectorXcd& u_hat, int mode,
                                     double amplitude);

// First-harmonic coefficients of the m displacements: u = ... + Re(u_1 e^{i theta}) + ...
Eigen::VectorXcd first_harmonic(const StructureModel& model, const TimeSpectral& time,
                                std::span<const double> y);

}  // namespace wingbeat
