#include "core/algebra/krylov_deflation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <type_traits>
#include <vector>

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

// H' may miss H P_k by this part of H: a restart is no place to lose more digits.
constexpr double relation_tolerance = 1e-8;

// A conjugate pair of a real matrix, or a single eigenvalue.
struct Eigenspace {
  double magnitude = 0.0;
  Eigen::Index first = 0;
  int size = 1;
};

template <class T>
std::vector<Eigenspace> eigenspaces(const Eigen::VectorXcd& values) {
  std::vector<Eigenspace> spaces;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const bool is_pair = std::is_same_v<T, double> && values[i].imag() != 0.0 && i + 1 < values.size();
    spaces.push_back({std::abs(values[i]), i, is_pair ? 2 : 1});
    if (is_pair) ++i;
  }
  return spaces;
}

// Columns that span the harmonic Ritz vectors g of least |theta|, H^H H g = theta H_m^H g with H_m the
// first m rows. With H = Q R and u = R g the inverse of theta is an eigenvalue of Q_m^H R^-1.
template <class T>
DenseMatrix<T> harmonic_ritz_vectors(const DenseMatrix<T>& q, const DenseMatrix<T>& r, int count) {
  const Eigen::Index m = r.cols();
  const auto pivots = r.diagonal().cwiseAbs();
  if (pivots.minCoeff() <= 1e-14 * pivots.maxCoeff()) return {};
  const auto triangle = r.template triangularView<Eigen::Upper>();
  const DenseMatrix<T> inverse = triangle.solve(DenseMatrix<T>::Identity(m, m));
  const DenseMatrix<T> operator_inverse = q.topLeftCorner(m, m).adjoint() * inverse;
  using Solver = std::conditional_t<std::is_same_v<T, double>, Eigen::EigenSolver<DenseMatrix<T>>,
                                    Eigen::ComplexEigenSolver<DenseMatrix<T>>>;
  const Solver solver(operator_inverse);
  if (solver.info() != Eigen::Success) return {};

  auto spaces = eigenspaces<T>(solver.eigenvalues());
  std::stable_sort(spaces.begin(), spaces.end(),
                   [](const Eigenspace& a, const Eigenspace& b) { return a.magnitude > b.magnitude; });
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  DenseMatrix<T> chosen(m, std::min<Eigen::Index>(count, m) + 1);
  Eigen::Index k = 0;
  for (const Eigenspace& space : spaces) {
    if (k >= count || k + space.size >= m) break;
    const Eigen::VectorXcd u = vectors.col(space.first);
    if constexpr (std::is_same_v<T, double>) {
      chosen.col(k++) = u.real();
      if (space.size == 2) chosen.col(k++) = u.imag();
    } else {
      chosen.col(k++) = u;
    }
  }
  DenseMatrix<T> g = triangle.solve(DenseMatrix<T>(chosen.leftCols(k)));
  for (Eigen::Index j = 0; j < k; ++j) g.col(j).normalize();
  return g;
}

template <class T>
DenseMatrix<T> orthonormal_basis(const DenseMatrix<T>& columns) {
  const Eigen::HouseholderQR<DenseMatrix<T>> qr(columns);
  return qr.householderQ() * DenseMatrix<T>::Identity(columns.rows(), columns.cols());
}

}  // namespace

template <class T>
std::optional<DeflatedSpace<T>> deflated_space(const DenseMatrix<T>& h, int count) {
  const Eigen::Index m = h.cols();
  if (count < 1 || m < 2 || !h.allFinite()) return {};
  const Eigen::HouseholderQR<DenseMatrix<T>> qr(h);
  const DenseMatrix<T> q = qr.householderQ();
  const DenseMatrix<T> r = qr.matrixQR().topRows(m).template triangularView<Eigen::Upper>();
  const DenseMatrix<T> ritz = harmonic_ritz_vectors<T>(q, r, count);
  const Eigen::Index k = ritz.cols();
  if (k == 0 || !ritz.allFinite()) return {};
  DenseMatrix<T> columns = DenseMatrix<T>::Zero(m + 1, k + 1);
  columns.topLeftCorner(m, k) = ritz;
  columns.col(k) = q.col(m);

  DeflatedSpace<T> space{orthonormal_basis<T>(columns), {}};
  // The last row of the kept directions is zero to round-off, and Z has no vector for it.
  space.basis.bottomLeftCorner(1, k).setZero();
  const DenseMatrix<T> images = h * space.basis.topLeftCorner(m, k);
  space.hessenberg = space.basis.adjoint() * images;
  const double lost = (images - space.basis * space.hessenberg).norm();
  if (!(lost <= relation_tolerance * images.norm())) return {};
  return space;
}

template std::optional<DeflatedSpace<double>> deflated_space<double>(const DenseMatrix<double>&, int);
template std::optional<DeflatedSpace<Complex>> deflated_space<Complex>(const DenseMatrix<Complex>&, int);

}  // namespace wingbeat
