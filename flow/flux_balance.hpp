#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "flow/flow_domain.hpp"
#include "flow/motion.hpp"
#include "flow/scheme/scheme.hpp"

namespace wingbeat {

// The equations of one instance: gas, free stream and scheme.
template <int Dim, class S>
struct FlowModel {
  Freestream<Dim, S> freestream;
  Scheme scheme;
};

// A flux through every face of a block: [direction][variable][offset].
template <int Dim, class S>
using FaceField = std::array<std::array<std::vector<S>, state_size<Dim>>, Dim>;

// A block's cell quantities, by offset, in arrays of number type S.
template <int Dim, class S>
struct BlockState {
  std::array<std::vector<S>, state_size<Dim>> w;
  std::vector<S> p;
  std::array<std::vector<S>, Dim> radius;
  FaceField<Dim, S> flux;
  FaceField<Dim, S> dissipation;  // empty unless it is kept apart from the flux

  explicit BlockState(const BlockLayout<Dim>& layout, const State<Dim, S>& fill);
};

// The state of the cell (or of lanes<T> consecutive cells) at offset o.
template <int Dim, class T, class S>
State<Dim, T> load_state(const BlockState<Dim, S>& state, std::ptrdiff_t o) {
  State<Dim, T> w;
  for (int v = 0; v < state_size<Dim>; ++v) w[v] = Load<T>::from(state.w[v].data() + o);
  return w;
}

// The four cells in line with the face (or with lanes<T> consecutive faces) at offset `face`.
template <int Dim, class T, class S>
FaceStencil<Dim, T> load_stencil(const BlockState<Dim, S>& state, int d, std::ptrdiff_t face,
                                 std::ptrdiff_t step) {
  FaceStencil<Dim, T> cells;
  for (int k = 0; k < 4; ++k) {
    const std::ptrdiff_t cell = face + (k - 2) * step;
    cells.w[k] = load_state<Dim, T>(state, cell);
    cells.p[k] = Load<T>::from(state.p.data() + cell);
  }
  for (int k = 0; k < 2; ++k) cells.radius[k] = Load<T>::from(state.radius[d].data() + face + (k - 1) * step);
  return cells;
}

// The same flow for every lane.
template <int Dim, class T, class S>
UniformFlow<Dim, T> widened(const UniformFlow<Dim, S>& flow) {
  UniformFlow<Dim, T> wide;
  for (int v = 0; v < state_size<Dim>; ++v) wide.w[v] = T(flow.w[v]);
  for (int d = 0; d < Dim; ++d) wide.u[d] = T(flow.u[d]);
  wide.p = T(flow.p);
  return wide;
}

// Net flux out of every cell of a rank: sum over faces of (F - d), for one instance, on faces
// moved by a rigid motion (eq:euler-ale, eq:scheme). S is double, computed several cells at a time,
// or a dual number, whose gradients are tangents of the whole balance.
template <int Dim, class S>
class FluxBalance {
 public:
  FluxBalance(const FlowDomain<Dim>& domain, const FlowModel<Dim, S>& model);

  // w: [owned cell][variable], ghosts: [ghost cell][variable] -> balance: [owned cell][variable].
  void evaluate(std::span<const S> w, std::span<const S> ghosts, const RigidMotion<S>& motion,
                std::span<S> balance);
  // The same on a geometry that changes, [block]: the change's tangent is added to the gradients.
  void evaluate_changed(std::span<const S> w, std::span<const S> ghosts, const RigidMotion<S>& motion,
                        std::span<const BlockGeometry<Dim>> change,
                        std::span<S> balance) requires std::is_same_v<S, Dual<double, 1>>;
  // balance = central part - dissipation; before that, `dissipation` (of the size of w) moves by the
  // share `renewed` to that of w. At 0 it is not computed, at 1 its old value does not count.
  void evaluate_stage(std::span<const S> w, std::span<const S> ghosts, const RigidMotion<S>& motion,
                      double renewed, std::span<S> dissipation,
                      std::span<S> balance) requires std::is_same_v<S, double>;

 private:
  template <class Visitor>
  void evaluate_blocks(std::span<const S> w, std::span<const S> ghosts, const Visitor& evaluate_block);

  const FlowDomain<Dim>& domain_;
  FlowModel<Dim, S> model_;
  std::vector<BlockState<Dim, S>> states_;
};

// Copies a block's cells and halo into its state arrays, with pressures, extrapolated beyond
// physical boundaries.
template <int Dim, class S>
void load_block(const FlowBlock<Dim>& block, int owned_count, std::span<const S> w, std::span<const S> ghosts,
                double gamma, BlockState<Dim, S>& state);

// The scaled spectral radii of a block whose cells are loaded, one layer beyond it included
// (eq:jst-radius).
template <int Dim, class S>
void load_radii(const FlowBlock<Dim>& block, const RigidMotion<S>& motion, double gamma,
                BlockState<Dim, S>& state);

// True where every density and pressure is positive and finite: w of any number of instances.
template <int Dim>
bool is_physical(std::span<const double> w, double gamma);

}  // namespace wingbeat
