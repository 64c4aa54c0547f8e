#include "flow/flow_jacobian.hpp"

#include "flow/boundary.hpp"
#include "flow/cell_quantities.hpp"
#include "flow/moved_face.hpp"

namespace wingbeat {
namespace {

// Derivatives of a flux with respect to what it reads, all taken as independent: chaining with
// the cell derivatives comes after, since a cell beyond a physical boundary is extrapolated in
// state and pressure separately. Innermost index: consecutive faces, a lane each.
template <int Dim>
struct FaceGradients {
  static constexpr int n = state_size<Dim>;
  using Lane = std::array<double, lanes<Pack>>;

  std::array<std::array<std::array<Lane, n>, n>, 4> state;  // [cell][row][state variable]
  std::array<std::array<Lane, n>, 4> pressure;              // [cell][row]
  std::array<std::array<Lane, n>, 2> radius;                // [cell 1 or 2][row]
};

// Of -d, the dissipation of any scheme: one cell's state and pressure are seeded at a time.
template <int Dim, class SchemeType>
void differentiate_dissipation(const SchemeType& scheme, const FaceStencil<Dim, Pack>& cells,
                               const MovedFace<Dim, Pack>& face, const UniformFlow<Dim, Pack>& freestream,
                               double gamma, FaceGradients<Dim>& gradients) {
  constexpr int n = state_size<Dim>;
  const auto dissipation_with = [&]<int Seeds>(auto&& seed) {
    using D = Dual<Pack, Seeds>;
    auto seeded = lifted<D>(cells);
    seed(seeded);
    return scheme.dissipation(
        seeded, MovedFace<Dim, D>{lifted<D>(face.normal), face.sweep},
        UniformFlow<Dim, D>{lifted<D>(freestream.w), lifted<D>(freestream.u), freestream.p}, gamma);
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const auto d = dissipation_with.template operator()<n + 1>([&](auto& seeded) {
      const auto cell = static_cast<int>(k);
      for (int v = 0; v < n; ++v) seeded.w[cell][v].gradient[v] = Pack(1.0);
      seeded.p[cell].gradient[n] = Pack(1.0);
    });
    for (int row = 0; row < n; ++row) {
      for (int v = 0; v < n; ++v) store(-d[row].gradient[v], gradients.state[k][row][v].data());
      store(-d[row].gradient[n], gradients.pressure[k][row].data());
    }
  }
  if constexpr (SchemeType::uses_radii) {
    const auto d = dissipation_with.template operator()<2>([&](auto& seeded) {
      for (int side = 0; side < 2; ++side) seeded.radius[side].gradient[side] = Pack(1.0);
    });
    for (int row = 0; row < n; ++row)
      for (std::size_t side = 0; side < 2; ++side)
        store(-d[row].gradient[static_cast<int>(side)], gradients.radius[side][row].data());
  }
}

// The scalar scheme is linear in the states at given weights: one evaluation does, with seeds 0..3
// on the pressures, 4 and 5 on the radii.
template <int Dim>
void differentiate_dissipation(const JstScheme& jst, const FaceStencil<Dim, Pack>& cells,
                               const MovedFace<Dim, Pack>& /*face*/,
                               const UniformFlow<Dim, Pack>& /*uniform*/, double /*gamma*/,
                               FaceGradients<Dim>& gradients) {
  constexpr int n = state_size<Dim>;
  using D = Dual<Pack, 6>;
  FaceStencil<Dim, Pack, D> seeded;
  seeded.w = cells.w;
  for (int k = 0; k < 4; ++k) seeded.p[k] = D::seed(cells.p[k], k);
  for (int k = 0; k < 2; ++k) seeded.radius[k] = D::seed(cells.radius[k], 4 + k);
  const auto weights = jst_weights(seeded, jst);
  const auto dissipation = jst_dissipation<Dim>(seeded, weights);
  for (std::size_t k = 0; k < 4; ++k) {
    const Pack weight =
        first_difference[k] * weights.second.value - third_difference[k] * weights.fourth.value;
    for (int row = 0; row < n; ++row) {
      for (int v = 0; v < n; ++v) store(row == v ? -weight : Pack(0.0), gradients.state[k][row][v].data());
      store(-dissipation[row].gradient[static_cast<int>(k)], gradients.pressure[k][row].data());
    }
  }
  for (std::size_t side = 0; side < 2; ++side)
    for (int row = 0; row < n; ++row)
      store(-dissipation[row].gradient[4 + static_cast<int>(side)], gradients.radius[side][row].data());
}

// Adds those of the central flux: half of each side's flux, a function of that side's state and
// pressure.
template <int Dim>
void add_central_gradients(const FaceStencil<Dim, Pack>& cells, const MovedFace<Dim, Pack>& face,
                           FaceGradients<Dim>& gradients) {
  constexpr int n = state_size<Dim>;
  using C = Dual<Pack, n + 1>;
  const auto add = [](const Pack& value, std::array<double, lanes<Pack>>& to) {
    store(Load<Pack>::from(to.data()) + value, to.data());
  };
  for (std::size_t k : {1, 2}) {
    State<Dim, C> w;
    for (int v = 0; v < n; ++v) w[v] = C::seed(cells.w[static_cast<int>(k)][v], v);
    const auto flux = euler_flux<Dim>(w, C::seed(cells.p[static_cast<int>(k)], n), face.normal, face.sweep);
    for (int row = 0; row < n; ++row) {
      for (int v = 0; v < n; ++v) add(0.5 * flux[row].gradient[v], gradients.state[k][row][v]);
      add(0.5 * flux[row].gradient[n], gradients.pressure[k][row]);
    }
  }
}

// Adds the derivatives of one face's flux to the rows of the two cells beside it.
template <int Dim>
struct FaceScatter {
  static constexpr int n = state_size<Dim>;
  const CellDerivatives<Dim>& cells;
  const FaceGradients<Dim>& gradients;
  BlockSparse<n>& matrix;
  int d;
  std::ptrdiff_t face;  // offset: cell 2 of the stencil
  std::ptrdiff_t step;  // stride of direction d
  std::size_t lane;
  bool has_radii;  // whether the scheme reads spectral radii

