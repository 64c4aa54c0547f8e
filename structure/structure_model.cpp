#include "structure/structure_model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

void require_square(const Eigen::MatrixXd& matrix, int size, const char* name) {
  if (matrix.rows() != size || matrix.cols() != size)
    throw InputError(fmt::format("structure: the {} matrix is {} x {}, but {} modes are named; give {} x {}",
                                 name, matrix.rows(), matrix.cols(), size, size, size));
  if (!matrix.allFinite())
    throw InputError(fmt::format("structure: the {} matrix has an entry that is not a finite number", name));
}

void require_symmetric(const Eigen::MatrixXd& matrix, const char* name) {
  if ((matrix - matrix.transpose()).norm() > 1e-10 * matrix.norm())
    throw InputError(fmt::format("structure: the {} matrix is not symmetric", name));
}

void require_mode(int mode, int size, const char* what) {
  if (mode < 0 || mode >= size)
    throw InputError(fmt::format("structure: {} is {}; allowed are 0 to {}", what, mode, size - 1));
}

}  // namespace

void check(const StructureModel& model) {
  const int m = model.size();
  if (m == 0) throw InputError("structure: no modes; a model needs at least one");
  require_square(model.mass, m, "mass");
  require_square(model.damping, m, "damping");
  require_square(model.stiffness, m, "stiffness");
  require_symmetric(model.mass, "mass");
  require_symmetric(model.stiffness, "stiffness");
  if (Eigen::LLT<Eigen::MatrixXd>(model.mass).info() != Eigen::Success)
    throw InputError("structure: the mass matrix is not positive definite");
  if (!(model.load_factor >= 0.0) || !std::isfinite(model.load_factor))
    throw InputError(
        fmt::format("structure: the load factor is {}; it must be a number >= 0", model.load_factor));
  require_mode(model.phase_mode, m, "the phase mode");
  for (const RestoringForce& force : model.restoring) {
    require_mode(force.mode, m, "the mode of a restoring force");
    if (!force.value || !force.derivative)
      throw InputError("structure: a restoring force lacks its value or its derivative");
  }
}

Eigen::MatrixXd first_order_matrix(const StructureModel& model) {
  const int m = model.size();
  const Eigen::LLT<Eigen::MatrixXd> mass(model.mass);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * m, 2 * m);
  a.topRightCorner(m, m) = -Eigen::MatrixXd::Identity(m, m);
  a.bottomLeftCorner(m, m) = mass.solve(model.stiffness);
  a.bottomRightCorner(m, m) = mass.solve(model.damping);
  return a;
}

VacuumModes vacuum_modes(const StructureModel& model) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(model.stiffness, model.mass);
  ensure(solver.info() == Eigen::Success, "free vibration: the eigenvalue solver did not converge");
  if (solver.eigenvalues().minCoeff() < -1e-10 * solver.eigenvalues().cwiseAbs().maxCoeff())
    throw InputError(
        fmt::format("structure: the stiffness matrix has the negative eigenvalue {}; "
                    "it must be positive semidefinite",
                    solver.eigenvalues().minCoeff()));
  return {solver.eigenvalues().cwiseMax(0.0).cwiseSqrt(), solver.eigenvectors()};
}

Eigen::MatrixXd modal_damping(const StructureModel& model, const Eigen::VectorXd& ratios) {
  if (ratios.size() != model.size())
    throw InputError(fmt::format("structure: {} damping ratios are given for {} modes; give one a mode",
                                 ratios.size(), model.size()));
  const VacuumModes free = vacuum_modes(model);
  const Eigen::MatrixXd shapes = model.mass * free.shapes;
  return shapes * (2.0 * ratios.cwiseProduct(free.frequencies)).asDiagonal() * shapes.transpose();
}

}  // namespace wingbeat
