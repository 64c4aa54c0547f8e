#include "structure/structural_equation.hpp"

#include <utility>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

using ConstColumns = Eigen::Map<const Eigen::MatrixXd>;
using Columns = Eigen::Map<Eigen::MatrixXd>;

// Instances as the columns of a matrix: the storage order is the same.
ConstColumns columns(std::span<const double> values, int rows, int instances) {
  ensure(values.size() == static_cast<std::size_t>(rows * instances), "structural vector of the wrong size");
  return {values.data(), rows, instances};
}

Columns columns(std::span<double> values, int rows, int instances) {
  ensure(values.size() == static_cast<std::size_t>(rows * instances), "structural vector of the wrong size");
  return {values.data(), rows, instances};
}

}  // namespace

StructuralEquation::StructuralEquation(StructureModel model, TimeSpectral time)
    : model_(std::move(model)), time_(std::move(time)) {
  check(model_);
  linear_ = first_order_matrix(model_);
  inverse_mass_ = model_.mass.llt().solve(Eigen::MatrixXd::Identity(modes(), modes()));
}

void StructuralEquation::residual(std::span<const double> y, double omega, double load,
                                  std::span<const double> f, std::span<double> s) const {
  const int m = modes();
  const int n = time_.instances();
  const ConstColumns state = columns(y, 2 * m, n);
  Columns rows = columns(s, 2 * m, n);
  Eigen::MatrixXd force = load * columns(f, m, n);
  for (const RestoringForce& spring : model_.restoring)
    for (int i = 0; i < n; ++i) force(spring.mode, i) -= spring.value(state(spring.mode, i));
  rows = linear_ * state;
  rows.bottomRows(m) -= inverse_mass_ * force;
  time_.add_derivative(omega, y, s);
}

Eigen::MatrixXd StructuralEquation::instance_matrix(std::span<const double> y, int instance) const {
  const int m = modes();
  const ConstColumns state = columns(y, 2 * m, time_.instances());
  Eigen::MatrixXd matrix = linear_;
  for (const RestoringForce& spring : model_.restoring)
    matrix.col(spring.mode).tail(m) +=
        spring.derivative(state(spring.mode, instance)) * inverse_mass_.col(spring.mode);
  return matrix;
}

Eigen::MatrixXd StructuralEquation::state_jacobian(std::span<const double> y, double omega) const {
  const int width = 2 * modes();
  const int n = time_.instances();
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(width * n, width * n);
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column)
      jacobian.block(row * width, column * width, width, width).diagonal().array() +=
          omega * time_.derivative(row, column);
    jacobian.block(row * width, row * width, width, width) += instance_matrix(y, row);
  }
  return jacobian;
}

void StructuralEquation::add_state_tangent(std::span<const double> y, double omega,
                                           std::span<const double> dy, double scale,
                                           std::span<double> ds) const {
  const int n = time_.instances();
  const ConstColumns tangent = columns(dy, 2 * modes(), n);
  Columns rows = columns(ds, 2 * modes(), n);
  for (int i = 0; i < n; ++i) rows.col(i) += scale * (instance_matrix(y, i) * tangent.col(i));
  time_.add_derivative(scale * omega, dy, ds);
}

void StructuralEquation::add_state_adjoint(std::span<const double> y, double omega,
                                           std::span<const double> lambda, double scale,
                                           std::span<double> dy) const {
  const int n = time_.instances();
  const ConstColumns adjoint = columns(lambda, 2 * modes(), n);
  Columns rows = columns(dy, 2 * modes(), n);
  for (int i = 0; i < n; ++i) rows.col(i) += scale * (instance_matrix(y, i).transpose() * adjoint.col(i));
  time_.add_derivative(-scale * omega, lambda, dy);
}

void StructuralEquation::frequency_derivative(std::span<const double> y, std::span<double> ds) const {
  columns(ds, 2 * modes(), time_.instances()).setZero();
  time_.add_derivative(1.0, y, ds);
}

void StructuralEquation::load_derivative(std::span<const double> f, std::span<double> ds) const {
  columns(ds, 2 * modes(), time_.instances()).setZero();
  add_force_tangent(1.0, f, 1.0, ds);
}

void StructuralEquation::add_force_tangent(double load, std::span<const double> df, double scale,
                                           std::span<double> ds) const {
  const int n = time_.instances();
  columns(ds, 2 * modes(), n).bottomRows(modes()) -= scale * load * inverse_mass_ * columns(df, modes(), n);
}

void StructuralEquation::add_force_adjoint(double load, std::span<const double> lambda, double scale,
                                           std::span<double> df) const {
  const int n = time_.instances();
  columns(df, modes(), n) -=
      scale * load * inverse_mass_ * columns(lambda, 2 * modes(), n).bottomRows(modes());
}

}  // namespace wingbeat
