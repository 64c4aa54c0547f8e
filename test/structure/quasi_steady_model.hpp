#pragma once

#include <Eigen/Dense>
#include <numbers>

#include "structure/structure_model.hpp"

// Typical section with quasi-steady aerodynamics and a cubic-quintic pitch spring (He, Jonsson &
// Martins, Nonlinear Dynamics 2022). Its Hopf point is V = omega = 3/sqrt(13).
namespace wingbeat::quasi_steady {

inline constexpr int plunge_mode = 0;
inline constexpr int pitch_mode = 1;

struct Spring {
  double cubic;
  double quintic;
};

inline constexpr double gyration_radius_squared = 0.09;
inline constexpr double mass_ratio = 10.0;
inline constexpr double degree = std::numbers::pi / 180.0;

// Lift and moment follow the effective incidence alpha + h'/V through these, with c = 2/mass_ratio.
inline const Eigen::Vector2d force_direction(-1.0, 0.2);

inline StructureModel section(Spring spring, double mass = mass_ratio) {
  StructureModel model;
  model.modes = {"plunge", "pitch"};
  model.mass.resize(2, 2);
  model.mass << 1.0, 0.2, 0.2, gyration_radius_squared;
  model.damping = Eigen::MatrixXd::Zero(2, 2);
  model.stiffness = Eigen::Vector2d(0.25, gyration_radius_squared).asDiagonal();
  model.load_factor = 2.0 / mass;
  model.phase_mode = pitch_mode;
  model.restoring = {polynomial_spring(pitch_mode, gyration_radius_squared * spring.cubic,
                                       gyration_radius_squared * spring.quintic)};
  return model;
}

}  // namespace wingbeat::quasi_steady
