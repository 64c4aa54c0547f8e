#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "core/spectral/time_spectral.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

// The two scalar rows that close the periodic problem: a phase, since a period has no beginning,
// and an amplitude, since a linear cycle has no size.

// A linear functional of the states: value = coefficients . y - offset.
struct HarmonicCondition {
  std::vector<double> coefficients;
  double offset = 0.0;
};

// Y = (2/N) sum_n u_n cos theta_n of the phase mode                     (eq:phase-condition)
HarmonicCondition phase_condition(const StructureModel& model, const TimeSpectral& time);

// (2/(N A)) sum_n u_n sin theta_n - 1 of a mode: with no cosine, its first harmonic is A sin theta.
// Throws InputError unless A > 0 and there is a first harmonic.
HarmonicCondition first_harmonic_condition(const StructureModel& model, const TimeSpectral& time, int mode,
                                           double amplitude);

// E_fl/E_0 - 1                                                          (eq:energy-condition)
struct EnergyCondition {
  StructureModel model;
  double energy = 0.0;  // E_0
};
// Throws InputError unless E_0 > 0.
EnergyCondition energy_condition(const StructureModel& model, double energy);

// The row that picks one cycle of a branch: of an energy, of a speed, or on a line across both
// (eq:cycle-row): by_energy (E_fl/E_0 - 1) + by_speed (V/V_0 - 1).
struct CycleCondition {
  EnergyCondition energy;         // E_0 is also what the unknowns are scaled by
  double reduced_velocity = 1.0;  // V_0
  double by_energy = 1.0;
  double by_speed = 0.0;

  CycleCondition(EnergyCondition of) : energy(std::move(of)) {}
};

// True of a solution that answers a given speed by rest, which solves all other rows at any speed: its energy
// has vanished beside E_0, which was near that of the start.
bool is_at_rest(const CycleCondition& condition, std::span<const double> y);

using AmplitudeCondition = std::variant<EnergyCondition, HarmonicCondition>;

double value(const AmplitudeCondition& condition, std::span<const double> y);
// gradient += scale d(value)/dy.
void add_gradient(const AmplitudeCondition& condition, std::span<const double> y, double scale,
                  std::span<double> gradient);

}  // namespace wingbeat
