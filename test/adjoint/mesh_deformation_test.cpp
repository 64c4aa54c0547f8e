#include "adjoint/mesh_deformation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/hicks_henne.hpp"
#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/cut_blocks.hpp"
#include "core/mesh/find_interfaces.hpp"
#include "core/mesh/mesh_check.hpp"
#include "partition/local_nodes.hpp"
#include "test/adjoint/section_meshes.hpp"
#include "test/core/mesh/example_meshes.hpp"
#include "test/core/mesh/message.hpp"
#include "test/partition/lattice_mesh.hpp"
#include "test/partition/lattice_partition.hpp"

namespace wingbeat {
namespace {

using Vectors = std::vector<Vec<double, 2>>;

constexpr std::array both_methods{DeformationMethod::inverse_distance, DeformationMethod::grid_lines};

const SectionMesh& section() {
  static const SectionMesh mesh("naca2412", 64, 24);
  return mesh;
}

MeshDeformation deformation_of(const SectionMesh& m, DeformationMethod method) {
  return {m.mesh, m.numbers, m.wall, method};
}

TEST(MeshDeformation, WallMovesAsToldAndTheFarFieldNotAtAll) {
  Scatter scatter;
  const Vectors wall = scatter.vectors(section().wall.size());
  for (const auto method : both_methods) {
    const MeshDeformation deformation = deformation_of(section(), method);
    EXPECT_EQ(deformation.displacement(wall, section().wall.nodes), wall);
    std::vector<int> outer;
    for (int i = 0; i < 64; ++i) outer.push_back(section().numbers.zones[0]({i, 24}));
    EXPECT_EQ(deformation.displacement(wall, outer), Vectors(outer.size()));
  }
}

TEST(MeshDeformation, IsLinear) {
  Scatter scatter;
  const std::size_t size = section().wall.size();
  const Vectors a = scatter.vectors(size), b = scatter.vectors(size);
  Vectors sum;
  for (std::size_t w = 0; w < size; ++w) sum.push_back(2.0 * a[w] - 3.0 * b[w]);
  const std::vector<int> all = section().all_nodes();
  for (const auto method : both_methods) {
    const MeshDeformation deformation = deformation_of(section(), method);
    const Vectors of_a = deformation.displacement(a, all), of_b = deformation.displacement(b, all);
    const Vectors of_sum = deformation.displacement(sum, all);
    for (const int node : all) EXPECT_LT(norm(of_sum[node] - (2.0 * of_a[node] - 3.0 * of_b[node])), 1e-14);
  }
}

// A wall that moves as one takes every node along its own way, by a share that depends on the node only.
TEST(MeshDeformation, TranslationOfTheWallMovesNodesTheSameWayAndNoFarther) {
  const std::size_t size = section().wall.size();
  const std::vector<int> all = section().all_nodes();
  for (const auto method : both_methods) {
    const MeshDeformation deformation = deformation_of(section(), method);
    const Vectors right = deformation.displacement(Vectors(size, {{{1.0, 0.0}}}), all);
    const Vectors up = deformation.displacement(Vectors(size, {{{0.0, 1.0}}}), all);
    for (const int node : all) {
      EXPECT_EQ(right[node][1], 0.0);
      EXPECT_EQ(right[node][0], up[node][1]);
      EXPECT_GE(right[node][0], 0.0);
      EXPECT_LE(right[node][0], 1.0 + 1e-14);
    }
    for (int i = 0; i < 64; ++i)
      for (int j = 1; j <= 24; ++j)
        EXPECT_LE(right[section().numbers.zones[0]({i, j})][0],
                  right[section().numbers.zones[0]({i, j - 1})][0] + 1e-12);
  }
}

TEST(MeshDeformation, SensitivityIsTheTranspose) {
  Scatter scatter;
  const Vectors wall = scatter.vectors(section().wall.size());
  const std::vector<int> all = section().all_nodes();
  std::vector<int> some;
  for (const int node : all)
    if (node % 3 == 1) some.push_back(node);
  for (const auto method : both_methods)
    for (const auto& nodes : {all, some, std::vector<int>{}}) {
      const MeshDeformation deformation = deformation_of(section(), method);
      const Vectors sensitivities = scatter.vectors(nodes.size());
      const Vectors before = scatter.vectors(wall.size());
      Vectors after = before;
      deformation.add_wall_sensitivity(sensitivities, nodes, after);
      const double transposed = inner(wall, after) - inner(wall, before);
      const double direct = inner(sensitivities, deformation.displacement(wall, nodes));
      EXPECT_NEAR(transposed, direct, 1e-13 * std::max(10.0, std::abs(direct)));
    }
}

TEST(MeshDeformation, ANodeMovesTheSameWhoeverAsks) {
  Scatter scatter;
  const Vectors wall = scatter.vectors(section().wall.size());
  const std::vector<int> all = section().all_nodes();
  for (const auto method : both_methods) {
    const MeshDeformation deformation = deformation_of(section(), method);
    const Vectors together = deformation.displacement(wall, all);
    for (const int node : all)
      EXPECT_EQ(deformation.displacement(wall, std::vector{node}).front(), together[node]);
  }
}

// Halo nodes included: what a rank's blocks see of the deformed mesh is what their owners have.
TEST(MeshDeformation, RanksMoveSharedNodesAlike) {
  Scatter scatter;
  const Vectors wall = scatter.vectors(section().wall.size());
  const Partition<2> partition = random_partition(section().mesh, 3, 5);
  for (const auto method : both_methods) {
    const MeshDeformation deformation = deformation_of(section(), method);
    const Vectors whole = deformation.displacement(wall, section().all_nodes());
    for (int rank = 0; rank < 3; ++rank) {
      const LocalMesh<2> local = build_local_mesh(section().mesh, partition, rank);
      const LocalNodes<2> nodes = build_local_nodes(section().mesh, section().numbers, local);
      const Vectors own = deformation.displacement(wall, nodes.numbers);
      for (std::size_t n = 0; n < own.size(); ++n) EXPECT_EQ(own[n], whole[nodes.numbers[n]]);
    }
  }
}

// Positions sorted, since blocks number the nodes in another order.
std::vector<std::array<double, 2>> places(const MultiblockMesh<2>& mesh) {
  std::vector<std::array<double, 2>> all;
  for (const auto& x : unique_positions(mesh, number_nodes(mesh))) all.push_back(x.components);
  std::ranges::sort(all);
  return all;
}

TEST(MeshDeformation, DeformedMeshIsTheSameBitForBitOnAnyNumberOfRanksAndBlocks) {
  Scatter scatter;
  const std::vector<double> amplitudes = scatter.numbers(24);
  const auto outcome = [&](const Comm& comm, const SectionMesh& m, DeformationMethod method) {
    Vectors wall = HicksHenne(m.wall, {}).displacement(amplitudes);
    for (auto& d : wall) d *= 0.002;
    return deformed(comm, m.mesh, m.numbers, deformation_of(m, method), wall);
  };
  const SectionMesh in_blocks("naca2412", 64, 24, 5);
  const SectionMesh file(mesh_of_file("naca0012_128x32.x")), cut_file(cut_blocks(file.mesh, 7));
  for (const auto method : both_methods) {
    const MultiblockMesh<2> alone = outcome(Comm(MPI_COMM_SELF), section(), method);
    EXPECT_TRUE(example::same(outcome(Comm(), section(), method), alone));
    EXPECT_EQ(places(outcome(Comm(), in_blocks, method)), places(alone));
    EXPECT_EQ(places(outcome(Comm(), cut_file, method)), places(outcome(Comm(MPI_COMM_SELF), file, method)));
    EXPECT_NE(places(alone), places(section().mesh));
    EXPECT_TRUE(mesh_faults(alone).empty()) << mesh_faults(alone).front();
  }
}

// The same mesh with its zones, and so its nodes, in the opposite order.
MultiblockMesh<2> with_zones_reversed(MultiblockMesh<2> mesh) {
  std::ranges::reverse(mesh.zones);
  for (Zone<2>& zone : mesh.zones)
    for (Interface<2>& join : zone.interfaces)
      join.donor = static_cast<int>(mesh.zones.size()) - 1 - join.donor;
  return mesh;
}

// Where each node is and how far it moves, in the order of places.
std::vector<std::array<double, 4>> moves(const SectionMesh& m, DeformationMethod method,
                                         const Vectors& wall) {
  const Vectors positions = unique_positions(m.mesh, m.numbers);
  const Vectors moved = deformation_of(m, method).displacement(wall, m.all_nodes());
  std::vector<std::array<double, 4>> all;
  for (std::size_t n = 0; n < moved.size(); ++n)
    all.push_back({positions[n][0], positions[n][1], moved[n][0], moved[n][1]});
  std::ranges::sort(all);
  return all;
}

// Displacements of the size of the section: nothing is lost when they are added to positions.
TEST(MeshDeformation, DisplacementsAreTheSameBitForBitInAnyOrderOfZones) {
  Scatter scatter;
  const Vectors wall = scatter.vectors(section().wall.size());
  const SectionMesh in_blocks("naca2412", 64, 24, 7), reversed(with_zones_reversed(in_blocks.mesh));
  for (const auto method : both_methods) {
    EXPECT_EQ(moves(in_blocks, method, wall), moves(section(), method, wall));
    EXPECT_EQ(moves(reversed, method, wall), moves(section(), method, wall));
  }
}

TEST(MeshDeformation, NoDisplacementLeavesTheMesh) {
  for (const auto method : both_methods) {
    const MeshDeformation deformation = deformation_of(section(), method);
    const Vectors rest(section().wall.size());
    EXPECT_TRUE(example::same(deformed(Comm(), section().mesh, section().numbers, deformation, rest),
                              section().mesh));
  }
}

TEST(MeshDeformation, GridLinesPassThroughZonesOfAnyOrientation) {
  const LatticeMesh<2> lattice = turned_ring();
  const SectionMesh m(lattice.mesh());
  Scatter scatter;
  const Vectors wall = scatter.vectors(m.wall.size());
  const MeshDeformation deformation = deformation_of(m, DeformationMethod::grid_lines);
  const Vectors moved = deformation.displacement(wall, m.all_nodes());
  for (std::size_t z = 0; z < m.mesh.zones.size(); ++z)
    for_each(m.numbers.zones[z].interior(), [&](const Index<2>& node) {
      const Index<2> place = lattice.lattice_node(static_cast<int>(z), node);
      const Vec<double, 2>& here = moved[m.numbers.zones[z](node)];
      const Vec<double, 2>& there = wall[place[0] % 20];
      EXPECT_NEAR(here[0] * there[1], here[1] * there[0], 1e-15) << "not along that of its line's wall node";
      if (place[1] == 9) {
        EXPECT_EQ(norm(here), 0.0);
      } else {
        EXPECT_GT(dot(here, there), 0.0);
      }
    });
}

TEST(MeshDeformation, GridLinesRefuseOtherMeshesAndNameTheWayOut) {
  MultiblockMesh<2> bare = example::bare_c_mesh();  // left-handed
  for (Vec<double, 2>& x : std::span(bare.zones[0].nodes.data(), bare.zones[0].nodes.size())) x[1] = -x[1];
  const SectionMesh c_mesh(guess_boundaries(find_interfaces(bare, "c-mesh"), "c-mesh"));
  const std::string message =
      example::message_of([&] { deformation_of(c_mesh, DeformationMethod::grid_lines); });
  example::expect_contains(message, "nodes lie on no line from the wall");
  example::expect_contains(message, "set design.deformation = \"inverse_distance\"");
  Scatter scatter;
  const MeshDeformation other = deformation_of(c_mesh, DeformationMethod::inverse_distance);
  const Vectors wall = scatter.vectors(c_mesh.wall.size());
  EXPECT_EQ(other.displacement(wall, c_mesh.wall.nodes), wall);
}

TEST(MeshDeformation, RefusesWhatDoesNotFit) {
  for (const auto method : both_methods) {
    const MeshDeformation deformation = deformation_of(section(), method);
    Vectors wall(section().wall.size()), short_wall(3);
    const std::vector<int> nodes{1, 2};
    EXPECT_THROW(deformation.displacement(short_wall, nodes), InternalError);
    EXPECT_THROW(deformation.add_wall_sensitivity(short_wall, nodes, wall), InternalError);
    EXPECT_THROW(deformation.add_wall_sensitivity(Vectors(2), nodes, short_wall), InternalError);
  }
}

}  // namespace
}  // namespace wingbeat
