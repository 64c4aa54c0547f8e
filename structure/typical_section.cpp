#include "structure/typical_section.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

void require_positive(double value, const char* key) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw InputError(fmt::format("structure.{} = {}: must be a number > 0", key, value));
}

void check(const SectionSpring& spring, const char* mode, const char* freeplay_key) {
  for (const auto& [value, key] : {std::pair{spring.cubic, "cubic"}, {spring.quintic, "quintic"}})
    if (!std::isfinite(value))
      throw InputError(fmt::format("structure.{}_{} = {}: must be a number", mode, key, value));
  if (!(spring.freeplay >= 0.0) || !std::isfinite(spring.freeplay))
    throw InputError(fmt::format("structure.{} = {}: must be a number >= 0", freeplay_key, spring.freeplay));
}

void check(const TypicalSection& section) {
  require_positive(section.gyration_radius_squared, "gyration_radius_squared");
  require_positive(section.frequency_ratio, "frequency_ratio");
  require_positive(section.mass_ratio, "mass_ratio");
  if (!std::isfinite(section.elastic_axis))
    throw InputError(fmt::format("structure.elastic_axis = {}: must be a number", section.elastic_axis));
  for (const double ratio : section.damping)
    if (!(ratio >= 0.0) || !std::isfinite(ratio))
      throw InputError(fmt::format("structure.damping = {}: must be a number >= 0", ratio));
  // About the centre of gravity the squared radius is r_alpha^2 - x_alpha^2.
  const double unbalance = section.static_unbalance;
  if (!(unbalance * unbalance < section.gyration_radius_squared))
    throw InputError(
        fmt::format("structure.static_unbalance = {}: its square must be less than "
                    "structure.gyration_radius_squared = {}",
                    unbalance, section.gyration_radius_squared));
  check(section.plunge_spring, "plunge", "plunge_freeplay");
  check(section.pitch_spring, "pitch", "pitch_freeplay_deg");
  require_positive(section.freeplay_smoothing, "freeplay_smoothing");
}

void add_spring(StructureModel& model, int mode, const SectionSpring& spring, double smoothing) {
  if (spring.cubic != 0.0 || spring.quintic != 0.0)
    model.restoring.push_back(polynomial_spring(mode, spring.cubic, spring.quintic));
  if (spring.freeplay > 0.0)
    model.restoring.push_back(freeplay_spring(mode, model.stiffness(mode, mode), spring.freeplay, smoothing));
}

}  // namespace

double elastic_axis_in_chords(const TypicalSection& section) { return 0.5 * (1.0 + section.elastic_axis); }

StructureModel structure_model(const TypicalSection& section) {
  check(section);
  StructureModel model;
  model.modes = {"plunge", "pitch"};
  model.mass.resize(2, 2);
  model.mass << 1.0, section.static_unbalance, section.static_unbalance, section.gyration_radius_squared;
  model.stiffness =
      Eigen::Vector2d(section.frequency_ratio * section.frequency_ratio, section.gyration_radius_squared)
          .asDiagonal();
  model.damping = modal_damping(model, Eigen::Vector2d(section.damping[0], section.damping[1]));
  model.load_factor = 4.0 / (std::numbers::pi * section.mass_ratio);
  model.phase_mode = pitch_mode;
  add_spring(model, plunge_mode, section.plunge_spring, section.freeplay_smoothing);
  add_spring(model, pitch_mode, section.pitch_spring, section.freeplay_smoothing);
  return model;
}

double speed_index(const TypicalSection& section, double reduced_velocity) {
  return 2.0 * reduced_velocity / std::sqrt(section.mass_ratio);
}

}  // namespace wingbeat
