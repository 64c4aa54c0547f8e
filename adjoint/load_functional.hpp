#pragma once

#include <optional>
#include <vector>

#include "core/spectral/time_spectral.hpp"
#include "flow/flow_inputs.hpp"

namespace wingbeat {

enum class LoadCoefficient { drag, lift, moment };

// Which number of the loads of a period.
struct LoadQuantity {
  LoadCoefficient coefficient = LoadCoefficient::drag;
  int harmonic = 0;           // 0: the mean
  bool is_imaginary = false;  // part of the harmonic's amplitude, f = Re sum f_h e^{i h theta}
};

// J = sum_n weights_n . loads_n, and how the weights change with what else they depend on.
struct LoadFunctional {
  std::vector<Loads<double>> weights;                 // [instance]
  std::vector<Loads<double>> by_angle;                // d weights / d angle of attack, radians
  std::array<std::vector<Loads<double>>, 2> by_axis;  // d weights / d axis of rotation, chords

  double value(std::span<const Loads<double>> loads) const;
};

// The weights that make a coefficient of (force_x, force_y, moment about the axis): wind axes for drag and
// lift; `arm`: from the axis to the moment reference, in the axes of the loads (eq:loads).
Loads<double> coefficient_weights(LoadCoefficient coefficient, double angle, const Vec<double, 2>& arm);

// `reference`: of the moment, chords at rest, moving with the section; the axis if not given.
LoadFunctional load_functional(const LoadQuantity& quantity, const TimeSpectral& time, double angle,
                               std::span<const MotionState> motions, const Vec<double, 2>& axis,
                               const std::optional<Vec<double, 2>>& reference);

// sum += scale functional; an empty sum is zero.
void add_scaled(double scale, const LoadFunctional& functional, LoadFunctional& sum);

// a . b over all instances.
double load_dot(std::span<const Loads<double>> a, std::span<const Loads<double>> b);

}  // namespace wingbeat
