#pragma once

#include <span>
#include <vector>

#include "core/algebra/block_sparse.hpp"
#include "flow/flux_balance.hpp"

namespace wingbeat {

// Cell quantities of one block with their derivatives with respect to the cell's own state, and
// where each cell's Jacobian blocks lie in the matrix. All arrays by offset.
template <int Dim>
struct CellDerivatives {
  static constexpr int n = state_size<Dim>;

  BlockState<Dim, double> state;
  std::array<std::vector<double>, n> pressure;                 // [variable]: d p / d w
  std::array<std::array<std::vector<double>, n>, Dim> radius;  // [direction][variable]
  // Position in the matrix of the block (row: the cell, column: the cell `step` away in direction
  // d), for slots 0: the cell itself, 1 + 4 d + {0, 1, 2, 3}: steps -2, -1, 1, 2; -1 where none.
  std::array<std::vector<int>, 1 + 4 * Dim> positions;

  CellDerivatives(const FlowBlock<Dim>& block, const BlockPattern& pattern, const State<Dim, double>& fill);

  static int slot(int d, int step) { return step == 0 ? 0 : 1 + 4 * d + (step < 0 ? step + 2 : step + 1); }
};

// The exact Jacobian of FluxBalance<Dim, double>::evaluate with respect to the state, assembled
// from the same kernels with dual numbers: nothing is frozen, sensors and radii included.
template <int Dim>
class FlowJacobian {
 public:
  FlowJacobian(const FlowDomain<Dim>& domain, const FlowModel<Dim, double>& model);

  // matrix = d balance / d w at the state of one instance. Arguments as in FluxBalance::evaluate.
  void assemble(std::span<const double> w, std::span<const double> ghosts, const RigidMotion<double>& motion,
                BlockSparse<state_size<Dim>>& matrix);

 private:
  const FlowDomain<Dim>& domain_;
  FlowModel<Dim, double> model_;
  std::vector<CellDerivatives<Dim>> cells_;
};

}  // namespace wingbeat
