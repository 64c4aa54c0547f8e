#pragma once

#include <span>
#include <vector>

#include "structure/structural_equation.hpp"

namespace wingbeat {

// What the staggered iteration does to the structure between two visits to the flow
// (eq:staggered). States y and forces f are laid out as in StructuralEquation. All functions are pure.

// One linearised implicit step in pseudo-time at fixed forces: y + dy with
//   (P/dtau + dS/dy) dy = -S(y),
// P/dtau = 1/dtau (implicit Euler) for what fluctuates, A for the mean over the instances, which so
// goes half the way to equilibrium. A: eq:first-order-form.
std::vector<double> structural_step(const StructuralEquation& structure, std::span<const double> y,
                                    double omega, double load, std::span<const double> f, double dtau);

// y_mean + c (y - y_mean) with the c > 0 that makes E_fl the energy given. y must move.
std::vector<double> scaled_to_energy(const StructureModel& model, std::span<const double> y, double energy);

// The same cycle begun at the phase where the first harmonic of the phase mode is a sine of positive
// amplitude, so that Y = 0. Throws InputError where that harmonic is at rest.
std::vector<double> shifted_to_phase(const StructureModel& model, const TimeSpectral& time,
                                     std::span<const double> y);

struct FrequencyAndLoad {
  double omega = 0.0;
  double load = 0.0;  // c V^2
};

// omega and load that make the norm of the fluctuating part of S least, at given y and f
// (eq:frequency-and-speed). The mean part has no say: static loads, which do not shrink with the
// amplitude, would drown the others.
FrequencyAndLoad fitted_frequency_and_load(const StructuralEquation& structure, std::span<const double> y,
                                           std::span<const double> f);
// The same with the load given (eq:frequency-at-speed).
double fitted_frequency(const StructuralEquation& structure, std::span<const double> y,
                        std::span<const double> f, double load);

}  // namespace wingbeat
