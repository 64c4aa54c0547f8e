#include "flow/spectral_radius.hpp"

#include <string>

#include "core/io/error.hpp"
#include "flow/cell_quantities.hpp"
#include "flow/moved_face.hpp"

namespace wingbeat {
namespace {

// Radii of lanes<T> consecutive cells of a row, the first at offset o and at w and radii.
template <int Dim, class T>
void cell_radii(const BlockGeometry<Dim>& geometry, const RigidMotion<T>& motion, double gamma,
                std::ptrdiff_t o, const double* w, double* radii) {
  constexpr int n = state_size<Dim>;
  State<Dim, T> cell;
  for (int v = 0; v < n; ++v) {
    if constexpr (lanes<T> == 1)
      cell[v] = w[v];
    else
      cell[v] = T([&](auto lane) { return w[static_cast<int>(lane) * n + v]; });
  }
  const auto faces = mean_faces<Dim, T>(geometry, motion, o);
  const auto lambda =
      spectral_radii<Dim, T, T>(cell, pressure<Dim, T>(cell, gamma), faces.normals, faces.sweeps, gamma);
  for (int d = 0; d < Dim; ++d) {
    if constexpr (lanes<T> == 1)
      radii[d] = lambda[d];
    else
      for (int lane = 0; lane < lanes<T>; ++lane) radii[lane * Dim + d] = lambda[d][lane];
  }
}

template <int Dim>
[[gnu::flatten]] void sweep_rows(const FlowBlock<Dim>& block, const RigidMotion<double>& motion, double gamma,
                                 const double* w, double* radii) {
  constexpr int n = state_size<Dim>;
  const RigidMotion<Pack> wide_motion = widen(motion);
  const auto& layout = block.geometry.layout;
  const int length = layout.extents[0];
  Box<Dim> rows = box_of<Dim>(layout.extents);
  rows.end[0] = 1;
  for_each(rows, [&](const Index<Dim>& row) {
    const std::ptrdiff_t o = layout.offset(row);
    int i = 0;
    for (; i + lanes<Pack> <= length; i += lanes<Pack>)
      cell_radii<Dim, Pack>(block.geometry, wide_motion, gamma, o + i, w + i * n, radii + i * Dim);
    for (; i < length; ++i)
      cell_radii<Dim, double>(block.geometry, motion, gamma, o + i, w + i * n, radii + i * Dim);
    w += length * n;
    radii += length * Dim;
  });
}

}  // namespace

template <int Dim>
std::vector<double> directional_radii(const FlowDomain<Dim>& domain, std::span<const double> w,
                                      const MotionState& motion, double gamma) {
  ensure(w.size() == domain.state_count(),
         "spectral radii need the states of every cell, not " + std::to_string(w.size()) + " values");
  const RigidMotion<double> moved = rigid_motion(motion);
  std::vector<double> radii(static_cast<std::size_t>(domain.owned_count()) * Dim);
  for (const FlowBlock<Dim>& block : domain.blocks()) {
    const auto first = static_cast<std::size_t>(block.first_cell);
    sweep_rows<Dim>(block, moved, gamma, w.data() + first * state_size<Dim>, radii.data() + first * Dim);
  }
  return radii;
}

template <int Dim>
std::vector<double> spectral_radius_sums(const FlowDomain<Dim>& domain, std::span<const double> w,
                                         const MotionState& motion, double gamma) {
  const std::vector<double> radii = directional_radii<Dim>(domain, w, motion, gamma);
  std::vector<double> sums(static_cast<std::size_t>(domain.owned_count()), 0.0);
  for (std::size_t c = 0; c < sums.size(); ++c)
    for (std::size_t d = 0; d < Dim; ++d) sums[c] += radii[c * Dim + d];
  return sums;
}

template std::vector<double> directional_radii<2>(const FlowDomain<2>&, std::span<const double>,
                                                  const MotionState&, double);
template std::vector<double> directional_radii<3>(const FlowDomain<3>&, std::span<const double>,
                                                  const MotionState&, double);
template std::vector<double> spectral_radius_sums<2>(const FlowDomain<2>&, std::span<const double>,
                                                     const MotionState&, double);
template std::vector<double> spectral_radius_sums<3>(const FlowDomain<3>&, std::span<const double>,
                                                     const MotionState&, double);

}  // namespace wingbeat
