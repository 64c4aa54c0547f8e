#include "structure/section_march.hpp"

#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {

template <int Dim>
SectionLoads<Dim>::SectionLoads(DualTime<Dim>& flow, const SectionKinematics& kinematics,
                                double reduced_velocity)
    : flow_(flow),
      kinematics_(kinematics),
      r_(std::pow(reduced_velocity / kinematics.reference_velocity, 2)) {
  ensure(reduced_velocity > 0.0, "a march needs a speed");
}

template <int Dim>
void SectionLoads<Dim>::begin(double dtau) {
  flow_.begin(dtau / kinematics_.clock_ratio(r_));
  iterations_ = 0;
}

template <int Dim>
SolveStatus SectionLoads<Dim>::forces(std::span<const double> y, std::span<double> f) {
  const MotionState motion = kinematics_.motion(y, r_);
  const DualTimeResult result = flow_.solve(motion);
  iterations_ += result.iterations;
  if (result.status != SolveStatus::converged) return result.status;
  loads_ = flow_.loads(motion);
  f[0] = -loads_.force_y;
  f[1] = 2.0 * loads_.moment;
  return result.status;
}

std::vector<std::vector<double>> periodic_history(const TimeSpectral& time, std::span<const double> values,
                                                  double omega, double dtau, int levels) {
  const int instances = time.instances();
  const std::size_t width = values.size() / static_cast<std::size_t>(instances);
  ensure(width * static_cast<std::size_t>(instances) == values.size(), "periodic values of the wrong size");
  std::vector<std::vector<double>> history;
  for (int k = 0; k < levels; ++k) {
    std::vector<double> level(width, 0.0);
    for (int n = 0; n < instances; ++n) {
      const double lag = -omega * k * dtau - time.phase(n);
      double weight = 1.0;
      for (int h = 1; h <= time.harmonics(); ++h) weight += 2.0 * std::cos(h * lag);
      weight /= instances;
      const double* instance = values.data() + static_cast<std::size_t>(n) * width;
      for (std::size_t j = 0; j < width; ++j) level[j] += weight * instance[j];
    }
    history.push_back(std::move(level));
  }
  return history;
}

template class SectionLoads<2>;
template class SectionLoads<3>;

}  // namespace wingbeat
