#include "core/algebra/block_ilu.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <string>

#include "core/algebra/small_block.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// False where the block is singular to working precision.
template <class T, int B>
bool invert(SmallBlock<T, B> block) {
  // One type for every B: by sizes of their own these few lines take a minute to compile.
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<Matrix> map(block.data(), B, B);
  if (!map.allFinite() || map.cwiseAbs().maxCoeff() == 0.0) return false;
  const Eigen::PartialPivLU<Matrix> lu(map);
  if (!(lu.rcond() > std::numeric_limits<double>::epsilon())) return false;
  map = lu.solve(Matrix::Identity(B, B)).eval();
  return true;
}

template <class T, std::size_t N>
void subtract(const std::array<T, N>& a, std::span<T, N> from) {
  for (std::size_t e = 0; e < N; ++e) from[e] -= a[e];
}

// The B x B block at a position, and the B values of a row.
template <int B, class T>
auto block_at(std::span<T> values, int position) {
  return SmallBlock<T, B>(values.data() + position * block_entries<B>, block_entries<B>);
}
template <int B, class T>
auto row_at(std::span<T> x, int row) {
  return SmallVector<T, B>(x.data() + static_cast<std::ptrdiff_t>(row) * B, static_cast<std::size_t>(B));
}

}  // namespace

template <class T, int B>
BlockIlu<T, B>::BlockIlu(std::shared_ptr<const IluPattern> pattern) : pattern_(std::move(pattern)) {}

template <class T, int B>
void BlockIlu<T, B>::factor(std::span<const T> blocks) {
  constexpr std::size_t size = block_entries<B>;
  const IluPattern& p = *pattern_;
  ensure(blocks.size() == p.positions.size() * size, "BlockIlu: values of a wrong size");
  is_factored_ = false;
  values_.assign(p.columns.size() * size, T(0));
  for (std::size_t k = 0; k < p.positions.size(); ++k)
    std::copy_n(blocks.begin() + k * size, size, values_.begin() + p.positions[k] * size);

  const std::span<T> written(values_);
  const std::span<const T> read(values_);
  std::vector<int> position(p.row_count(), -1);  // of the columns of the row in hand
  for (int i = 0; i < p.row_count(); ++i) {
    for (int k = p.row_begin[i]; k < p.row_begin[i + 1]; ++k) position[p.columns[k]] = k;
    for (int l = p.row_begin[i]; l < p.diagonal[i]; ++l) {
      const int above = p.columns[l];
      const auto multiplier = block_product<T, B>(block_at<B>(read, l), block_at<B>(read, p.diagonal[above]));
      std::copy(multiplier.begin(), multiplier.end(), block_at<B>(written, l).begin());
      for (int u = p.diagonal[above] + 1; u < p.row_begin[above + 1]; ++u)
        if (const int target = position[p.columns[u]]; target >= 0)
          subtract(block_product<T, B>(multiplier, block_at<B>(read, u)), block_at<B>(written, target));
    }
    ensure((invert<T, B>(block_at<B>(written, p.diagonal[i]))),
           "BlockIlu: the diagonal block of row " + std::to_string(i) + " is singular");
    for (int k = p.row_begin[i]; k < p.row_begin[i + 1]; ++k) position[p.columns[k]] = -1;
  }
  is_factored_ = true;
}

template <class T, int B>
void BlockIlu<T, B>::check(std::span<const T> b, std::span<const T> x) const {
  ensure(is_factored_, "BlockIlu: solve before factor");
  ensure(b.size() == static_cast<std::size_t>(pattern_->row_count()) * B && x.size() == b.size(),
         "BlockIlu: vector of a wrong size");
}

template <class T, int B>
void BlockIlu<T, B>::solve(std::span<const T> b, std::span<T> x) const {
  check(b, x);
  const IluPattern& p = *pattern_;
  const std::span<const T> factors(values_), known(x);
  std::copy(b.begin(), b.end(), x.begin());
  for (int i = 0; i < p.row_count(); ++i)
    for (int l = p.row_begin[i]; l < p.diagonal[i]; ++l)
      subtract(product<T, B>(block_at<B>(factors, l), row_at<B>(known, p.columns[l])), row_at<B>(x, i));
  for (int i = p.row_count() - 1; i >= 0; --i) {
    for (int u = p.diagonal[i] + 1; u < p.row_begin[i + 1]; ++u)
      subtract(product<T, B>(block_at<B>(factors, u), row_at<B>(known, p.columns[u])), row_at<B>(x, i));
    const auto row = product<T, B>(block_at<B>(factors, p.diagonal[i]), row_at<B>(known, i));
    std::copy(row.begin(), row.end(), row_at<B>(x, i).begin());
  }
}

template <class T, int B>
void BlockIlu<T, B>::solve_transpose(std::span<const T> b, std::span<T> x) const {
  check(b, x);
  const IluPattern& p = *pattern_;
  const std::span<const T> factors(values_), known(x);
  std::copy(b.begin(), b.end(), x.begin());
  for (int i = 0; i < p.row_count(); ++i) {
    const auto row = transposed_product<T, B>(block_at<B>(factors, p.diagonal[i]), row_at<B>(known, i));
    std::copy(row.begin(), row.end(), row_at<B>(x, i).begin());
    for (int u = p.diagonal[i] + 1; u < p.row_begin[i + 1]; ++u)
      subtract(transposed_product<T, B>(block_at<B>(factors, u), row), row_at<B>(x, p.columns[u]));
  }
  for (int i = p.row_count() - 1; i >= 0; --i)
    for (int l = p.row_begin[i]; l < p.diagonal[i]; ++l)
      subtract(transposed_product<T, B>(block_at<B>(factors, l), row_at<B>(known, i)),
               row_at<B>(x, p.columns[l]));
}

template <class T, int B>
double BlockIlu<T, B>::bytes() const {
  const IluPattern& p = *pattern_;
  return static_cast<double>(values_.size() * sizeof(T) +
                             (p.columns.size() + p.row_begin.size() + p.diagonal.size()) * sizeof(int));
}

template class BlockIlu<double, 1>;
template class BlockIlu<double, 3>;
template class BlockIlu<double, 4>;
template class BlockIlu<double, 5>;
template class BlockIlu<std::complex<double>, 1>;
template class BlockIlu<std::complex<double>, 3>;
template class BlockIlu<std::complex<double>, 4>;
template class BlockIlu<std::complex<double>, 5>;

}  // namespace wingbeat
