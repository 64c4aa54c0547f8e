#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "structure/springs.hpp"

namespace wingbeat {

// M u'' + C u' + K u + g(u) = c V^2 f in m modes, time in 1/omega_alpha  (eq:structure).
// f are generalised forces by virtual work, V the reduced velocity U/(c omega_alpha).
struct StructureModel {
  std::vector<std::string> modes;         // names, m of them
  Eigen::MatrixXd mass;                   // M, m x m, symmetric positive definite
  Eigen::MatrixXd damping;                // C, m x m
  Eigen::MatrixXd stiffness;              // K, m x m, symmetric
  double load_factor = 0.0;               // c; 4/(pi mu) for a typical section
  int phase_mode = 0;                     // the mode whose first harmonic has no cosine
  std::vector<RestoringForce> restoring;  // g; linear flutter, p-k and divergence see K alone

  int size() const { return static_cast<int>(modes.size()); }
  // Factor of the generalised forces at reduced velocity V.
  double load(double reduced_velocity) const { return load_factor * reduced_velocity * reduced_velocity; }
};

// Throws InputError naming the first entry that does not make sense.
void check(const StructureModel& model);

// y' = -A y + (0, M^-1 load): A = [0 -I; M^-1 K  M^-1 C], 2m x 2m  (eq:first-order-form).
Eigen::MatrixXd first_order_matrix(const StructureModel& model);

// Undamped free vibration, ascending; shapes are columns with shapes^T M shapes = I.
struct VacuumModes {
  Eigen::VectorXd frequencies;
  Eigen::MatrixXd shapes;
};
VacuumModes vacuum_modes(const StructureModel& model);

// C that gives vacuum mode j the fraction ratios[j] of critical damping.
Eigen::MatrixXd modal_damping(const StructureModel& model, const Eigen::VectorXd& ratios);

}  // namespace wingbeat
