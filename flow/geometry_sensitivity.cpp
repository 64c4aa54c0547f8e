#include "flow/geometry_sensitivity.hpp"

#include "flow/boundary.hpp"
#include "flow/cell_quantities.hpp"

namespace wingbeat {
namespace {

// What a block's faces are contracted with, by offset.
template <int Dim>
struct Contraction {
  BlockState<Dim, double> state;                // its fluxes: the multipliers of the fluxes through faces
  std::array<std::vector<double>, Dim> radius;  // sensitivities to the scaled spectral radii
};

// A flux leaves the cell below its face and enters the one above: its multiplier is the difference of
// theirs, where the block owns them. Physical boundaries are left out.
template <int Dim>
void set_face_multipliers(const FlowBlock<Dim>& block, std::span<const double> multipliers,
                          FaceField<Dim, double>& faces) {
  constexpr int n = state_size<Dim>;
  const auto& layout = block.geometry.layout;
  std::size_t number = static_cast<std::size_t>(block.first_cell) * n;
  for_each(box_of<Dim>(layout.extents), [&](const Index<Dim>& cell) {
    const std::ptrdiff_t o = layout.offset(cell);
    for (std::size_t v = 0; v < n; ++v, ++number)
      for (std::size_t d = 0; d < Dim; ++d) {
        faces[d][v][static_cast<std::size_t>(o)] -= multipliers[number];
        faces[d][v][static_cast<std::size_t>(o + layout.strides[d])] += multipliers[number];
      }
  });
  for (const BoundaryFace& boundary : block.boundary)
    for (auto& values : faces[static_cast<std::size_t>(boundary.direction)])
      values[static_cast<std::size_t>(boundary.face)] = 0.0;
}

void add(const Pack& value, std::vector<double>& values, std::ptrdiff_t o) {
  double* const to = values.data() + o;
  store(Load<Pack>::from(to) + value, to);
}

// sum_v multiplier_v d flux_v / d seed; none where there is nothing to contract, whatever the flux is.
template <int N, int Seeds>
std::array<Pack, Seeds> contracted(const Vec<Dual<Pack, Seeds>, N>& values, const Vec<Pack, N>& multipliers) {
  Pack size = abs(multipliers[0]);
  for (int v = 1; v < N; ++v) size += abs(multipliers[v]);
  const auto is_idle = !(Pack(0.0) < size);
  std::array<Pack, Seeds> sums;
  for (int k = 0; k < Seeds; ++k) {
    Pack sum = multipliers[0] * values[0].gradient[k];
    for (int v = 1; v < N; ++v) sum += multipliers[v] * values[v].gradient[k];
    sums[static_cast<std::size_t>(k)] = select(is_idle, Pack(0.0), sum);
  }
  return sums;
}

// Faces of a direction: to their area vectors and moments, and to the radii of the two cells beside them.
template <int Dim, class SchemeType>
[[gnu::flatten]] void contract_fluxes(const BlockGeometry<Dim>& geometry, const RigidMotion<double>& motion,
                                      int d, const Freestream<Dim, double>& stream, const SchemeType& scheme,
                                      Contraction<Dim>& with, BlockGeometry<Dim>& sensitivity) {
  constexpr int n = state_size<Dim>;
  using T = Dual<Pack, Dim + 3>;
  const auto uniform = widened<Dim, T>(stream.flow());
  const auto moving = widen_to_dual<Dim + 3>(motion);
  const auto& layout = geometry.layout;
  const std::ptrdiff_t step = layout.strides[d];
  Box<Dim> faces = box_of<Dim>(layout.extents);
  ++faces.end[d];
  for (std::ptrdiff_t o = layout.first(faces); o < layout.last(faces); o += lanes<Pack>) {
    auto cells = lifted<T>(load_stencil<Dim, Pack>(with.state, d, o, step));
    for (int side = 0; side < 2; ++side) cells.radius[side].gradient[Dim + 1 + side] = Pack(1.0);
    auto resting = resting_face<Dim, Pack>(geometry, d, o);
    RestingFace<Dim, T> seeded;
    for (int c = 0; c < Dim; ++c) seeded.normal[c] = T::seed(resting.normal[c], c);
    seeded.moment = T::seed(resting.moment, Dim);
    const auto face = moved(seeded, moving);
    auto flux = central_flux<Dim, T>(cells, face, uniform);
    flux -= scheme.dissipation(cells, face, uniform, stream.gamma);
    Vec<Pack, n> multipliers;
    for (int v = 0; v < n; ++v) multipliers[v] = Load<Pack>::from(with.state.flux[d][v].data() + o);
    const auto sums = contracted<n, Dim + 3>(flux, multipliers);
    for (std::size_t c = 0; c < Dim; ++c) add(sums[c], sensitivity.normal[d][c], o);
    add(sums[Dim], sensitivity.moment[d], o);
    if constexpr (SchemeType::uses_radii) {
      add(sums[Dim + 1], with.radius[d], o - step);
      add(sums[Dim + 2], with.radius[d], o);
    }
  }
}

// Radii of cells: to the two faces in each direction that their means are taken of.
template <int Dim>
[[gnu::flatten]] void contract_radii(const BlockGeometry<Dim>& geometry, const RigidMotion<double>& motion,
                                     double gamma, const Contraction<Dim>& with,
                                     BlockGeometry<Dim>& sensitivity) {
  constexpr int face_values = Dim + 1, seeds = Dim * face_values;
  using T = Dual<Pack, seeds>;
  const auto moving = widen_to_dual<seeds>(motion);
  const auto& layout = geometry.layout;
  const Box<Dim> cells = grown(box_of<Dim>(layout.extents), 1);
  for (std::ptrdiff_t o = layout.first(cells); o < layout.last(cells); o += lanes<Pack>) {
    const auto mean = mean_resting_faces<Dim, Pack>(geometry, o);
    Vec<RestingFace<Dim, T>, Dim> seeded;
    for (int e = 0; e < Dim; ++e) {
      for (int c = 0; c < Dim; ++c) seeded[e].normal[c] = T::seed(mean[e].normal[c], e * face_values + c);
      seeded[e].moment = T::seed(mean[e].moment, e * face_values + Dim);
    }
    const auto faces = moved(seeded, moving);
    const auto radii = scaled_radii(spectral_radii<Dim, T, T>(lifted<T>(load_state<Dim, Pack>(with.state, o)),
                                                              T(Load<Pack>::from(with.state.p.data() + o)),
                                                              faces.normals, faces.sweeps, gamma));
    Vec<Pack, Dim> multipliers;
    for (int d = 0; d < Dim; ++d) multipliers[d] = 0.5 * Load<Pack>::from(with.radius[d].data() + o);
    const auto sums = contracted<Dim, seeds>(radii, multipliers);
    for (int e = 0; e < Dim; ++e)
      for (const std::ptrdiff_t at : {o, o + layout.strides[e]}) {
        const auto* const of_face = sums.data() + e * face_values;
        for (int c = 0; c < Dim; ++c) add(of_face[c], sensitivity.normal[e][c], at);
        add(of_face[Dim], sensitivity.moment[e], at);
      }
  }
}

template <int Dim>
RestingFace<Dim, Dual<double, Dim + 1>> seeded_face(const BlockGeometry<Dim>& geometry, int d,
                                                    std::ptrdiff_t o) {
  using D = Dual<double, Dim + 1>;
  const auto face = resting_face<Dim, double>(geometry, d, o);
  RestingFace<Dim, D> seeded;
  for (int c = 0; c < Dim; ++c) seeded.normal[c] = D::seed(face.normal[c], c);
  seeded.moment = D::seed(face.moment, Dim);
  return seeded;
}

template <int Dim>
RigidMotion<Dual<double, Dim + 1>> lifted(const RigidMotion<double>& m) {
  return {m.cosine, m.sine, m.pitch_rate, m.plunge_rate};
}

template <int Dim>
void add_to_face(const Vec<double, Dim + 1>& values, int d, std::ptrdiff_t o,
                 BlockGeometry<Dim>& sensitivity) {
  const auto at = static_cast<std::size_t>(o);
  for (int c = 0; c < Dim; ++c) sensitivity.normal[d][c][at] += values[c];
  sensitivity.moment[d][at] += values[Dim];
}

template <int Dim>
void contract_boundary(const FlowBlock<Dim>& block, const RigidMotion<double>& motion,
                       const Freestream<Dim, double>& stream, std::span<const double> multipliers,
                       const BlockState<Dim, double>& state, BlockGeometry<Dim>& sensitivity) {
  constexpr int n = state_size<Dim>;
  using D = Dual<double, Dim + 1>;
  const Freestream<Dim, D> freestream{stream.gamma, stream.mach, stream.angle_cosine, stream.angle_sine};
  for (const BoundaryFace& boundary : block.boundary) {
    const auto face =
        moved(seeded_face<Dim>(block.geometry, boundary.direction, boundary.face), lifted<Dim>(motion));
    const State<Dim, D> flux =
        boundary_flux<Dim, D>(boundary.type, lifted<D>(load_state<Dim, double>(state, boundary.first)),
                              D(state.p[static_cast<std::size_t>(boundary.first)]),
                              D(state.p[static_cast<std::size_t>(boundary.second)]),
                              {boundary.outward * face.normal, boundary.outward * face.sweep}, freestream);
    const auto row = static_cast<std::size_t>(block.number[static_cast<std::size_t>(boundary.first)]) * n;
    Vec<double, Dim + 1> sums;
    for (int v = 0; v < n; ++v) sums += multipliers[row + static_cast<std::size_t>(v)] * flux[v].gradient;
    add_to_face<Dim>(sums, boundary.direction, boundary.face, sensitivity);
  }
}

}  // namespace

template <int Dim>
void add_balance_sensitivity(const FlowBlock<Dim>& block, int owned_count,
                             const FlowModel<Dim, double>& model, std::span<const double> w,
                             std::span<const double> ghosts, const RigidMotion<double>& motion,
                             std::span<const double> multipliers, BlockGeometry<Dim>& sensitivity) {
  const auto& freestream = model.freestream;
  Contraction<Dim> with{BlockState<Dim, double>(block.geometry.layout, freestream.state()), {}};
  for (auto& values : with.radius) values.assign(block.geometry.layout.size, 0.0);
  load_block<Dim, double>(block, owned_count, w, ghosts, freestream.gamma, with.state);
  set_face_multipliers<Dim>(block, multipliers, with.state.flux);
  std::visit(
      [&]<class SchemeType>(const SchemeType& scheme) {
        if constexpr (SchemeType::uses_radii)
          load_radii<Dim, double>(block, motion, freestream.gamma, with.state);
        for (int d = 0; d < Dim; ++d)
          contract_fluxes<Dim>(block.geometry, motion, d, freestream, scheme, with, sensitivity);
        if constexpr (SchemeType::uses_radii)
          contract_radii<Dim>(block.geometry, motion, freestream.gamma, with, sensitivity);
      },
      model.scheme);
  contract_boundary<Dim>(block, motion, freestream, multipliers, with.state, sensitivity);
}

template <int Dim>
void add_load_sensitivity(const BlockGeometry<Dim>& geometry, const BoundaryFace& face,
                          const RigidMotion<double>& motion, double push, const Loads<double>& weights,
                          BlockGeometry<Dim>& sensitivity) {
  using D = Dual<double, Dim + 1>;
  Loads<D> loads;
  add_wall_load<Dim, D>(seeded_face<Dim>(geometry, face.direction, face.face), lifted<Dim>(motion), D(push),
                        loads);
  const Vec<double, Dim + 1> sums = weights.force_x * loads.force_x.gradient +
                                    weights.force_y * loads.force_y.gradient +
                                    weights.moment * loads.moment.gradient;
  add_to_face<Dim>(sums, face.direction, face.face, sensitivity);
}

template void add_balance_sensitivity<2>(const FlowBlock<2>&, int, const FlowModel<2, double>&,
                                         std::span<const double>, std::span<const double>,
                                         const RigidMotion<double>&, std::span<const double>,
                                         BlockGeometry<2>&);
template void add_balance_sensitivity<3>(const FlowBlock<3>&, int, const FlowModel<3, double>&,
                                         std::span<const double>, std::span<const double>,
                                         const RigidMotion<double>&, std::span<const double>,
                                         BlockGeometry<3>&);
template void add_load_sensitivity<2>(const BlockGeometry<2>&, const BoundaryFace&,
                                      const RigidMotion<double>&, double, const Loads<double>&,
                                      BlockGeometry<2>&);
template void add_load_sensitivity<3>(const BlockGeometry<3>&, const BoundaryFace&,
                                      const RigidMotion<double>&, double, const Loads<double>&,
                                      BlockGeometry<3>&);

}  // namespace wingbeat
