#include "core/algebra/schwarz.hpp"

#include <algorithm>
#include <complex>
#include <string>

#include "core/algebra/subdomain_data.hpp"
#include "core/algebra/subdomain_factors.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
template <class T>
struct SchwarzSolver<T>::Impl {
  Comm comm;
  std::shared_ptr<const Subdomain> subdomain;
  int block_size;
  std::unique_ptr<SubdomainFactors<T>> factors;
  bool factored = false;

  std::size_t width() const { return static_cast<std::size_t>(block_size); }
  const Subdomain::Data& data() const { return subdomain->data(); }

  // Values of the subdomain's cells (owned, overlap) in elimination order, and back.
  std::vector<T> eliminated(std::span<const T> owned, std::span<const T> overlap) const {
    std::vector<T> x;
    x.reserve(owned.size() + overlap.size());
    for (const int cell : data().order) {
      const bool own = cell < data().owned_count;
      const auto first = own ? owned.begin() + cell * block_size
                             : overlap.begin() + (cell - data().owned_count) * block_size;
      x.insert(x.end(), first, first + block_size);
    }
    return x;
  }
  void restore(std::span<const T> x, std::span<T> owned, std::span<T> overlap) const {
    for (std::size_t q = 0; q < data().order.size(); ++q) {
      const int cell = data().order[q];
      const bool own = cell < data().owned_count;
      if (!own && overlap.empty()) continue;
      const auto target = own ? owned.begin() + cell * block_size
                              : overlap.begin() + (cell - data().owned_count) * block_size;
      std::copy_n(x.begin() + q * width(), block_size, target);
    }
  }
  std::vector<T> overlap_vector() const {
    return std::vector<T>((data().cell_count - data().owned_count) * width());
  }
};

template <class T>
SchwarzSolver<T>::SchwarzSolver(const Comm& comm, std::shared_ptr<const Subdomain> subdomain, int block_size)
    : impl_(std::make_unique<Impl>(
          Impl{comm, subdomain, block_size, make_subdomain_factors<T>(*subdomain, block_size)})) {}

template <class T>
SchwarzSolver<T>::~SchwarzSolver() = default;

template <class T>
template <int B>
void SchwarzSolver<T>::factor(const BlockSparse<B>& matrix, std::span<const T> shift) {
  const Subdomain::Data& d = impl_->data();
  ensure(B == impl_->block_size, "SchwarzSolver: matrix of another block size");
  ensure(matrix.pattern().block_count() == d.own_block_count, "SchwarzSolver: matrix of another pattern");
  ensure(shift.empty() || static_cast<int>(shift.size()) == d.owned_count,
         "SchwarzSolver: shift of a wrong size");
  impl_->factored = false;

  std::vector<double> fetched(d.overlap_blocks.ghost_count() * B * B);
  d.overlap_blocks.template gather<double>(matrix.values(), fetched, 1, B * B);
  const std::vector<T> no_shift(shift.empty() ? d.owned_count : 0);
  const std::span<const T> own_shift = shift.empty() ? std::span<const T>(no_shift) : shift;
  std::vector<T> overlap_shift(d.cell_count - d.owned_count);
  d.overlap_cells.template gather<T>(own_shift, overlap_shift, 1, 1);

  std::vector<T> blocks;
  blocks.reserve(d.columns.size() * B * B);
  for (int q = 0; q < d.cell_count; ++q) {
    const int cell = d.order[q];
    const T diagonal = cell < d.owned_count ? own_shift[cell] : overlap_shift[cell - d.owned_count];
    for (int k = d.row_begin[q]; k < d.row_begin[q + 1]; ++k) {
      const std::size_t origin = d.origins[k];
      const double* const block = origin < d.own_block_count
                                      ? matrix.values().data() + origin * B * B
                                      : fetched.data() + (origin - d.own_block_count) * B * B;
      for (int r = 0; r < B; ++r)
        for (int s = 0; s < B; ++s)
          blocks.push_back(block[r * B + s] + (d.columns[k] == q && r == s ? diagonal : T(0)));
    }
  }

  std::string failure;
  try {
    impl_->factors->factor(blocks);
  } catch (const InternalError& error) {
    failure = error.what();
  }
  // Every rank must leave together: one that went on alone would wait for ever.
  const bool failed = impl_->comm.any(!failure.empty());
  ensure(failure.empty(), "rank " + std::to_string(impl_->comm.rank()) + ": " + failure);
  ensure(!failed,
         "rank " + std::to_string(impl_->comm.rank()) + ": the factorization failed on another rank");
  impl_->factored = true;
}

template <class T>
bool SchwarzSolver<T>::is_factored() const {
  return impl_->factored;
}

template <class T>
std::size_t SchwarzSolver<T>::local_size() const {
  return static_cast<std::size_t>(impl_->data().owned_count) * impl_->width();
}

template <class T>
void SchwarzSolver<T>::apply(std::span<const T> x, std::span<T> y) const {
  ensure(is_factored(), "SchwarzSolver: apply before factor");
  ensure(x.size() == local_size() && y.size() == local_size(), "SchwarzSolver: vector of a wrong size");
  std::vector<T> overlap = impl_->overlap_vector();
  impl_->data().overlap_cells.template gather<T>(x, overlap, 1, impl_->block_size);
  const std::vector<T> b = impl_->eliminated(x, overlap);
  std::vector<T> solution(b.size());
  impl_->factors->solve(b, solution);
  impl_->restore(solution, y, {});
}

template <class T>
void SchwarzSolver<T>::apply_transpose(std::span<const T> x, std::span<T> y) const {
  ensure(is_factored(), "SchwarzSolver: apply before factor");
  ensure(x.size() == local_size() && y.size() == local_size(), "SchwarzSolver: vector of a wrong size");
  std::vector<T> overlap = impl_->overlap_vector();
  const std::vector<T> b = impl_->eliminated(x, overlap);
  std::vector<T> solution(b.size());
  impl_->factors->solve_transpose(b, solution);
  impl_->restore(solution, y, overlap);
  impl_->data().overlap_cells.template scatter_add<T>(overlap, y, 1, impl_->block_size);
}

template <class T>
double SchwarzSolver<T>::factor_bytes() const {
  return impl_->factors->bytes();
}

template class SchwarzSolver<double>;
template class SchwarzSolver<std::complex<double>>;
template void SchwarzSolver<double>::factor(const BlockSparse<1>&, std::span<const double>);
template void SchwarzSolver<double>::factor(const BlockSparse<3>&, std::span<const double>);
template void SchwarzSolver<double>::factor(const BlockSparse<4>&, std::span<const double>);
template void SchwarzSolver<double>::factor(const BlockSparse<5>&, std::span<const double>);
using Complex = std::complex<double>;
template void SchwarzSolver<Complex>::factor(const BlockSparse<1>&, std::span<const Complex>);
template void SchwarzSolver<Complex>::factor(const BlockSparse<3>&, std::span<const Complex>);
template void SchwarzSolver<Complex>::factor(const BlockSparse<4>&, std::span<const Complex>);
template void SchwarzSolver<Complex>::factor(const BlockSparse<5>&, std::span<const Complex>);

}  // namespace wingbeat
