#pragma once

#include <optional>
#include <vector>

#include "structure/motion_estimate.hpp"

namespace wingbeat {

// One period of a march, from one minimum of the phase mode to the next.
struct MarchedPeriod {
  double begin = 0.0;  // from the start of the record, in 1/omega_alpha
  double period = 0.0;
  double energy = 0.0;  // E_fl, of the motion about the period's mean (eq:fluctuating-energy)
};

// The periods that a record holds, one after the other. Minima of motion without energy, or less than an
// eighth of a step apart, do not count.
std::vector<MarchedPeriod> periods_of(const StructureModel& model, const MotionRecord& record);

// The states of one period at `instances` equal steps of phase, an odd number, as a periodic solution
// holds them: the first harmonic of the phase mode is a sine of positive amplitude. By cubic
// interpolation of the record.
std::vector<double> sampled_period(const StructureModel& model, const MotionRecord& record,
                                   const MarchedPeriod& period, int instances);

// The phase of the phase mode's first harmonic, a sine, where the period begins.
double phase_at_begin(const StructureModel& model, const MotionRecord& record, const MarchedPeriod& period);

// A limit cycle that the motion approaches, from the growth of the energy from period to period as a
// linear function of the energy itself (eq:cycle-energy). Nothing where it does not approach any, or
// the record has fewer than five periods.
struct CycleEstimate {
  double energy = 0.0;           // of the last period
  double energy_limit = 0.0;     // of the cycle approached
  double energy_error = 0.0;     // their distance, more where a transient is seen
  double frequency = 0.0;        // of the last period
  double frequency_error = 0.0;  // its change over the last periods
};
std::optional<CycleEstimate> estimate_cycle(const std::vector<MarchedPeriod>& periods);

}  // namespace wingbeat
