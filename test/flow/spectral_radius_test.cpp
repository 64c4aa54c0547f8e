#include "flow/spectral_radius.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/partition/lattice_mesh.hpp"
#include "test/partition/lattice_partition.hpp"

namespace wingbeat {
namespace {

constexpr double gamma_of_air = 1.4;

// Of every cell: face areas and sweeps formed anew, without packs.
template <int Dim>
void expect_radii_of_the_definition(const LatticeMesh<Dim>& lattice) {
  constexpr int n = state_size<Dim>;
  const Comm comm;
  const auto local = build_local_mesh<Dim>(
      lattice.mesh(), random_partition<Dim>(lattice.mesh(), comm.size(), 7), comm.rank());
  const FlowDomain<Dim> domain(comm, local, {{{0.3, 0.1}}});
  const MotionState motion{0.05, 0.2, -0.3};
  const RigidMotion<double> moved = rigid_motion(motion);

  std::vector<double> w;
  for (int c = 0; c < domain.owned_count(); ++c) {
    const double wave = std::sin(0.7 * c);
    Vec<double, Dim> u;
    for (int d = 0; d < Dim; ++d) u[d] = 0.6 - 0.3 * d + 0.2 * wave;
    const auto state = conservative<Dim, double>(1.0 + 0.1 * wave, u, 1.0 - 0.2 * wave, gamma_of_air);
    for (int v = 0; v < n; ++v) w.push_back(state[v]);
  }
  const auto radii = directional_radii<Dim>(domain, w, motion, gamma_of_air);
  const auto sums = spectral_radius_sums<Dim>(domain, w, motion, gamma_of_air);
  ASSERT_EQ(radii.size(), w.size() / n * Dim);

  std::size_t c = 0;
  for (const auto& block : domain.blocks())
    for_each(box_of<Dim>(block.geometry.layout.extents), [&](const Index<Dim>& cell) {
      const auto& geometry = block.geometry;
      State<Dim, double> state;
      for (int v = 0; v < n; ++v) state[v] = w[c * n + static_cast<std::size_t>(v)];
      const double sound = std::sqrt(gamma_of_air * pressure<Dim, double>(state, gamma_of_air) / state[0]);
      double sum = 0.0;
      for (int d = 0; d < Dim; ++d) {
        const auto low = static_cast<std::size_t>(geometry.layout.offset(cell));
        const auto high = low + static_cast<std::size_t>(geometry.layout.strides[d]);
        Vec<double, Dim> normal;
        for (int e = 0; e < Dim; ++e)
          normal[e] = 0.5 * (geometry.normal[d][e][low] + geometry.normal[d][e][high]);
        normal = moved.turned(normal);
        const double sweep = moved.sweep(normal, 0.5 * (geometry.moment[d][low] + geometry.moment[d][high]));
        const double expected =
            std::abs(dot(velocity<Dim>(state), normal) - sweep) + sound * std::sqrt(dot(normal, normal));
        EXPECT_NEAR(radii[c * Dim + static_cast<std::size_t>(d)], expected, 1e-13 * expected);
        sum += expected;
      }
      EXPECT_NEAR(sums[c], sum, 1e-13 * sum);
      ++c;
    });
}

TEST(SpectralRadius, IsThatOfTheDefinitionInEveryCellAndDirection) {
  expect_radii_of_the_definition(single_ring(27, 5));  // rows of packs and of single cells
  expect_radii_of_the_definition(turned_ring());
  expect_radii_of_the_definition(turned_shell());
}

}  // namespace
}  // namespace wingbeat