  std::ptrdiff_t cell(std::size_t k) const { return face + (static_cast<std::ptrdiff_t>(k) - 2) * step; }

  // k: what the flux reads; source: the stencil cell whose state that is, times weight.
  void add(std::size_t k, std::size_t source, double weight) const {
    const auto at = static_cast<std::size_t>(cell(source));
    std::array<double, n * n> block;
    for (std::size_t row = 0; row < n; ++row) {
      const double by_pressure = weight * gradients.pressure[k][row][lane];
      for (std::size_t v = 0; v < n; ++v)
        block[row * n + v] = weight * gradients.state[k][row][v][lane] + by_pressure * cells.pressure[v][at];
    }
    if (has_radii && k == source && (k == 1 || k == 2)) add_radius_terms(k - 1, at, block);
    add_to_row(1, source, +1.0, block);
    add_to_row(2, source, -1.0, block);
  }

  // What only the two cells beside the face have: their spectral radius.
  void add_radius_terms(std::size_t side, std::size_t at, std::array<double, n * n>& block) const {
    for (std::size_t row = 0; row < n; ++row) {
      const double by_radius = gradients.radius[side][row][lane];
      for (std::size_t v = 0; v < n; ++v) block[row * n + v] += by_radius * cells.radius[d][v][at];
    }
  }

