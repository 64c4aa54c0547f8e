#pragma once

#include <optional>

#include "core/algebra/dense_matrix.hpp"

namespace wingbeat {

// What a deflated restart keeps of a Krylov space A Z_m = V_{m+1} H (eq:deflated-restart; Morgan
// 2002, doi:10.1137/S1064827599364659; with a flexible preconditioner Giraud et al. 2010,
// doi:10.1137/080741847): with P the `basis`,
//   V' = V P,  Z' = Z P_k,  A Z' = V' H',
// P_k being the first m rows and k columns of P.
template <class T>
struct DeflatedSpace {
  DenseMatrix<T> basis;       // (m+1) x (k+1), orthonormal
  DenseMatrix<T> hessenberg;  // H' = P^H H P_k, (k+1) x k
};

// Keeps the span of the `count` harmonic Ritz vectors of least magnitude and the direction of the
// residual, the one that H, (m+1) x m, does not reach. Real T takes a conjugate pair by real and
// imaginary part, and whole: k is then count + 1, or count - 1 where that would leave no room to
// grow. Empty where nothing can be kept: count < 1, H without full rank, or vectors so nearly
// dependent that the relation would be lost.
template <class T>
std::optional<DeflatedSpace<T>> deflated_space(const DenseMatrix<T>& h, int count);

}  // namespace wingbeat
