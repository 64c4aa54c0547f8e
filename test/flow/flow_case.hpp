#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "core/mesh/conformal_omesh.hpp"
#include "core/mesh/cut_blocks.hpp"
#include "core/parallel/comm.hpp"
#include "flow/flow_equations.hpp"
#include "partition/local_mesh.hpp"

namespace wingbeat::testing {

// A small flow problem, on the world communicator unless another is given.
template <int Dim>
struct FlowCase {
  Comm comm;
  MultiblockMesh<Dim> mesh;
  LocalMesh<Dim> local;
  FlowDomain<Dim> domain;
  FlowModel<Dim, double> model;

  FlowCase(MultiblockMesh<Dim> m, double mach, double angle_deg, double smoothing = 1.0,
           const Comm& ranks = Comm())
      : comm(ranks),
        mesh(std::move(m)),
        local(build_local_mesh<Dim>(mesh, partition_mesh<Dim>(mesh, comm.size(), {}), comm.rank())),
        domain(comm, local, {{{0.2, 0.0}}}),
        model{{1.4, mach, std::cos(angle_deg * std::numbers::pi / 180),
               std::sin(angle_deg * std::numbers::pi / 180)},
              JstScheme{0.25, 1.0 / 64.0, smoothing}} {}
};

inline MultiblockMesh<2> section_mesh(const std::string& name, int around, int normal, int blocks = 1,
                                      double farfield = 20.0) {
  OmeshOptions options;
  options.around = around;
  options.normal = normal;
  options.farfield_chords = farfield;
  options.blocks = blocks;
  return conformal_omesh(make_airfoil(name), options);
}

template <int Dim>
MultiblockMesh<Dim> with_all_boundaries(MultiblockMesh<Dim> mesh, BoundaryType type) {
  for (auto& zone : mesh.zones)
    for (auto& patch : zone.patches) patch.type = type;
  return mesh;
}

// The unit box of cells bent smoothly out of shape (in 3-D: every face warped), far field on every
// side. The displacement is periodic: opposite sides are bent alike and the volume remains 1.
template <int Dim>
MultiblockMesh<Dim> bent_box(const Index<Dim>& cells, double bend = 0.03) {
  Zone<Dim> zone;
  zone.name = "box";
  zone.cells = cells;
  Index<Dim> nodes = cells;
  for (int& count : nodes) ++count;
  zone.nodes = BlockArray<Vec<double, Dim>, Dim>(nodes, 0);
  for_each(box_of<Dim>(nodes), [&](const Index<Dim>& index) {
    Vec<double, Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = static_cast<double>(index[d]) / cells[d];
    Vec<double, Dim> displaced = x;
    for (int d = 0; d < Dim; ++d) {
      double wave = bend * (1.0 - 0.4 * d);
      for (int e = 0; e < Dim; ++e) wave *= std::sin(2 * std::numbers::pi * x[e] + 0.3 * e + 0.9 * d);
      displaced[d] += wave;
    }
    zone.nodes(index) = displaced;
  });
  for (int d = 0; d < Dim; ++d)
    for (int end : {0, 1}) {
      Box<Dim> layer = box_of<Dim>(cells);
      if (end == 0)
        layer.end[d] = 1;
      else
        layer.begin[d] = cells[d] - 1;
      zone.patches.push_back({"side", "", BoundaryType::farfield, {d, end}, layer});
    }
  MultiblockMesh<Dim> mesh;
  mesh.zones.push_back(std::move(zone));
  return mesh;
}

// Reproducible number in [-1, 1] for an entry, the same on any number of ranks.
inline double noise(long cell, int variable, int seed) {
  std::mt19937_64 generator(static_cast<std::uint64_t>(cell * 64 + variable) * 977 +
                            static_cast<std::uint64_t>(seed));
  generator.discard(3);
  return std::uniform_real_distribution<double>(-1.0, 1.0)(generator);
}

// [instance][owned cell][variable], from the cell's number in the whole mesh.
template <int Dim>
std::vector<double> noise_field(const FlowCase<Dim>& c, int instances, int seed) {
  std::vector<double> field;
  for (int i = 0; i < instances; ++i)
    for (long cell : c.local.global_cell)
      for (int v = 0; v < state_size<Dim>; ++v) field.push_back(noise(cell, v, seed + 1000 * i));
  return field;
}

// Uniform flow disturbed by a few percent in every entry.
template <int Dim>
std::vector<double> disturbed_state(const FlowCase<Dim>& c, const FlowEquations<Dim>& flow, double size,
                                    int seed) {
  std::vector<double> w = flow.uniform_state();
  const auto disturbance = noise_field(c, static_cast<int>(flow.instance_count()), seed);
  for (std::size_t i = 0; i < w.size(); ++i) w[i] += size * disturbance[i];
  return w;
}

inline double global_dot(const Comm& comm, std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return comm.sum(sum);
}
inline double global_norm(const Comm& comm, std::span<const double> a) {
  return std::sqrt(global_dot(comm, a, a));
}

}  // namespace wingbeat::testing
