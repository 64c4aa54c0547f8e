#include "structure/conditions.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "core/io/error.hpp"
#include "structure/energy.hpp"

namespace wingbeat {

namespace {

double value_of(const HarmonicCondition& condition, std::span<const double> y) {
  ensure(y.size() == condition.coefficients.size(), "structural state of the wrong size");
  return std::inner_product(y.begin(), y.end(), condition.coefficients.begin(), -condition.offset);
}

double value_of(const EnergyCondition& condition, std::span<const double> y) {
  return fluctuating_energy(condition.model, y) / condition.energy - 1.0;
}

void add_gradient_of(const HarmonicCondition& condition, std::span<const double>, double scale,
                     std::span<double> gradient) {
  ensure(gradient.size() == condition.coefficients.size(), "gradient of the wrong size");
  for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] += scale * condition.coefficients[i];
}

void add_gradient_of(const EnergyCondition& condition, std::span<const double> y, double scale,
                     std::span<double> gradient) {
  add_fluctuating_energy_gradient(condition.model, y, scale / condition.energy, gradient);
}

// Coefficients (2/N) weight(theta_n) on the displacement of one mode.
template <class Weight>
std::vector<double> first_harmonic_weights(const StructureModel& model, const TimeSpectral& time, int mode,
                                           Weight weight) {
  const int width = 2 * model.size();
  std::vector<double> coefficients(static_cast<std::size_t>(time.instances() * width), 0.0);
  for (int n = 0; n < time.instances(); ++n)
    coefficients[static_cast<std::size_t>(n * width + mode)] = 2.0 / time.instances() * weight(time.phase(n));
  return coefficients;
}

}  // namespace

HarmonicCondition phase_condition(const StructureModel& model, const TimeSpectral& time) {
  ensure(time.harmonics() >= 1, "a phase condition needs a first harmonic");
  return {first_harmonic_weights(model, time, model.phase_mode, [](double theta) { return std::cos(theta); }),
          0.0};
}

HarmonicCondition first_harmonic_condition(const StructureModel& model, const TimeSpectral& time, int mode,
                                           double amplitude) {
  ensure(time.harmonics() >= 1, "an amplitude condition needs a first harmonic");
  if (mode < 0 || mode >= model.size())
    throw InputError(
        fmt::format("first harmonic of mode {}: the model has modes 0 to {}", mode, model.size() - 1));
  if (!(amplitude > 0.0) || !std::isfinite(amplitude))
    throw InputError(fmt::format("amplitude of mode '{}' = {}: must be a number > 0",
                                 model.modes[static_cast<std::size_t>(mode)], amplitude));
  return {first_harmonic_weights(model, time, mode,
                                 [amplitude](double theta) { return std::sin(theta) / amplitude; }),
          1.0};
}

EnergyCondition energy_condition(const StructureModel& model, double energy) {
  if (!(energy > 0.0) || !std::isfinite(energy))
    throw InputError(fmt::format("energy E_0 = {}: must be a number > 0", energy));
  return {model, energy};
}

bool is_at_rest(const CycleCondition& condition, std::span<const double> y) {
  constexpr double vanished = 1e-3;
  return condition.by_energy == 0.0 &&
         fluctuating_energy(condition.energy.model, y) < vanished * condition.energy.energy;
}

double value(const AmplitudeCondition& condition, std::span<const double> y) {
  return std::visit([y](const auto& c) { return value_of(c, y); }, condition);
}

void add_gradient(const AmplitudeCondition& condition, std::span<const double> y, double scale,
                  std::span<double> gradient) {
  std::visit([&](const auto& c) { add_gradient_of(c, y, scale, gradient); }, condition);
}

}  // namespace wingbeat
