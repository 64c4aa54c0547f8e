#include "flow/spectral_radius.hpp"

#include "flow/cell_quantities.hpp"
#include "flow/moved_face.hpp"

namespace wingbeat {

template <int Dim>
std::vector<double> spectral_radius_sums(const FlowDomain<Dim>& domain, std::span<const double> w,
                                         const MotionState& motion, double gamma) {
  constexpr int n = state_size<Dim>;
  const RigidMotion<double> moved = rigid_motion(motion);
  std::vector<double> sums;
  sums.reserve(static_cast<std::size_t>(domain.owned_count()));
  for (const FlowBlock<Dim>& block : domain.blocks())
    for_each(box_of<Dim>(block.geometry.layout.extents), [&](const Index<Dim>& index) {
      State<Dim, double> cell;
      for (int v = 0; v < n; ++v) cell[v] = w[sums.size() * n + static_cast<std::size_t>(v)];
      const auto faces = mean_faces<Dim, double>(block.geometry, moved, block.geometry.layout.offset(index));
      const auto radii = spectral_radii<Dim, double, double>(cell, pressure<Dim, double>(cell, gamma),
                                                             faces.normals, faces.sweeps, gamma);
      double sum = 0.0;
      for (int d = 0; d < Dim; ++d) sum += radii[d];
      sums.push_back(sum);
    });
  return sums;
}

template std::vector<double> spectral_radius_sums<2>(const FlowDomain<2>&, std::span<const double>,
                                                     const MotionState&, double);
template std::vector<double> spectral_radius_sums<3>(const FlowDomain<3>&, std::span<const double>,
                                                     const MotionState&, double);

}  // namespace wingbeat
