#pragma once

#include <complex>
#include <memory>
#include <span>
#include <vector>

namespace wingbeat {

// LU factors of a square sparse matrix on one rank, by UMFPACK (Davis 2004,
// doi:10.1145/992200.992206). T is double or std::complex<double>. The unknowns are expected in a
// fill-reducing order: pivots stay on the diagonal unless it is too small.
template <class T>
class UmfpackLu {
 public:
  // Compressed rows with sorted columns; analysed once for all matrices of this pattern.
  UmfpackLu(std::vector<int> row_begin, std::vector<int> columns);

  // Factors the matrix of these values, one a column entry.
  // Throws InternalError when it is singular to working precision or memory runs out.
  void factor(std::span<const T> values);
  bool is_factored() const { return numeric_ != nullptr; }

  // x = A^-1 b and x = A^-T b (no conjugation); x and b do not overlap.
  void solve(std::span<const T> b, std::span<T> x) const;
  void solve_transpose(std::span<const T> b, std::span<T> x) const;

  double bytes() const { return bytes_; }

 private:
  struct FreeSymbolic {
    void operator()(void* object) const;
  };
  struct FreeNumeric {
    void operator()(void* object) const;
  };
  void solve_system(int system, std::span<const T> b, std::span<T> x) const;

  std::vector<int> row_begin_;
  std::vector<int> columns_;
  std::vector<double> control_;
  std::unique_ptr<void, FreeSymbolic> symbolic_;
  std::unique_ptr<void, FreeNumeric> numeric_;
  double bytes_ = 0.0;
};

}  // namespace wingbeat
