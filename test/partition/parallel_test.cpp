#include <gtest/gtest.h>

#include <random>

#include "core/io/error.hpp"
#include "partition/gather_field.hpp"
#include "partition/local_mesh.hpp"
#include "test/partition/lattice_mesh.hpp"
#include "test/partition/lattice_partition.hpp"

namespace wingbeat {
namespace {

constexpr int instances = 3, width = 4;

// A smooth function of the place of a cell, another for each instance and component. Whole
// numbers, so that it is the same to the last bit wherever it is evaluated.
template <int Dim>
double smooth(const Index<Dim>& place, int instance, int component) {
  int value = 10 * instance + component;
  for (int d = 0; d < Dim; ++d) value = 100 * value + place[d] + place[d] * place[d] / 2;
  return value;
}

template <int Dim>
struct RankPart {
  const LatticeMesh<Dim>& lattice;
  LocalMesh<Dim> local;
  std::vector<Index<Dim>> places;  // lattice cell of each owned cell

  RankPart(const LatticeMesh<Dim>& source, const Partition<Dim>& partition, int rank)
      : lattice(source), local(build_local_mesh(source.mesh(), partition, rank)) {
    for (const LocalBlock<Dim>& block : local.blocks)
      for_each(block.zone_cells,
               [&](const Index<Dim>& cell) { places.push_back(source.lattice_cell(block.zone, cell)); });
  }

  std::vector<double> smooth_field() const {
    std::vector<double> field;
    for (int n = 0; n < instances; ++n)
      for (const Index<Dim>& place : places)
        for (int v = 0; v < width; ++v) field.push_back(smooth<Dim>(place, n, v));
    return field;
  }
};

template <class F>
void for_all_meshes(const Comm& comm, F&& check) {
  const auto on = [&]<int Dim>(const LatticeMesh<Dim>& lattice) {
    check(RankPart<Dim>(lattice, partition_mesh(lattice.mesh(), comm.size(), {}), comm.rank()));
    check(RankPart<Dim>(lattice, random_partition(lattice.mesh(), comm.size(), 9), comm.rank()));
  };
  on(single_ring(24, 6));
  on(turned_ring());
  on(turned_box());
  on(turned_shell());
}

TEST(HaloExchange, BringsTheNeighboursValuesAcrossAnyOrientation) {
  const Comm comm;
  for_all_meshes(comm, [&]<int Dim>(const RankPart<Dim>& part) {
    const LocalMesh<Dim>& local = part.local;
    const GhostExchange exchange(comm, local.ghosts);
    const std::vector<double> owned = part.smooth_field();
    std::vector<double> ghosts(local.ghosts.size() * instances * width);
    exchange.gather<double>(owned, ghosts, instances, width);
    for (const LocalBlock<Dim>& block : local.blocks)
      for_each(grown(box_of<Dim>(block.extents), halo_layers), [&](const Index<Dim>& index) {
        const int number = block.cell_number(index);
        if (number < 0) return;
        Index<Dim> place = index;
        for (int d = 0; d < Dim; ++d) place[d] += block.zone_cells.begin[d];
        place = part.lattice.lattice_cell(block.zone, place);
        ASSERT_TRUE(part.lattice.wrap(place));
        const bool is_ghost = number >= local.owned_count;
        const std::vector<double>& values = is_ghost ? ghosts : owned;
        const std::size_t entries = is_ghost ? local.ghosts.size() : local.owned_count;
        const std::size_t entry = is_ghost ? number - local.owned_count : number;
        for (int n = 0; n < instances; ++n)
          for (int v = 0; v < width; ++v)
            ASSERT_EQ(values[(n * entries + entry) * width + v], smooth<Dim>(place, n, v));
      });
  });
}

// Whole numbers: both inner products are exact.
TEST(HaloExchange, TransposeIsExactAcrossAnyOrientation) {
  const Comm comm;
  for_all_meshes(comm, [&]<int Dim>(const RankPart<Dim>& part) {
    const GhostExchange exchange(comm, part.local.ghosts);
    std::mt19937 random(comm.rank());
    std::vector<double> x(part.local.owned_count * instances * width), transpose(x.size(), 0.0);
    std::vector<double> v(part.local.ghosts.size() * instances * width), gathered(v.size());
    for (double& value : x) value = static_cast<int>(random() % 201) - 100;
    for (double& value : v) value = static_cast<int>(random() % 201) - 100;
    exchange.gather<double>(x, gathered, instances, width);
    exchange.scatter_add<double>(v, transpose, instances, width);
    double ghost_side = 0.0, owner_side = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) ghost_side += v[i] * gathered[i];
    for (std::size_t i = 0; i < x.size(); ++i) owner_side += transpose[i] * x[i];
    EXPECT_EQ(comm.sum(ghost_side), comm.sum(owner_side));
    if (comm.size() > 1) {
      EXPECT_NE(comm.sum(ghost_side), 0.0);
    }
  });
}

// Zone by zone, each zone's first index fastest, whatever the number of ranks.
template <int Dim>
std::vector<double> whole_smooth_field(const LatticeMesh<Dim>& lattice) {
  std::vector<double> whole;
  for (int n = 0; n < instances; ++n)
    for (int z = 0; z < std::ssize(lattice.mesh().zones); ++z)
      for_each(box_of<Dim>(lattice.mesh().zones[z].cells), [&](const Index<Dim>& cell) {
        for (int v = 0; v < width; ++v) whole.push_back(smooth<Dim>(lattice.lattice_cell(z, cell), n, v));
      });
  return whole;
}

TEST(GatherField, GivesTheSameWholeFieldOnAnyNumberOfRanks) {
  const Comm comm;
  for_all_meshes(comm, [&]<int Dim>(const RankPart<Dim>& part) {
    const auto whole = gather_to_root(comm, part.local.global_cell, part.smooth_field(), instances, width);
    EXPECT_EQ(whole, comm.is_root() ? whole_smooth_field(part.lattice) : std::vector<double>{});
  });
}

TEST(GatherField, ScatterIsTheInverse) {
  const Comm comm;
  for_all_meshes(comm, [&]<int Dim>(const RankPart<Dim>& part) {
    const std::vector<double> whole =
        comm.is_root() ? whole_smooth_field(part.lattice) : std::vector<double>{};
    EXPECT_EQ(scatter_from_root(comm, part.local.global_cell, whole, instances, width), part.smooth_field());
  });
}

TEST(GatherField, RefusesFieldsAndNumbersThatDoNotFit) {
  const Comm comm(MPI_COMM_SELF);
  const std::vector<long> cells{1, 0}, repeated{1, 1}, outside{0, 2};
  const std::vector<double> field(2), short_field(1);
  EXPECT_NO_THROW(gather_to_root(comm, cells, field, 1, 1));
  EXPECT_THROW(gather_to_root(comm, cells, short_field, 1, 1), InternalError);
  EXPECT_THROW(gather_to_root(comm, repeated, field, 1, 1), InternalError);
  EXPECT_THROW(gather_to_root(comm, outside, field, 1, 1), InternalError);
  EXPECT_THROW(scatter_from_root(comm, cells, short_field, 1, 1), InternalError);
}

}  // namespace
}  // namespace wingbeat
