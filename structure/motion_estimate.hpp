#pragma once

#include <optional>
#include <span>
#include <vector>

#include "structure/structure_model.hpp"

namespace wingbeat {

// A piece of a march: states y[n*2m + j] at equal steps dtau.
struct MotionRecord {
  std::span<const double> y;
  double dtau = 0.0;
};

// e^{rate t} at a frequency, with standard errors of both.
struct DampedMode {
  double rate = 0.0;
  double frequency = 0.0;
  double rate_error = 0.0;
  double frequency_error = 0.0;
  double energy = 0.0;  // mean of the mode's motion over a period, at the end of the record
};

// Least squares in the norm of energy of
//   y(t) = c + sum_j e^{sigma_j t} (a_j cos omega_j t + b_j sin omega_j t)      (eq:damped-modes)
// over the whole record, with as many modes as asked for. Errors are those that the residual leaves,
// its correlation in time counted. Nothing where the record does not hold so many modes.
struct ModalFit {
  std::vector<DampedMode> modes;
  double residual = 0.0;  // its norm over that of the motion about its mean
};
std::optional<ModalFit> fit_damped_modes(const StructureModel& model, const MotionRecord& record, int modes);

// Growth rate and frequency of the least stable mode that takes part in the motion, with errors that count
// the disagreement of the record with its later half: an unfinished transient widens them
// (eq:growth-error).
struct GrowthEstimate {
  double rate = 0.0;
  double rate_error = 0.0;
  double frequency = 0.0;
  double frequency_error = 0.0;
};
std::optional<GrowthEstimate> estimate_growth(const StructureModel& model, const MotionRecord& record);

}  // namespace wingbeat
