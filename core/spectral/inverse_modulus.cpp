#include "core/spectral/inverse_modulus.hpp"

#include <algorithm>
#include <cmath>

namespace wingbeat {

InverseModulus::InverseModulus(const TimeSpectral& time)
    : harmonics_(time.harmonics()), instances_(time.instances()) {
  for (int h = 1; h <= harmonics_; ++h)
    for (int k = 0; k < instances_; ++k)
      cosine_.push_back(2.0 / instances_ * std::cos(time.phase((h * k) % instances_)));
}

void InverseModulus::weights(double a, std::span<double> weights) const {
  std::fill(weights.begin(), weights.end(), 1.0 / instances_);
  const double* cosine = cosine_.data();
  for (int h = 1; h <= harmonics_; ++h) {
    const double share = 1.0 / std::sqrt(1.0 + h * a * h * a);
    for (double& weight : weights) weight += share * *cosine++;
  }
}

}  // namespace wingbeat
