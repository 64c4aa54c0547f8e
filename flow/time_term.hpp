#pragma once

namespace wingbeat {

// The time derivative in R: kappa sum_m D_nm Omega w_m + shift Omega w_n. kappa is the frequency of a
// period on the flow's clock (eq:time-spectral); shift = c_0/dt belongs to the level sought of a backward
// difference (eq:dual-time).
struct TimeTerm {
  double kappa = 0.0;
  double shift = 0.0;

  // Implicit: a frequency alone is a time term.
  TimeTerm(double frequency = 0.0, double diagonal = 0.0) : kappa(frequency), shift(diagonal) {}
};

}  // namespace wingbeat
