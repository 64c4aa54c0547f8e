#pragma once

#include <span>
#include <vector>

#include "flow/flow_domain.hpp"
#include "flow/motion.hpp"
#include "flow/scheme/jst.hpp"

namespace wingbeat {

// The equations of one instance: gas, free stream and scheme.
template <int Dim, class S>
struct FlowModel {
  Freestream<Dim, S> freestream;
  JstCoefficients jst;
};

// A block's cell quantities, by offset, in arrays of number type S.
template <int Dim, class S>
struct BlockState {
  std::array<std::vector<S>, state_size<Dim>> w;
  std::vector<S> p;
  std::array<std::vector<S>, Dim> radius;
  std::vector<S> sensor;                                              // of the direction being swept
  std::array<std::array<std::vector<S>, state_size<Dim>>, Dim> flux;  // [direction][variable]

  explicit BlockState(const BlockLayout<Dim>& layout, const State<Dim, S>& fill);
};

// The state of the cell (or of lanes<T> consecutive cells) at offset o.
template <int Dim, class T, class S>
State<Dim, T> load_state(const BlockState<Dim, S>& state, std::ptrdiff_t o) {
  State<Dim, T> w;
  for (int v = 0; v < state_size<Dim>; ++v) w[v] = Load<T>::from(state.w[v].data() + o);
  return w;
}

// Net flux out of every cell of a rank: sum over faces of (F - d), for one instance, on faces
// moved by a rigid motion (eq:euler-ale, eq:jst). S is double, computed several cells at a time,
// or a dual number, whose gradients are tangents of the whole balance.
template <int Dim, class S>
class FluxBalance {
 public:
  FluxBalance(const FlowDomain<Dim>& domain, const FlowModel<Dim, S>& model);

  // w: [owned cell][variable], ghosts: [ghost cell][variable] -> balance: [owned cell][variable].
  void evaluate(std::span<const S> w, std::span<const S> ghosts, const RigidMotion<S>& motion,
                std::span<S> balance);

 private:
  const FlowDomain<Dim>& domain_;
  FlowModel<Dim, S> model_;
  std::vector<BlockState<Dim, S>> states_;
};

// Copies a block's cells and halo into its state arrays, with pressures, extrapolated beyond
// physical boundaries.
template <int Dim, class S>
void load_block(const FlowBlock<Dim>& block, int owned_count, std::span<const S> w, std::span<const S> ghosts,
                double gamma, BlockState<Dim, S>& state);

// True where every density and pressure is positive and finite: w of any number of instances.
template <int Dim>
bool is_physical(std::span<const double> w, double gamma);

}  // namespace wingbeat
