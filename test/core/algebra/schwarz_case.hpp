#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "core/algebra/schwarz.hpp"
#include "test/core/algebra/model_grid.hpp"

namespace wingbeat::test {

using Complex = std::complex<double>;
inline constexpr int B = 4;

// A model matrix with a shift on its diagonal, and its Schwarz preconditioner, factored.
template <class T>
struct Preconditioned {
  Comm comm;
  ModelGrid<B> grid;
  BlockSparse<B> matrix = grid.matrix();
  std::vector<T> shift = grid.template shift<T>();
  ShiftedOperator<T, B> op{grid, matrix, shift};
  SchwarzSolver<T> schwarz;

  Preconditioned(int ni, int nj, const SubdomainOptions& options)
      : grid(comm, ni, nj),
        schwarz(comm, std::make_shared<Subdomain>(comm, grid.halo, grid.pattern, options), B) {
    schwarz.factor(matrix, std::span<const T>(shift));
  }
};

}  // namespace wingbeat::test
