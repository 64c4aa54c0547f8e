#include "flow/reduced_response.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "flow/harmonic_preconditioner.hpp"

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

DenseVector<double> column_of(std::span<const double> values) {
  return Eigen::Map<const DenseVector<double>>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void sum_over(const Comm& comm, DenseMatrix<double>& matrix) {
  comm.sum(std::span<double>(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

void normalise(const Comm& comm, std::span<Complex> x) {
  double sum = 0.0;
  for (const Complex& value : x) sum += std::norm(value);
  const double length = std::sqrt(comm.sum(sum));
  if (length == 0.0) return;
  for (Complex& value : x) value /= length;
}

}  // namespace

template <int Dim>
ReducedResponse<Dim>::ReducedResponse(const FlowLevel<Dim>& level, std::span<const double> kappas,
                                      const GmresOptions& gmres)
    : flow_(level.steady), gmres_(gmres) {
  const auto volumes = flow_.domain().volumes();
  for (double kappa : kappas) {
    auto solver = std::make_unique<SchwarzSolver<Complex>>(level.comm(), level.subdomain, state_size<Dim>);
    solver->factor(flow_.jacobians()[0], std::span<const Complex>(harmonic_shift(volumes, kappa)));
    expansions_.push_back({kappa, std::move(solver), {}});
    for (const auto& by_motion : flow_.motion_gradients(0))
      expansions_.back().sides.emplace_back(by_motion.begin(), by_motion.end());
  }
  basis_.resize(static_cast<Eigen::Index>(flow_.state_count()), 0);
  images_ = basis_;
}

template <int Dim>
void ReducedResponse<Dim>::extend() {
  const Comm& comm = flow_.domain().comm();
  const auto volumes = flow_.domain().volumes();
  for (Expansion& expansion : expansions_) {
    const FrequencyOperator<Dim> op(flow_, expansion.kappa);
    for (Field& side : expansion.sides) {
      Field x(side.size());
      check_response(gmres<Complex>(comm, op, *expansion.solver, side, x, gmres_), expansion.kappa,
                     gmres_.relative_tolerance);
      normalise(comm, x);
      // The real equations have the conjugate response at -kappa: both parts span what both do.
      std::vector<double> real(x.size()), imaginary(x.size());
      for (std::size_t i = 0; i < x.size(); ++i) {
        real[i] = x[i].real();
        imaginary[i] = x[i].imag();
        side[i] = volumes[i / state_size<Dim>] * x[i];
      }
      add_to_basis(std::move(real));
      add_to_basis(std::move(imaginary));
    }
  }
  project();
}

template <int Dim>
void ReducedResponse<Dim>::add_to_basis(std::vector<double> v) {
  constexpr double newness = 1e-8;  // of a vector of length one, what must be left once it is orthogonal
  const Comm& comm = flow_.domain().comm();
  Eigen::Map<DenseVector<double>> vector(v.data(), static_cast<Eigen::Index>(v.size()));
  for (int pass = 0; pass < 2; ++pass) {
    DenseMatrix<double> along = basis_.transpose() * vector;
    sum_over(comm, along);
    vector -= basis_ * along;
  }
  const double left = std::sqrt(comm.sum(vector.squaredNorm()));
  if (!(left > newness)) return;
  vector /= left;
  std::vector<double> image(v.size());
  flow_.apply(v, image);
  for (auto* columns : {&basis_, &images_}) columns->conservativeResize(Eigen::NoChange, columns->cols() + 1);
  basis_.rightCols(1) = vector;
  images_.rightCols(1) = column_of(image);
}

template <int Dim>
void ReducedResponse<Dim>::project() {
  const auto volumes = flow_.domain().volumes();
  DenseMatrix<double> weighted = basis_;
  for (Eigen::Index i = 0; i < weighted.rows(); ++i)
    weighted.row(i) *= volumes[static_cast<std::size_t>(i) / state_size<Dim>];
  stiffness_ = basis_.transpose() * images_;
  mass_ = basis_.transpose() * weighted;
  inputs_.resize(basis_.cols(), 3);
  Eigen::Index column = 0;
  for (const auto& by_motion : flow_.motion_gradients(0))
    inputs_.col(column++) = basis_.transpose() * column_of(by_motion);
  const LoadGradients& gradients = flow_.load_gradients(0);
  outputs_.resize(2, basis_.cols());
  outputs_.row(0) = column_of(gradients.force_y).transpose() * basis_;
  outputs_.row(1) = column_of(gradients.moment).transpose() * basis_;
  for (auto* matrix : {&stiffness_, &mass_, &inputs_, &outputs_}) sum_over(flow_.domain().comm(), *matrix);
}

template <int Dim>
LoadResponse ReducedResponse<Dim>::at(double kappa) const {
  const Complex rate(0.0, kappa);
  const DenseMatrix<Complex> matrix = stiffness_ + rate * mass_;
  DenseMatrix<Complex> sides(inputs_.rows(), 2);
  sides.col(0) = -(inputs_.col(0) + rate * inputs_.col(1));
  sides.col(1) = -rate * inputs_.col(2);
  const DenseMatrix<Complex> loads = outputs_ * matrix.partialPivLu().solve(sides);
  return with_direct_loads(flow_, {{loads(0, 0), loads(1, 0)}, {loads(0, 1), loads(1, 1)}});
}

template class ReducedResponse<2>;
template class ReducedResponse<3>;

}  // namespace wingbeat
