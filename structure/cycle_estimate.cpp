#include "structure/cycle_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

#include "core/io/error.hpp"
#include "core/spectral/time_spectral.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"
#include "structure/staggered_update.hpp"

namespace wingbeat {
namespace {

// Instances that a period's energy is computed from: enough for any motion that a section makes.
constexpr int energy_instances = 65;
constexpr std::size_t least_periods = 5;

// Value of column j of the states at a time of the record, by the cubic through the nearest four.
double interpolated(const MotionRecord& record, std::size_t width, std::size_t j, double time) {
  const auto samples = static_cast<long>(record.y.size() / width);
  const double place = time / record.dtau;
  const long first = std::clamp(static_cast<long>(std::floor(place)) - 1, 0L, samples - 4);
  double value = 0.0;
  for (long a = 0; a < 4; ++a) {
    double weight = 1.0;
    for (long b = 0; b < 4; ++b)
      if (b != a) weight *= (place - static_cast<double>(first + b)) / static_cast<double>(a - b);
    value += weight * record.y[static_cast<std::size_t>(first + a) * width + j];
  }
  return value;
}

// Where column j passes from below zero between samples n and n + 1, by bisection of the cubic.
double zero_between(const MotionRecord& record, std::size_t width, std::size_t j, std::size_t n) {
  double low = static_cast<double>(n) * record.dtau, high = low + record.dtau;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (interpolated(record, width, j, middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<double> resampled(const StructureModel& model, const MotionRecord& record,
                              const MarchedPeriod& period, int instances) {
  const auto width = static_cast<std::size_t>(2 * model.size());
  std::vector<double> y;
  for (int n = 0; n < instances; ++n)
    for (std::size_t j = 0; j < width; ++j)
      y.push_back(interpolated(record, width, j, period.begin + period.period * n / instances));
  return y;
}

}  // namespace

std::vector<MarchedPeriod> periods_of(const StructureModel& model, const MotionRecord& record) {
  const auto width = static_cast<std::size_t>(2 * model.size());
  const std::size_t samples = record.y.size() / width;
  const auto rate = static_cast<std::size_t>(model.size() + model.phase_mode);
  std::vector<MarchedPeriod> periods;
  if (samples < 8) return periods;
  std::optional<double> last;
  for (std::size_t n = 0; n + 1 < samples; ++n) {
    if (!(record.y[n * width + rate] < 0.0 && record.y[(n + 1) * width + rate] >= 0.0)) continue;
    const double now = zero_between(record, width, rate, n);
    if (last && now - *last > record.dtau) {
      MarchedPeriod period{*last, now - *last, 0.0};
      period.energy = fluctuating_energy(model, resampled(model, record, period, energy_instances));
      periods.push_back(period);
    }
    last = now;
  }
  return periods;
}

std::vector<double> sampled_period(const StructureModel& model, const MotionRecord& record,
                                   const MarchedPeriod& period, int instances) {
  return shifted_to_phase(model, TimeSpectral((instances - 1) / 2),
                          resampled(model, record, period, instances));
}

double phase_at_begin(const StructureModel& model, const MotionRecord& record, const MarchedPeriod& period) {
  const TimeSpectral time((energy_instances - 1) / 2);
  const Eigen::VectorXcd u = first_harmonic(model, time, resampled(model, record, period, energy_instances));
  return std::arg(u[model.phase_mode]) + 0.5 * std::numbers::pi;
}

std::optional<CycleEstimate> estimate_cycle(const std::vector<MarchedPeriod>& periods) {
  if (periods.size() < least_periods) return std::nullopt;
  const auto last = std::span(periods).last(least_periods);
  // Growth a period, ln(E_i+1/E_i), against the energy between.
  constexpr auto count = least_periods - 1;
  double mean_energy = 0.0, mean_growth = 0.0;
  std::array<double, count> energy{}, growth{};
  for (std::size_t i = 0; i < count; ++i) {
    if (!(last[i].energy > 0.0) || !(last[i + 1].energy > 0.0)) return std::nullopt;
    energy[i] = std::sqrt(last[i].energy * last[i + 1].energy);
    growth[i] = std::log(last[i + 1].energy / last[i].energy);
    mean_energy += energy[i] / count;
    mean_growth += growth[i] / count;
  }
  double covariance = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    covariance += (energy[i] - mean_energy) * (growth[i] - mean_growth);
    variance += (energy[i] - mean_energy) * (energy[i] - mean_energy);
  }
  if (!(variance > 0.0) || !(covariance < 0.0)) return std::nullopt;
  const double limit = mean_energy - mean_growth * variance / covariance;
  if (!(limit > 0.0)) return std::nullopt;
  const double omega = 2.0 * std::numbers::pi / last.back().period;
  const double before = 2.0 * std::numbers::pi / last[last.size() - 2].period;
  const double spread = std::abs(last.back().energy - last[last.size() - 2].energy);
  CycleEstimate result;
  result.energy = last.back().energy;
  result.energy_limit = limit;
  result.energy_error = std::abs(limit - result.energy);
  // A transient that dies out makes the line of all too steep. The last two growths see least of it, and the
  // line of growths to come is as much flatter again.
  const double change = energy[count - 1] - energy[count - 2], fall = growth[count - 2] - growth[count - 1];
  if (change * fall > 0.0) {
    const double by_last = std::abs(energy[count - 1] + growth[count - 1] * change / fall - result.energy);
    if (by_last > result.energy_error) result.energy_error = by_last * by_last / result.energy_error;
  }
  result.frequency = omega;
  // The frequency goes to its limit as the energy does.
  result.frequency_error =
      std::abs(omega - before) * std::max(1.0, spread > 0.0 ? result.energy_error / spread : 1.0);
  return result;
}

}  // namespace wingbeat
