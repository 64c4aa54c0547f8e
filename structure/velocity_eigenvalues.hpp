#pragma once

#include <Eigen/Dense>
#include <vector>

#include "structure/structure_model.hpp"

namespace wingbeat {

// Solutions of [lambda^2 K + 2 i k lambda C - 4 k^2 M - c Q] u = 0, lambda = 1/V: the flutter equation
// at fixed reduced frequency, divided by V^2 (eq:velocity-eigenvalue). 2m of them, in no order.
struct VelocityEigenvalues {
  Eigen::VectorXcd inverse_velocity;  // lambda
  Eigen::MatrixXcd left;              // m x 2m, plain transpose: left^T [...] = 0
  Eigen::MatrixXcd right;             // m x 2m, columns u of unit norm

  // d lambda/dk of eigenvalue j, given dQ/dk; zero where the eigenvalue is defective.
  std::complex<double> slope(const StructureModel& model, double k, const Eigen::MatrixXcd& q_slope,
                             int j) const;
  // d(Re p)/dV of the motion e^{p t} that eigenvalue j, if real, stands for.
  double growth_slope(const StructureModel& model, double k, const Eigen::MatrixXcd& q,
                      const Eigen::MatrixXcd& q_slope, int j) const;
};

// Throws InputError unless K is positive definite.
VelocityEigenvalues velocity_eigenvalues(const StructureModel& model, double k, const Eigen::MatrixXcd& q);

}  // namespace wingbeat
