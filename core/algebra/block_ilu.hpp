#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/algebra/ilu_pattern.hpp"

namespace wingbeat {

// Incomplete LU factors of a block-sparse matrix with dense B x B blocks on one rank, A ~ L U with
// L of unit diagonal, kept where the pattern says (eq:block-ilu). Rows are eliminated in their order.
// T is double or std::complex<double>; vectors hold B values a row.
template <class T, int B>
class BlockIlu {
 public:
  explicit BlockIlu(std::shared_ptr<const IluPattern> pattern);

  // Factors the matrix of these blocks, row-major, one an entry of the matrix.
  // Throws InternalError where a diagonal block is singular to working precision.
  void factor(std::span<const T> blocks);
  bool is_factored() const { return is_factored_; }

  // x = (L U)^-1 b and x = (L U)^-T b (no conjugation); x and b do not overlap.
  void solve(std::span<const T> b, std::span<T> x) const;
  void solve_transpose(std::span<const T> b, std::span<T> x) const;

  double bytes() const;

 private:
  void check(std::span<const T> b, std::span<const T> x) const;

  std::shared_ptr<const IluPattern> pattern_;
  std::vector<T> values_;  // L, the inverses of the diagonal blocks of U, and the rest of U
  bool is_factored_ = false;
};

}  // namespace wingbeat
