#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/algebra/block_sparse.hpp"
#include "core/algebra/linear_operator.hpp"
#include "core/parallel/comm.hpp"
#include "core/parallel/ghost_exchange.hpp"

namespace wingbeat {

// How the matrix of a subdomain is solved with: by sparse LU, or by block ILU(k) (eq:block-ilu), which
// is not exact and takes a small part of the memory.
enum class SubdomainMethod { lu, ilu };

struct SubdomainOptions {
  int overlap = 3;  // layers of the matrix graph around a rank's cells
  SubdomainMethod method = SubdomainMethod::lu;
  int fill = 2;  // highest level of fill that ILU keeps
};

// A rank's own cells and layers of the matrix graph around them (each layer is what one application
// of the matrix reaches): which cells, where they live, the pattern of their rows restricted to the
// subdomain, and the order in which they are eliminated: METIS nested dissection for LU,
// Cuthill-McKee for ILU, whose pattern is found here. Built once for a pattern; collective.
class Subdomain {
 public:
  Subdomain(const Comm& comm, const GhostExchange& halo, std::shared_ptr<const BlockPattern> pattern,
            const SubdomainOptions& options);
  ~Subdomain();
  Subdomain(Subdomain&&) noexcept;

  int owned_count() const;
  int cell_count() const;  // owned cells first, then the overlap

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

// Restricted additive Schwarz with sparse LU (UMFPACK) or block ILU on the subdomain:
//   x = sum_ranks R0^T (R A R^T)^-1 R b,  A = matrix + diagonal,
// R0 restricting to owned cells, R to owned and overlap cells (Cai & Sarkis 1999,
// doi:10.1137/S106482759732678X). With LU on one rank it is an exact solve. T is double or
// std::complex<double>; vectors hold owned cells x B values. The transpose uses the same factors.
template <class T>
class SchwarzSolver final : public LinearOperator<T> {
 public:
  explicit SchwarzSolver(const Comm& comm, std::shared_ptr<const Subdomain> subdomain, int block_size);
  ~SchwarzSolver() override;

  // Factors matrix + shift, where shift adds shift[cell] to each of the cell's diagonal entries
  // (empty: none). The symbolic analysis is kept between calls. Collective.
  // Throws InternalError when the matrix is singular to working precision.
  template <int B>
  void factor(const BlockSparse<B>& matrix, std::span<const T> shift);
  bool is_factored() const;

  std::size_t local_size() const override;
  void apply(std::span<const T> x, std::span<T> y) const override;
  void apply_transpose(std::span<const T> x, std::span<T> y) const override;

  double factor_bytes() const;  // memory of the factors on this rank

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wingbeat
