#include "flow/flux_balance.hpp"

#include <algorithm>
#include <type_traits>

#include "flow/boundary.hpp"
#include "flow/cell_quantities.hpp"
#include "flow/moved_face.hpp"

namespace wingbeat {
namespace {

// The number type a sweep computes with: several doubles at a time, or one dual.
template <class S>
using Sweep = std::conditional_t<std::is_same_v<S, double>, Pack, S>;

// lanes<T> values, `stride` apart.
template <class T, class S>
T strided(const S* values, int stride) {
  if constexpr (lanes<T> == 1)
    return *values;
  else
    return T([&](auto lane) { return values[static_cast<int>(lane) * stride]; });
}

// Sweeps are flattened: a kernel left as a call would pass its packs through memory.
template <int Dim, class S, class Geometry>
[[gnu::flatten]] void sweep_radii(const Geometry& geometry, const RigidMotion<Sweep<S>>& motion, double gamma,
                                  BlockState<Dim, S>& state) {
  using T = Sweep<S>;
  const auto& layout = geometry.layout;
  const Box<Dim> cells = grown(box_of<Dim>(layout.extents), 1);
  for (std::ptrdiff_t o = layout.first(cells); o < layout.last(cells); o += lanes<T>) {
    const auto faces = mean_faces<Dim, T>(geometry, motion, o);
    const auto lambda = spectral_radii<Dim, T, T>(
        load_state<Dim, T>(state, o), Load<T>::from(state.p.data() + o), faces.normals, faces.sweeps, gamma);
    const auto radii = scaled_radii(lambda);
    for (int d = 0; d < Dim; ++d) store(radii[d], state.radius[d].data() + o);
  }
}

// What a sweep over faces leaves: the flux, its central part alone, or both parts apart.
enum class Part { flux, central, central_and_dissipation };

template <int Dim, class T>
void store_state(const State<Dim, T>& values, auto& field, std::ptrdiff_t o) {
  for (int v = 0; v < state_size<Dim>; ++v) store(values[v], field[v].data() + o);
}

// Flux through every face of a direction, as if it were an interior one, in excess of the free
// stream's.
template <Part part, int Dim, class S, class SchemeType, class Geometry>
[[gnu::flatten]] void sweep_fluxes(const Geometry& geometry, const RigidMotion<Sweep<S>>& motion, int d,
                                   const Freestream<Dim, S>& stream, const SchemeType& scheme,
                                   BlockState<Dim, S>& state) {
  using T = Sweep<S>;
  const auto freestream = widened<Dim, T>(stream.flow());
  const auto& layout = geometry.layout;
  const std::ptrdiff_t step = layout.strides[d];
  Box<Dim> faces = box_of<Dim>(layout.extents);
  ++faces.end[d];
  for (std::ptrdiff_t o = layout.first(faces); o < layout.last(faces); o += lanes<T>) {
    const FaceStencil<Dim, T> cells = load_stencil<Dim, T>(state, d, o, step);
    const auto face = moved_face<Dim, T>(geometry, motion, d, o);
    State<Dim, T> flux = central_flux<Dim, T>(cells, face, freestream);
    if constexpr (part == Part::flux) flux -= scheme.dissipation(cells, face, freestream, stream.gamma);
    if constexpr (part == Part::central_and_dissipation)
      store_state<Dim, T>(scheme.dissipation(cells, face, freestream, stream.gamma), state.dissipation[d], o);
    store_state<Dim, T>(flux, state.flux[d], o);
  }
}

// Replaces the fluxes of the physical boundaries of a direction.
template <int Dim, class S, class Geometry>
void set_boundary_fluxes(const FlowBlock<Dim>& block, const Geometry& geometry, const RigidMotion<S>& motion,
                         int d, const FlowModel<Dim, S>& model, BlockState<Dim, S>& state) {
  for (const BoundaryFace& boundary : block.boundary) {
    if (boundary.direction != d) continue;
    const auto face = outward_face<Dim, S>(geometry, motion, boundary);
    const State<Dim, S> flux =
        boundary_flux<Dim, S>(boundary.type, load_state<Dim, S>(state, boundary.first),
                              state.p[static_cast<std::size_t>(boundary.first)],
                              state.p[static_cast<std::size_t>(boundary.second)], face, model.freestream);
    for (int v = 0; v < state_size<Dim>; ++v)
      state.flux[d][v][static_cast<std::size_t>(boundary.face)] = boundary.outward * flux[v];
  }
}

// What leaves lanes<Sweep<S>> consecutive cells, the first at offset o: the differences of the fluxes
// through their faces, [cell][variable].
template <int Dim, class S>
auto outflow(const BlockLayout<Dim>& layout, const FaceField<Dim, S>& fluxes, std::ptrdiff_t o) {
  using T = Sweep<S>;
  constexpr int n = state_size<Dim>;
  S by_variable[n][lanes<T>];
  for (int v = 0; v < n; ++v) {
    T sum(0.0);
    for (int d = 0; d < Dim; ++d) {
      const S* flux = fluxes[d][v].data() + o;
      sum += Load<T>::from(flux + layout.strides[d]) - Load<T>::from(flux);
    }
    store(sum, by_variable[v]);
  }
  std::array<S, static_cast<std::size_t>(n * lanes<T>)> by_cell;
  for (int lane = 0; lane < lanes<T>; ++lane)
    for (int v = 0; v < n; ++v) by_cell[static_cast<std::size_t>(lane * n + v)] = by_variable[v][lane];
  return by_cell;
}

// Calls f(offset, cell, cells) for the cells of a block, at most lanes<Sweep<S>> of a row at a time:
// offset and number of the first of them.
template <int Dim, class S, class F>
void for_each_pack(const FlowBlock<Dim>& block, F&& f) {
  constexpr int width = lanes<Sweep<S>>;
  const auto& layout = block.geometry.layout;
  const int length = layout.extents[0];
  Box<Dim> rows = box_of<Dim>(layout.extents);
  rows.end[0] = 1;
  std::ptrdiff_t cell = block.first_cell;
  for_each(rows, [&](const Index<Dim>& row) {
    const std::ptrdiff_t o = layout.offset(row);
    for (int i = 0; i < length; i += width) f(o + i, cell + i, std::min(width, length - i));
    cell += length;
  });
}

// balance = what the fluxes carry out of each cell.
template <int Dim, class S>
void set_balance(const FlowBlock<Dim>& block, const FaceField<Dim, S>& fluxes, std::span<S> balance) {
  constexpr int n = state_size<Dim>;
  for_each_pack<Dim, S>(block, [&](std::ptrdiff_t o, std::ptrdiff_t cell, int cells) {
    const auto out = outflow<Dim, S>(block.geometry.layout, fluxes, o);
    std::copy_n(out.data(), cells * n, balance.data() + cell * n);
  });
}

// balance = what the fluxes carry out of each cell, less its dissipation.
template <int Dim>
void set_balance(const FlowBlock<Dim>& block, const FaceField<Dim, double>& fluxes,
                 std::span<const double> dissipation, std::span<double> balance) {
  constexpr int n = state_size<Dim>;
  for_each_pack<Dim, double>(block, [&](std::ptrdiff_t o, std::ptrdiff_t cell, int cells) {
    const auto out = outflow<Dim, double>(block.geometry.layout, fluxes, o);
    const double* taken = dissipation.data() + cell * n;
    double* result = balance.data() + cell * n;
    for (int i = 0; i < cells * n; ++i) result[i] = out[static_cast<std::size_t>(i)] - taken[i];
  });
}

// dissipation += share of (what the fluxes bring into each cell - dissipation); a share of 1 forgets
// even what is not a number.
template <int Dim>
void renew_dissipation(const FlowBlock<Dim>& block, const FaceField<Dim, double>& fluxes, double share,
                       std::span<double> dissipation) {
  constexpr int n = state_size<Dim>;
  for_each_pack<Dim, double>(block, [&](std::ptrdiff_t o, std::ptrdiff_t cell, int cells) {
    const auto out = outflow<Dim, double>(block.geometry.layout, fluxes, o);
    double* result = dissipation.data() + cell * n;
    for (int i = 0; i < cells * n; ++i) {
      const double renewed = out[static_cast<std::size_t>(i)];
      result[i] = share == 1.0 ? renewed : result[i] + share * (renewed - result[i]);
    }
  });
}

// Physical boundaries have no dissipation.
template <int Dim, class S>
void clear_boundary_fluxes(const FlowBlock<Dim>& block, FaceField<Dim, S>& fluxes) {
  for (const BoundaryFace& boundary : block.boundary)
    for (auto& values : fluxes[static_cast<std::size_t>(boundary.direction)])
      values[static_cast<std::size_t>(boundary.face)] = S(0.0);
}

template <int Dim, class S>
FaceField<Dim, S> zero_field(const BlockLayout<Dim>& layout) {
  FaceField<Dim, S> field;
  for (auto& direction : field)
    for (auto& values : direction) values.assign(layout.size, S(0.0));
  return field;
}

// All face sweeps of a block whose cells are loaded.
template <Part part, int Dim, class S, class SchemeType, class Geometry>
void sweep_block(const FlowBlock<Dim>& block, const Geometry& geometry, const FlowModel<Dim, S>& model,
                 const SchemeType& scheme, const RigidMotion<S>& motion, BlockState<Dim, S>& state) {
  const auto wide_motion = widen(motion);
  if constexpr (SchemeType::uses_radii && part != Part::central)
    sweep_radii<Dim, S>(geometry, wide_motion, model.freestream.gamma, state);
  for (int d = 0; d < Dim; ++d) {
    sweep_fluxes<part, Dim, S>(geometry, wide_motion, d, model.freestream, scheme, state);
    set_boundary_fluxes<Dim, S>(block, geometry, motion, d, model, state);
  }
}

}  // namespace

template <int Dim, class S>
BlockState<Dim, S>::BlockState(const BlockLayout<Dim>& layout, const State<Dim, S>& fill) {
  for (int v = 0; v < state_size<Dim>; ++v) w[v].assign(layout.size, fill[v]);
  flux = zero_field<Dim, S>(layout);
  p.assign(layout.size, S(1.0));
  for (auto& values : radius) values.assign(layout.size, S(1.0));
}

template <int Dim, class S>
void load_block(const FlowBlock<Dim>& block, int owned_count, std::span<const S> w, std::span<const S> ghosts,
                double gamma, BlockState<Dim, S>& state) {
  using T = Sweep<S>;
  constexpr int n = state_size<Dim>;
  const auto& layout = block.geometry.layout;
  for_each_pack<Dim, S>(block, [&](std::ptrdiff_t o, std::ptrdiff_t cell, int cells) {
    const S* in = w.data() + cell * n;
    if (cells == lanes<T>) {
      for (int v = 0; v < n; ++v) store(strided<T>(in + v, n), state.w[v].data() + o);
    } else {
      for (int i = 0; i < cells; ++i)
        for (int v = 0; v < n; ++v) state.w[v][static_cast<std::size_t>(o + i)] = in[i * n + v];
    }
  });
  for (const HaloCell& halo : block.halo) {
    const S* from = halo.number < owned_count
                        ? w.data() + static_cast<std::size_t>(halo.number) * n
                        : ghosts.data() + static_cast<std::size_t>(halo.number - owned_count) * n;
    for (int v = 0; v < n; ++v) state.w[v][static_cast<std::size_t>(halo.offset)] = from[v];
  }

  const Box<Dim> all = grown(box_of<Dim>(layout.extents), halo_layers);
  for (std::ptrdiff_t o = layout.first(all); o < layout.last(all); o += lanes<T>)
    store(pressure<Dim, T>(load_state<Dim, T>(state, o), gamma), state.p.data() + o);

  for (const ExtrapolatedCell& cell : block.extrapolated) {
    const auto extrapolate = [&](std::vector<S>& values) {
      values[static_cast<std::size_t>(cell.offset)] =
          2.0 * values[static_cast<std::size_t>(cell.first)] - values[static_cast<std::size_t>(cell.second)];
    };
    for (int v = 0; v < n; ++v) extrapolate(state.w[v]);
    extrapolate(state.p);
  }
}

template <int Dim, class S>
FluxBalance<Dim, S>::FluxBalance(const FlowDomain<Dim>& domain, const FlowModel<Dim, S>& model)
    : domain_(domain), model_(model) {
  for (const auto& block : domain.blocks())
    states_.emplace_back(block.geometry.layout, model.freestream.state());
}

template <int Dim, class S>
template <class Visitor>
void FluxBalance<Dim, S>::evaluate_blocks(std::span<const S> w, std::span<const S> ghosts,
                                          const Visitor& evaluate_block) {
  for (std::size_t b = 0; b < states_.size(); ++b) {
    const FlowBlock<Dim>& block = domain_.blocks()[b];
    load_block<Dim, S>(block, domain_.owned_count(), w, ghosts, model_.freestream.gamma, states_[b]);
    std::visit([&](const auto& scheme) { evaluate_block(block, scheme, states_[b]); }, model_.scheme);
  }
}

template <int Dim, class S>
void FluxBalance<Dim, S>::evaluate(std::span<const S> w, std::span<const S> ghosts,
                                   const RigidMotion<S>& motion, std::span<S> balance) {
  evaluate_blocks(w, ghosts, [&](const auto& block, const auto& scheme, auto& state) {
    sweep_block<Part::flux, Dim, S>(block, block.geometry, model_, scheme, motion, state);
    set_balance<Dim, S>(block, state.flux, balance);
  });
}

template <int Dim, class S>
void FluxBalance<Dim, S>::evaluate_changed(std::span<const S> w, std::span<const S> ghosts,
                                           const RigidMotion<S>& motion,
                                           std::span<const BlockGeometry<Dim>> change,
                                           std::span<S> balance) requires std::is_same_v<S, Dual<double, 1>> {
  std::size_t b = 0;
  evaluate_blocks(w, ghosts, [&](const auto& block, const auto& scheme, auto& state) {
    const ChangedGeometry<Dim> geometry{block.geometry, change[b++]};
    sweep_block<Part::flux, Dim, S>(block, geometry, model_, scheme, motion, state);
    set_balance<Dim, S>(block, state.flux, balance);
  });
}

template <int Dim, class S>
void load_radii(const FlowBlock<Dim>& block, const RigidMotion<S>& motion, double gamma,
                BlockState<Dim, S>& state) {
  sweep_radii<Dim, S>(block.geometry, widen(motion), gamma, state);
}

template <int Dim, class S>
void FluxBalance<Dim, S>::evaluate_stage(std::span<const S> w, std::span<const S> ghosts,
                                         const RigidMotion<S>& motion, double renewed,
                                         std::span<S> dissipation,
                                         std::span<S> balance) requires std::is_same_v<S, double> {
  evaluate_blocks(w, ghosts, [&](const auto& block, const auto& scheme, auto& state) {
    if (renewed == 0.0) {
      sweep_block<Part::central, Dim, S>(block, block.geometry, model_, scheme, motion, state);
    } else {
      if (state.dissipation[0][0].empty()) state.dissipation = zero_field<Dim, S>(block.geometry.layout);
      sweep_block<Part::central_and_dissipation, Dim, S>(block, block.geometry, model_, scheme, motion,
                                                         state);
      clear_boundary_fluxes<Dim, S>(block, state.dissipation);
      renew_dissipation<Dim>(block, state.dissipation, renewed, dissipation);
    }
    set_balance<Dim>(block, state.flux, dissipation, balance);
  });
}

template <int Dim>
bool is_physical(std::span<const double> w, double gamma) {
  constexpr int n = state_size<Dim>;
  for (std::size_t c = 0; c < w.size(); c += n) {
    State<Dim, double> cell;
    for (int v = 0; v < n; ++v) cell[v] = w[c + static_cast<std::size_t>(v)];
    if (!(cell[0] > 0.0 && pressure<Dim, double>(cell, gamma) > 0.0)) return false;
  }
  return true;
}

template bool is_physical<2>(std::span<const double>, double);
template bool is_physical<3>(std::span<const double>, double);

template struct BlockState<2, double>;
template struct BlockState<3, double>;
template void load_block<2, double>(const FlowBlock<2>&, int, std::span<const double>,
                                    std::span<const double>, double, BlockState<2, double>&);
template void load_block<3, double>(const FlowBlock<3>&, int, std::span<const double>,
                                    std::span<const double>, double, BlockState<3, double>&);
template void load_radii<2, double>(const FlowBlock<2>&, const RigidMotion<double>&, double,
                                    BlockState<2, double>&);
template void load_radii<3, double>(const FlowBlock<3>&, const RigidMotion<double>&, double,
                                    BlockState<3, double>&);
template class FluxBalance<2, double>;
template class FluxBalance<3, double>;
template class FluxBalance<2, Dual<double, 1>>;
template class FluxBalance<3, Dual<double, 1>>;
template class FluxBalance<2, Dual<double, 3>>;
template class FluxBalance<3, Dual<double, 3>>;

}  // namespace wingbeat
