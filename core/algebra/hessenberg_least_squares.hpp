#pragma once

#include <span>
#include <vector>

#include "core/algebra/dense_matrix.hpp"

namespace wingbeat {

// The small problem of GMRES, min |c - H y|: H is (m+1) x m, its first k columns dense in their
// first k+1 rows (what a deflated restart keeps, eq:deflated-restart), upper Hessenberg after them.
// Kept triangular while columns are added: one QR of the dense part, then a Givens rotation a
// column. T is double or std::complex<double>.
template <class T>
class HessenbergLeastSquares {
 public:
  // k = 0: c = beta e_1.
  explicit HessenbergLeastSquares(double beta);
  // `kept` is (k+1) x k, k > 0, and c has k+1 entries.
  HessenbergLeastSquares(const DenseMatrix<T>& kept, const DenseVector<T>& c);

  // Adds column (h_0 .. h_j) with `subdiagonal` below it; returns the residual norm of the larger problem.
  double add_column(std::span<const T> column, double subdiagonal);

  int column_count() const { return static_cast<int>(columns_.size()); }
  // The minimiser; directions the operator maps to nothing, to round-off, get no weight.
  std::vector<T> solution() const;

  DenseMatrix<T> matrix() const;  // H as given

 private:
  struct Rotation {
    double cosine = 1.0;
    T sine = T(0);

    Rotation(T upper, double lower);
    void turn(T& upper, T& lower) const;
  };

  DenseMatrix<T> turned_;  // adjoint of the orthogonal factor of the dense part; 0 x 0 where there is none
  std::vector<Rotation> rotations_;
  std::vector<std::vector<T>> columns_;  // triangular
  std::vector<T> rhs_;                   // c, turned alike
  std::vector<std::vector<T>> given_;    // columns of H, to the subdiagonal
};

}  // namespace wingbeat
