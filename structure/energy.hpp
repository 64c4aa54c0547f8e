#pragma once

#include <span>
#include <vector>

#include "core/spectral/time_spectral.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

// Energies of the states y[n*2m + j] of N instances, on the linear stiffness:
//   E_avg = 1/(2N) sum_n (u_n^T K u_n + u'_n^T M u'_n)                (eq:average-energy)
//   E_fl  = the same of y_n - mean y                                  (eq:fluctuating-energy)
double average_energy(const StructureModel& model, std::span<const double> y);
double fluctuating_energy(const StructureModel& model, std::span<const double> y);

// gradient += scale dE/dy.
void add_average_energy_gradient(const StructureModel& model, std::span<const double> y, double scale,
                                 std::span<double> gradient);
void add_fluctuating_energy_gradient(const StructureModel& model, std::span<const double> y, double scale,
                                     std::span<double> gradient);

// The share of every harmonic 0..N_H in E_avg (Parseval): their sum is E_avg, without the first E_fl.
std::vector<double> harmonic_energies(const StructureModel& model, const TimeSpectral& time,
                                      std::span<const double> y);
// Share of E_fl that the highest harmonic carries.
double highest_harmonic_share(const StructureModel& model, const TimeSpectral& time,
                              std::span<const double> y);

}  // namespace wingbeat
