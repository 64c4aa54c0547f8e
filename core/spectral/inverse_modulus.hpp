#pragma once

#include <span>
#include <vector>

#include "core/spectral/time_spectral.hpp"

namespace wingbeat {

// |I + a D|^-1 = (I - a^2 D^2)^(-1/2), circulant as D is: it divides harmonic h by
// sqrt(1 + (h a)^2)  (eq:inverse-modulus).
class InverseModulus {
 public:
  explicit InverseModulus(const TimeSpectral& time);

  // weights[k], k = 0..N-1, so that (|I + a D|^-1 f)_n = sum_m weights[(n - m) mod N] f_m.
  void weights(double a, std::span<double> weights) const;

 private:
  int harmonics_;
  int instances_;
  std::vector<double> cosine_;  // of h theta_k, times 2/N: [h - 1][k]
};

}  // namespace wingbeat
