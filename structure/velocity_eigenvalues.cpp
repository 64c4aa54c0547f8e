#include "structure/velocity_eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>

#include "core/io/error.hpp"
#include "structure/imaginary_unit.hpp"

namespace wingbeat {

namespace {

using Complex = std::complex<double>;

// left^T matrix right, without conjugation.
Complex sandwich(const Eigen::VectorXcd& left, const Eigen::MatrixXcd& matrix,
                 const Eigen::VectorXcd& right) {
  return left.cwiseProduct(matrix * right).sum();
}

}  // namespace

VelocityEigenvalues velocity_eigenvalues(const StructureModel& model, double k, const Eigen::MatrixXcd& q) {
  const int m = model.size();
  ensure(q.rows() == m && q.cols() == m, "aerodynamic matrix and structure differ in size");
  ensure(q.allFinite(), "aerodynamic matrix is not finite");
  const Eigen::LLT<Eigen::MatrixXd> stiffness(model.stiffness);
  if (stiffness.info() != Eigen::Success)
    throw InputError(
        "structure: the stiffness matrix is not positive definite; "
        "the flutter roots of free rigid-body modes are not supported");

  // Companion form for (u, lambda u).
  const Eigen::MatrixXcd inverse = stiffness.solve(Eigen::MatrixXd::Identity(m, m)).cast<Complex>();
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(2 * m, 2 * m);
  companion.topRightCorner(m, m).setIdentity();
  companion.bottomLeftCorner(m, m) = inverse * (4.0 * k * k * model.mass + model.load_factor * q);
  companion.bottomRightCorner(m, m) = inverse * (-2.0 * i_unit * k * model.damping);

  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(companion);
  ensure(solver.info() == Eigen::Success, "flutter scan: the eigenvalue solver did not converge");
  VelocityEigenvalues result;
  result.inverse_velocity = solver.eigenvalues();
  result.right = solver.eigenvectors().topRows(m).colwise().normalized();
  result.left = (solver.eigenvectors().inverse().rightCols(m) * inverse).transpose();
  return result;
}

Complex VelocityEigenvalues::slope(const StructureModel& model, double k, const Eigen::MatrixXcd& q_slope,
                                   int j) const {
  const Complex lambda = inverse_velocity[j];
  const Eigen::MatrixXcd by_k =
      2.0 * i_unit * lambda * model.damping - 8.0 * k * model.mass - model.load_factor * q_slope;
  const Eigen::MatrixXcd by_lambda = 2.0 * lambda * model.stiffness + 2.0 * i_unit * k * model.damping;
  const Complex value =
      -sandwich(left.col(j), by_k, right.col(j)) / sandwich(left.col(j), by_lambda, right.col(j));
  return std::isfinite(value.real()) && std::isfinite(value.imag()) ? value : Complex{};
}

double VelocityEigenvalues::growth_slope(const StructureModel& model, double k, const Eigen::MatrixXcd& q,
                                         const Eigen::MatrixXcd& q_slope, int j) const {
  const double velocity = 1.0 / inverse_velocity[j].real();
  const double omega = 2.0 * k * velocity;
  const double load = model.load_factor * velocity;
  const Eigen::MatrixXcd by_velocity = -2.0 * load * q + load * k * q_slope;
  const Eigen::MatrixXcd by_omega = -2.0 * omega * model.mass + i_unit * model.damping - 0.5 * load * q_slope;
  const Complex omega_slope =
      -sandwich(left.col(j), by_velocity, right.col(j)) / sandwich(left.col(j), by_omega, right.col(j));
  return -omega_slope.imag();
}

}  // namespace wingbeat
