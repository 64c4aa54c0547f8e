#pragma once

#include <memory>
#include <vector>

#include "core/algebra/block_sparse.hpp"
#include "core/parallel/comm.hpp"
#include "core/parallel/ghost_exchange.hpp"
#include "flow/block_geometry.hpp"
#include "flow/gas.hpp"
#include "partition/local_mesh.hpp"

namespace wingbeat {

// Halo position of a block that holds a cell of another block (or of another side of its own).
struct HaloCell {
  std::ptrdiff_t offset = 0;
  int number = 0;  // local number of the cell
};

// Halo position beyond a physical boundary: 2 x first - second, the linear extrapolation.
struct ExtrapolatedCell {
  std::ptrdiff_t offset = 0;
  std::ptrdiff_t first = 0;
  std::ptrdiff_t second = 0;  // equal to first where the block is one cell thick
};

// Face on a physical boundary.
struct BoundaryFace {
  BoundaryType type = BoundaryType::farfield;
  int direction = 0;
  double outward = 1.0;  // +1 where the stored normal points out of the flow, else -1
  std::ptrdiff_t face = 0;
  std::ptrdiff_t first = 0;  // cell at the boundary
  std::ptrdiff_t second = 0;
};

// A block as the flow kernels see it.
template <int Dim>
struct FlowBlock {
  int first_cell = 0;
  BlockGeometry<Dim> geometry;
  std::vector<int> number;  // [offset]: local number of the cell there, or -1
  std::vector<HaloCell> halo;
  std::vector<ExtrapolatedCell> extrapolated;
  std::vector<BoundaryFace> boundary;

  FlowBlock(const LocalBlock<Dim>& block, const Vec<double, 2>& axis);
};

// A rank's cells: its blocks, the exchange of ghost cells, and the pattern of the Jacobian's
// block rows. Vectors of one instance hold [owned cell][variable].
template <int Dim>
class FlowDomain {
 public:
  // `axis`: point of the axis of rotation of rigid motions, in chords. Collective.
  FlowDomain(const Comm& comm, const LocalMesh<Dim>& mesh, const Vec<double, 2>& axis);

  const Comm& comm() const { return comm_; }
  int owned_count() const { return owned_count_; }
  int ghost_count() const { return static_cast<int>(exchange_.ghost_count()); }
  std::size_t state_count() const { return static_cast<std::size_t>(owned_count_) * state_size<Dim>; }
  const std::vector<FlowBlock<Dim>>& blocks() const { return blocks_; }
  const GhostExchange& exchange() const { return exchange_; }
  std::shared_ptr<const BlockPattern> pattern() const { return pattern_; }
  std::span<const double> volumes() const { return volumes_; }  // [owned cell]
  const Vec<double, 2>& axis() const { return axis_; }

 private:
  Comm comm_;
  Vec<double, 2> axis_;
  int owned_count_;
  GhostExchange exchange_;
  std::vector<FlowBlock<Dim>> blocks_;
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<double> volumes_;
};

}  // namespace wingbeat
