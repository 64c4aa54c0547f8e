#include "core/algebra/hessenberg_least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/algebra/krylov_kernels.hpp"
#include "core/io/error.hpp"

namespace wingbeat {

template <class T>
HessenbergLeastSquares<T>::Rotation::Rotation(T upper, double lower) {
  const double length = std::hypot(std::abs(upper), lower);
  if (length == 0.0) return;
  cosine = std::abs(upper) / length;
  const T direction = upper == T(0) ? T(1) : upper / std::abs(upper);
  sine = direction * (lower / length);
}

template <class T>
void HessenbergLeastSquares<T>::Rotation::turn(T& upper, T& lower) const {
  const T old = upper;
  upper = cosine * old + sine * lower;
  lower = cosine * lower - conjugate(sine) * old;
}

template <class T>
HessenbergLeastSquares<T>::HessenbergLeastSquares(double beta) : rhs_{T(beta)} {}

template <class T>
HessenbergLeastSquares<T>::HessenbergLeastSquares(const DenseMatrix<T>& kept, const DenseVector<T>& c) {
  const Eigen::Index k = kept.cols();
  ensure(k > 0 && kept.rows() == k + 1 && c.size() == k + 1,
         "HessenbergLeastSquares: the kept part is not (k+1) x k");
  const Eigen::HouseholderQR<DenseMatrix<T>> qr(kept);
  turned_ = DenseMatrix<T>(qr.householderQ()).adjoint();
  const DenseVector<T> rhs = turned_ * c;
  rhs_.assign(rhs.begin(), rhs.end());
  const DenseMatrix<T> triangle = qr.matrixQR();
  for (Eigen::Index j = 0; j < k; ++j) {
    columns_.emplace_back(triangle.col(j).begin(), triangle.col(j).begin() + j + 1);
    given_.emplace_back(kept.col(j).begin(), kept.col(j).end());
  }
}

template <class T>
double HessenbergLeastSquares<T>::add_column(std::span<const T> given, double subdiagonal) {
  std::vector<T> column(given.begin(), given.end());
  given_.push_back(column);
  given_.back().push_back(T(subdiagonal));
  if (turned_.size() > 0) {
    Eigen::Map<DenseVector<T>> head(column.data(), turned_.rows());
    head = (turned_ * head).eval();
  }
  const std::size_t first = rhs_.size() - 1 - rotations_.size();
  for (std::size_t i = 0; i < rotations_.size(); ++i)
    rotations_[i].turn(column[first + i], column[first + i + 1]);
  const Rotation rotation(column.back(), subdiagonal);
  T below = subdiagonal;
  rotation.turn(column.back(), below);
  rhs_.push_back(T(0));
  rotation.turn(rhs_[rhs_.size() - 2], rhs_.back());
  rotations_.push_back(rotation);
  columns_.push_back(std::move(column));
  return std::abs(rhs_.back());
}

template <class T>
std::vector<T> HessenbergLeastSquares<T>::solution() const {
  std::vector<T> y(rhs_.begin(), rhs_.end() - 1);
  double largest = 0.0;
  for (std::size_t k = 0; k < y.size(); ++k) largest = std::max(largest, std::abs(columns_[k][k]));
  const double negligible = 16.0 * std::numeric_limits<double>::epsilon() * largest;
  for (std::size_t k = y.size(); k-- > 0;) {
    const T pivot = columns_[k][k];
    y[k] = std::abs(pivot) <= negligible ? T(0) : y[k] / pivot;
    for (std::size_t i = 0; i < k; ++i) y[i] -= columns_[k][i] * y[k];
  }
  return y;
}

template <class T>
DenseMatrix<T> HessenbergLeastSquares<T>::matrix() const {
  const auto m = static_cast<Eigen::Index>(given_.size());
  DenseMatrix<T> h = DenseMatrix<T>::Zero(m + 1, m);
  for (Eigen::Index j = 0; j < m; ++j) std::copy(given_[j].begin(), given_[j].end(), h.col(j).begin());
  return h;
}

template class HessenbergLeastSquares<double>;
template class HessenbergLeastSquares<std::complex<double>>;

}  // namespace wingbeat