  // The flux leaves cell 1 and enters cell 2.
  void add_to_row(std::size_t row_cell, std::size_t column_cell, double sign,
                  const std::array<double, n * n>& block) const {
    const int slot =
        CellDerivatives<Dim>::slot(d, static_cast<int>(column_cell) - static_cast<int>(row_cell));
    const int position = cells.positions[slot][static_cast<std::size_t>(cell(row_cell))];
    if (position < 0) return;
    auto values = matrix.block(static_cast<std::size_t>(position));
    for (std::size_t i = 0; i < n * n; ++i) values[i] += sign * block[i];
  }
};

// Faces of direction d at the low side of the cells of a plane, the last index constant; with the
// last plane of that direction, those at its high side, too.
template <int Dim>
Box<Dim> faces_of_plane(const Index<Dim>& extents, int plane, int d) {
  Box<Dim> faces = box_of<Dim>(extents);
  faces.begin[Dim - 1] = plane;
  faces.end[Dim - 1] = plane + 1;
  if (d < Dim - 1 || plane + 1 == extents[d]) ++faces.end[d];
  return faces;
}

// Flattened, as the sweeps of the balance are: packs and blocks stay in registers.
template <int Dim, class SchemeType>
[[gnu::flatten]] void assemble_interior(const FlowBlock<Dim>& block, const RigidMotion<Pack>& motion, int d,
                                        const Box<Dim>& faces, const Freestream<Dim, double>& stream,
                                        const SchemeType& scheme, const CellDerivatives<Dim>& cells,
                                        BlockSparse<state_size<Dim>>& matrix) {
  const auto& layout = block.geometry.layout;
  const std::ptrdiff_t step = layout.strides[d];
  const auto exists = [&](std::ptrdiff_t o) { return block.number[static_cast<std::size_t>(o)] >= 0; };
  const auto owns_row = [&](std::ptrdiff_t o) {
    return cells.positions[0][static_cast<std::size_t>(o)] >= 0;
  };
  const std::ptrdiff_t last = layout.last(faces);
  const auto freestream = widened<Dim, Pack>(stream.flow());
  FaceGradients<Dim> gradients;
  for (std::ptrdiff_t o = layout.first(faces); o < last; o += lanes<Pack>) {
    const auto stencil = load_stencil<Dim, Pack>(cells.state, d, o, step);
    const auto moved = moved_face<Dim, Pack>(block.geometry, motion, d, o);
    differentiate_dissipation<Dim>(scheme, stencil, moved, freestream, stream.gamma, gradients);
    add_central_gradients<Dim>(stencil, moved, gradients);
    for (std::ptrdiff_t face = o; face < std::min(o + lanes<Pack>, last); ++face) {
      const bool interior = exists(face - step) && exists(face);
      if (!interior || !(owns_row(face - step) || owns_row(face))) continue;
      const FaceScatter<Dim> scatter{cells,
                                     gradients,
                                     matrix,
                                     d,
                                     face,
                                     step,
                                     static_cast<std::size_t>(face - o),
                                     SchemeType::uses_radii};
      scatter.add(1, 1, 1.0);
      scatter.add(2, 2, 1.0);
      // The outer cells, or the two inner ones they are extrapolated from.
      if (exists(face - 2 * step)) {
        scatter.add(0, 0, 1.0);
      } else {
        scatter.add(0, 1, 2.0);
        scatter.add(0, 2, -1.0);
      }
      if (exists(face + step)) {
        scatter.add(3, 3, 1.0);
      } else {
        scatter.add(3, 2, 2.0);
        scatter.add(3, 1, -1.0);
      }
    }
  }
}

template <int Dim>
void assemble_boundary(const FlowBlock<Dim>& block, const RigidMotion<double>& motion,
                       const FlowModel<Dim, double>& model, const CellDerivatives<Dim>& cells,
                       BlockSparse<state_size<Dim>>& matrix) {
  constexpr int n = state_size<Dim>;
  State<Dim, Dual<double, n>> outside;
  const State<Dim, double> freestream = model.freestream.state();
  for (int v = 0; v < n; ++v) outside[v] = freestream[v];

  for (const BoundaryFace& boundary : block.boundary) {
    const auto face = moved_face<Dim, double>(block.geometry, motion, boundary.direction, boundary.face);
    const Vec<double, Dim> outward = boundary.outward * face.normal;
    const double sweep = boundary.outward * face.sweep;
    const auto row = static_cast<std::size_t>(boundary.first);
    const auto add = [&](std::ptrdiff_t column, auto&& derivative) {
      const int step = column == boundary.first ? 0 : (boundary.outward > 0 ? -1 : 1);
      const int position = cells.positions[CellDerivatives<Dim>::slot(boundary.direction, step)][row];
      auto values = matrix.block(static_cast<std::size_t>(position));
      for (int i = 0; i < n; ++i)
        for (int v = 0; v < n; ++v) values[static_cast<std::size_t>(i * n + v)] += derivative(i, v);
    };
    if (boundary.type == BoundaryType::farfield) {
      State<Dim, Dual<double, n>> interior;
      for (int v = 0; v < n; ++v) interior[v] = Dual<double, n>::seed(cells.state.w[v][row], v);
      const auto flux = farfield_flux<Dim, Dual<double, n>, double>(interior, outside, outward, sweep,
                                                                    model.freestream.gamma);
      add(boundary.first, [&](int i, int v) { return flux[i].gradient[v]; });
    } else {
      const auto second = static_cast<std::size_t>(boundary.second);
      const auto p_wall = wall_pressure(Dual<double, 2>::seed(cells.state.p[row], 0),
                                        Dual<double, 2>::seed(cells.state.p[second], 1));
      const auto flux = wall_flux<Dim, Dual<double, 2>, double>(p_wall, outward, sweep);
      add(boundary.first, [&](int i, int v) { return flux[i].gradient[0] * cells.pressure[v][row]; });
      add(boundary.second, [&](int i, int v) { return flux[i].gradient[1] * cells.pressure[v][second]; });
    }
  }
}

template <int Dim>
[[gnu::flatten]] void differentiate_cells(const BlockGeometry<Dim>& geometry,
                                          const RigidMotion<double>& motion, double gamma,
                                          CellDerivatives<Dim>& cells) {
  constexpr int n = state_size<Dim>;
  using D = Dual<Pack, n>;
  const auto& layout = geometry.layout;
  const auto wide_motion = widen(motion);
  const auto seeded = [&](std::ptrdiff_t o) {
    State<Dim, D> w;
    for (int v = 0; v < n; ++v) w[v] = D::seed(Load<Pack>::from(cells.state.w[v].data() + o), v);
    return w;
  };
  const Box<Dim> all = grown(box_of<Dim>(layout.extents), halo_layers);
  for (std::ptrdiff_t o = layout.first(all); o < layout.last(all); o += lanes<Pack>) {
    const D p = pressure<Dim, D>(seeded(o), gamma);
    for (int v = 0; v < n; ++v) store(p.gradient[v], cells.pressure[v].data() + o);
  }
  const Box<Dim> near = grown(box_of<Dim>(layout.extents), 1);
  for (std::ptrdiff_t o = layout.first(near); o < layout.last(near); o += lanes<Pack>) {
    const auto w = seeded(o);
    const auto faces = mean_faces<Dim, Pack>(geometry, wide_motion, o);
    const auto radii = scaled_radii(
        spectral_radii<Dim, D, Pack>(w, pressure<Dim, D>(w, gamma), faces.normals, faces.sweeps, gamma));
    for (int d = 0; d < Dim; ++d) {
      store(radii[d].value, cells.state.radius[d].data() + o);
      for (int v = 0; v < n; ++v) store(radii[d].gradient[v], cells.radius[d][v].data() + o);
    }
  }
}

}  // namespace

template <int Dim>
CellDerivatives<Dim>::CellDerivatives(const FlowBlock<Dim>& block, const BlockPattern& pattern,
                                      const State<Dim, double>& fill)
    : state(block.geometry.layout, fill) {
  const auto& layout = block.geometry.layout;
  for (auto& values : pressure) values.assign(layout.size, 0.0);
  for (auto& direction : radius)
    for (auto& values : direction) values.assign(layout.size, 0.0);
  for (auto& values : positions) values.assign(layout.size, -1);
  for_each(box_of<Dim>(layout.extents), [&](const Index<Dim>& cell) {
    const std::ptrdiff_t o = layout.offset(cell);
    const auto at = static_cast<std::size_t>(o);
    const int row = block.number[at];
    positions[0][at] = pattern.find(row, row);
    for (int d = 0; d < Dim; ++d)
      for (int step : {-2, -1, 1, 2}) {
        const int column = block.number[static_cast<std::size_t>(o + step * layout.strides[d])];
        if (column >= 0) positions[slot(d, step)][at] = pattern.find(row, column);
      }
  });
}

template <int Dim>
FlowJacobian<Dim>::FlowJacobian(const FlowDomain<Dim>& domain, const FlowModel<Dim, double>& model)
    : domain_(domain), model_(model) {
  for (const auto& block : domain.blocks())
    cells_.emplace_back(block, *domain.pattern(), model.freestream.state());
}

template <int Dim>
void FlowJacobian<Dim>::assemble(std::span<const double> w, std::span<const double> ghosts,
                                 const RigidMotion<double>& motion, BlockSparse<state_size<Dim>>& matrix) {
  matrix.set_zero();
  const auto wide_motion = widen(motion);
  const double gamma = model_.freestream.gamma;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    const FlowBlock<Dim>& block = domain_.blocks()[b];
    CellDerivatives<Dim>& cells = cells_[b];
    load_block<Dim, double>(block, domain_.owned_count(), w, ghosts, gamma, cells.state);
    differentiate_cells<Dim>(block.geometry, motion, gamma, cells);
    // Plane by plane, so that the rows of a plane stay in cache while the faces of all directions
    // add to them.
    const auto& extents = block.geometry.layout.extents;
    std::visit(
        [&](const auto& scheme) {
          for (int plane = 0; plane < extents[Dim - 1]; ++plane)
            for (int d = 0; d < Dim; ++d)
              assemble_interior<Dim>(block, wide_motion, d, faces_of_plane<Dim>(extents, plane, d),
                                     model_.freestream, scheme, cells, matrix);
        },
        model_.scheme);
    assemble_boundary<Dim>(block, motion, model_, cells, matrix);
  }
}

template struct CellDerivatives<2>;
template struct CellDerivatives<3>;
template class FlowJacobian<2>;
template class FlowJacobian<3>;

}  // namespace wingbeat
