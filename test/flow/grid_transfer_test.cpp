#include "flow/grid_transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "core/io/error.hpp"
#include "core/mesh/conformal_omesh.hpp"
#include "partition/coarsening.hpp"
#include "partition/gather_field.hpp"
#include "test/partition/doubled_lattice.hpp"

namespace wingbeat {
namespace {

// One mesh on this rank.
template <int Dim>
struct Grid {
  LocalMesh<Dim> local;
  FlowDomain<Dim> domain;

  Grid(const Comm& comm, const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition)
      : local(build_local_mesh(mesh, partition, comm.rank())), domain(comm, local, {{{0.0, 0.0}}}) {}

  std::size_t count() const { return static_cast<std::size_t>(local.owned_count); }
};

template <int Dim>
struct TwoGrids {
  Comm comm;
  CoarseGrid<Dim> coarsening;
  Grid<Dim> fine;
  Grid<Dim> coarse;
  GridTransfer<Dim> transfer;

  TwoGrids(const MultiblockMesh<Dim>& mesh, const Partition<Dim>& partition, const Comm& ranks = Comm())
      : comm(ranks),
        coarsening(coarsened(mesh, partition, 1).value()),
        fine(comm, mesh, partition),
        coarse(comm, coarsening.mesh, coarsening.partition),
        transfer(fine.domain, coarse.domain) {}
};

// f(lattice cell, instance, variable) at the owned cells.
template <int Dim, class F>
std::vector<double> field_on(const Grid<Dim>& grid, const LatticeMesh<Dim>& lattice, int instances, int width,
                             F&& f) {
  std::vector<double> field;
  for (int i = 0; i < instances; ++i)
    for (const auto& block : grid.local.blocks)
      for_each(block.zone_cells, [&](const Index<Dim>& cell) {
        for (int v = 0; v < width; ++v) field.push_back(f(lattice.lattice_cell(block.zone, cell), i, v));
      });
  return field;
}

// Whole numbers, so that sums and quarters of them are exact in any order.
template <int Dim>
double random_number(const LatticeMesh<Dim>& lattice, const Index<Dim>& cell, int instance, int variable) {
  std::minstd_rand generator(
      static_cast<unsigned>(1 + lattice.number(cell) + 1000 * instance + 7000 * variable));
  generator.discard(5);
  return static_cast<double>(generator() % 2001) - 1000.0;
}

template <int Dim, class F>
void on_any_division(const DoubledLattice<Dim>& lattice, F&& check) {
  const auto& coarse = lattice.coarse.mesh();
  const auto& fine = lattice.fine.mesh();
  const int ranks = Comm().size();
  check(lattice, TwoGrids<Dim>(fine, partition_mesh(fine, ranks, {.imbalance = 0.5, .granularity = 2})));
  for (const unsigned seed : {1u, 2u})
    check(lattice, TwoGrids<Dim>(fine, refined(random_partition(coarse, ranks, seed), coarse, fine)));
}
template <class F>
void on_all_lattices(F&& check) {
  on_any_division(doubled_ring(), check);
  on_any_division(doubled_shell(), check);
  on_any_division(doubled_box(), check);
}

constexpr int instances = 2;

template <int Dim>
Box<Dim> children(const Index<Dim>& coarse_cell) {
  Box<Dim> box{DoubledLattice<Dim>::doubled(coarse_cell), {}};
  for (int d = 0; d < Dim; ++d) box.end[d] = box.begin[d] + 2;
  return box;
}

TEST(GridTransfer, RestrictsSumsOnAnyDivisionOfZonesOfAnyOrientation) {
  on_all_lattices([]<int Dim>(const DoubledLattice<Dim>& lattice, const TwoGrids<Dim>& grids) {
    for (const int width : {1, Dim + 2, 7}) {
      const auto number = [&](const Index<Dim>& cell, int i, int v) {
        return random_number<Dim>(lattice.fine, cell, i, v);
      };
      const auto fine = field_on(grids.fine, lattice.fine, instances, width, number);
      std::vector<double> sums(grids.coarse.count() * instances * width, NAN);
      grids.transfer.restrict_sum(fine, sums, instances, width);
      EXPECT_EQ(sums, field_on(grids.coarse, lattice.coarse, instances, width,
                               [&](const Index<Dim>& coarse_cell, int i, int v) {
                                 double sum = 0.0;
                                 for_each(children<Dim>(coarse_cell),
                                          [&](const Index<Dim>& cell) { sum += number(cell, i, v); });
                                 return sum;
                               }));
    }
  });
}

// The mean times the volume of the fine cells is their sum of volume times state.
TEST(GridTransfer, RestrictsMeansByVolume) {
  on_all_lattices([]<int Dim>(const DoubledLattice<Dim>& lattice, const TwoGrids<Dim>& grids) {
    constexpr int n = Dim + 2;
    const auto fine = field_on(grids.fine, lattice.fine, 1, n, [&](const Index<Dim>& cell, int i, int v) {
      return 1e-3 * random_number<Dim>(lattice.fine, cell, i, v);
    });
    const auto volumes = grids.fine.domain.volumes();
    std::vector<double> contents(fine.size());
    for (std::size_t k = 0; k < fine.size(); ++k) contents[k] = volumes[k / n] * fine[k];
    std::vector<double> means(grids.coarse.count() * n), sums(means.size()), volume(grids.coarse.count());
    grids.transfer.restrict_mean(fine, means, 1);
    grids.transfer.restrict_sum(contents, sums, 1);
    grids.transfer.restrict_sum(volumes, volume, 1, 1);
    for (std::size_t k = 0; k < means.size(); ++k)
      EXPECT_NEAR(means[k], sums[k] / volume[k / n], 8 * (1 << Dim) * 1e-16);
  });
}

TEST(GridTransfer, ConstantsRemainToRoundOff) {
  on_all_lattices([]<int Dim>(const DoubledLattice<Dim>& lattice, const TwoGrids<Dim>& grids) {
    const auto constant = [](const Index<Dim>&, int i, int v) { return 0.7 + i + 0.1 * v; };
    const auto fine = field_on(grids.fine, lattice.fine, instances, Dim + 2, constant);
    const auto coarse = field_on(grids.coarse, lattice.coarse, instances, Dim + 2, constant);
    std::vector<double> means(coarse.size()), added(fine.size(), 0.0), interpolated(fine.size());
    grids.transfer.restrict_mean(fine, means, instances);
    grids.transfer.prolong_add(coarse, added, instances);
    grids.transfer.interpolate(coarse, interpolated, instances);
    // At most 2^(Dim+1) roundings: of the volumes' sum and quotient, the products and their sum. In a
    // prolongation the differences are exactly zero.
    for (std::size_t k = 0; k < means.size(); ++k)
      EXPECT_NEAR(means[k], coarse[k], (1 << Dim) * 2.3e-16 * coarse[k]);
    EXPECT_EQ(added, fine);
    EXPECT_EQ(interpolated, fine);
  });
}

// What a fine cell receives, on the lattice alone.
template <int Dim>
double prolonged(const DoubledLattice<Dim>& lattice, const Index<Dim>& fine_cell, int i, int v, bool linear) {
  const Index<Dim> cell = lattice.halved(fine_cell);
  const double own = random_number<Dim>(lattice.coarse, cell, i, v);
  double value = own;
  for (int d = 0; d < Dim; ++d) {
    const int step = fine_cell[d] % 2 == 0 ? -1 : 1;
    Index<Dim> next = cell, opposite = cell;
    next[d] += step;
    opposite[d] -= step;
    if (lattice.coarse.wrap(next))
      value += 0.25 * (random_number<Dim>(lattice.coarse, next, i, v) - own);
    else if (linear && lattice.coarse.wrap(opposite))
      value -= 0.25 * (random_number<Dim>(lattice.coarse, opposite, i, v) - own);
  }
  return value;
}

TEST(GridTransfer, ProlongsFromTheNeighboursAcrossAnyDivision) {
  on_all_lattices([]<int Dim>(const DoubledLattice<Dim>& lattice, const TwoGrids<Dim>& grids) {
    for (const int width : {1, Dim + 2}) {
      const auto coarse =
          field_on(grids.coarse, lattice.coarse, instances, width, [&](const Index<Dim>& cell, int i, int v) {
            return random_number<Dim>(lattice.coarse, cell, i, v);
          });
      std::vector<double> fine(grids.fine.count() * instances * width, 8.0);
      grids.transfer.prolong_add(coarse, fine, instances, width);
      EXPECT_EQ(fine, field_on(grids.fine, lattice.fine, instances, width,
                               [&](const Index<Dim>& cell, int i, int v) {
                                 return 8.0 + prolonged<Dim>(lattice, cell, i, v, false);
                               }));
      grids.transfer.interpolate(coarse, fine, instances, width);
      EXPECT_EQ(fine, field_on(grids.fine, lattice.fine, instances, width,
                               [&](const Index<Dim>& cell, int i, int v) {
                                 return prolonged<Dim>(lattice, cell, i, v, true);
                               }));
    }
  });
}

// Each coarse value is handed out 2^Dim times in all: what one fine cell takes from a neighbour, one
// across the face gives.
TEST(GridTransfer, ProlongationConservesSums) {
  on_all_lattices([]<int Dim>(const DoubledLattice<Dim>& lattice, const TwoGrids<Dim>& grids) {
    const auto coarse = field_on(
        grids.coarse, lattice.coarse, 1, 1,
        [&](const Index<Dim>& cell, int i, int v) { return random_number<Dim>(lattice.coarse, cell, i, v); });
    std::vector<double> fine(grids.fine.count(), 0.0);
    grids.transfer.prolong_add(coarse, fine, 1, 1);
    double fine_sum = 0.0, coarse_sum = 0.0;
    for (const double value : fine) fine_sum += value;
    for (const double value : coarse) coarse_sum += value;
    EXPECT_EQ(grids.comm.sum(fine_sum), (1 << Dim) * grids.comm.sum(coarse_sum));
  });
}

// Linear in the place of the cell centres, in units of a fine cell: whole numbers, hence exact.
template <int Dim>
double linear(const Index<Dim>& cell, int cells, int v) {
  double value = 3.0 + v;
  for (int d = 0; d < Dim; ++d) value += (5.0 - 3.0 * d) * (2.0 * cells * cell[d] + cells);
  return value;
}

template <int Dim>
void expect_linear_fields_exact(const DoubledLattice<Dim>& lattice, const TwoGrids<Dim>& grids) {
  const auto coarse =
      field_on(grids.coarse, lattice.coarse, instances, 3,
               [](const Index<Dim>& cell, int i, int v) { return linear<Dim>(cell, 2, v + 10 * i); });
  const auto exact =
      field_on(grids.fine, lattice.fine, instances, 3,
               [](const Index<Dim>& cell, int i, int v) { return linear<Dim>(cell, 1, v + 10 * i); });
  std::vector<double> fine(exact.size());
  grids.transfer.interpolate(coarse, fine, instances, 3);
  EXPECT_EQ(fine, exact);

  // Corrections, too, but for the fine cells at a boundary.
  std::fill(fine.begin(), fine.end(), 0.0);
  grids.transfer.prolong_add(coarse, fine, instances, 3);
  const auto inner = field_on(grids.fine, lattice.fine, instances, 3, [&](const Index<Dim>& cell, int, int) {
    for (int d = 0; d < Dim; ++d)
      if (cell[d] == 0 || cell[d] == lattice.fine.cells()[d] - 1) return 0.0;
    return 1.0;
  });
  for (std::size_t k = 0; k < fine.size(); ++k) {
    if (inner[k] == 1.0) {
      EXPECT_EQ(fine[k], exact[k]);
    }
  }

  std::vector<double> sums(coarse.size());
  grids.transfer.restrict_sum(exact, sums, instances, 3);
  for (double& sum : sums) sum /= 1 << Dim;
  EXPECT_EQ(sums, coarse);
}

TEST(GridTransfer, LinearFieldsAreExact) {
  on_any_division(doubled_box(), expect_linear_fields_exact<3>);
  on_any_division(
      DoubledLattice<2>({9, 6}, false,
                        {{{{0, 0}, {4, 6}}, {{0, 1}, {1, 1}}}, {{{4, 0}, {9, 6}}, {{1, 0}, {1, -1}}}}),
      expect_linear_fields_exact<2>);
}

// A mesh one cell thick is carried over as the plane that it is.
TEST(GridTransfer, ADirectionOfASingleCellIsNotCoarsened) {
  const auto lattice = [](const Index<3>& cells) {
    return LatticeMesh<3>(cells, false, {{box_of<3>(cells), {{0, 1, 2}, {1, 1, 1}}}});
  };
  const LatticeMesh<3> fine = lattice({16, 8, 1}), coarse = lattice({8, 4, 1});
  const TwoGrids<3> grids(fine.mesh(), partition_mesh(fine.mesh(), Comm().size(), {.granularity = 2}));
  const auto plane = [](int size) {
    return [size](const Index<3>& cell, int, int) { return size * (3.0 * cell[0] - cell[1] + 1.0); };
  };
  const auto exact = field_on(grids.fine, fine, 1, 1, plane(1));
  const auto on_coarse = field_on(grids.coarse, coarse, 1, 1, plane(2));
  std::vector<double> interpolated(exact.size()), sums(on_coarse.size());
  grids.transfer.interpolate(on_coarse, interpolated, 1, 1);
  EXPECT_EQ(interpolated, exact);
  grids.transfer.restrict_sum(exact, sums, 1, 1);
  for (double& sum : sums) sum /= 4.0;
  EXPECT_EQ(sums, on_coarse);
}

// The same numbers to the last bit on the ranks there are as on one alone.
TEST(GridTransfer, DoesNotDependOnTheRanks) {
  const MultiblockMesh<2> mesh =
      conformal_omesh(make_airfoil("naca2412"), {.around = 64, .normal = 16, .farfield_chords = 20.0});
  const auto field = [](long cell, int v) { return std::sin(0.37 * static_cast<double>(cell) + v); };
  const auto transferred = [&](const Comm& comm) {
    const TwoGrids<2> grids(mesh, partition_mesh(mesh, comm.size(), {.granularity = 2}), comm);
    std::vector<double> fine, means(grids.coarse.count() * 4);
    for (const long cell : grids.fine.local.global_cell)
      for (int v = 0; v < 4; ++v) fine.push_back(field(cell, v));
    grids.transfer.restrict_mean(fine, means, 1);
    grids.transfer.prolong_add(means, fine, 1);
    return gather_to_root(comm, grids.fine.local.global_cell, fine, 1, 4);
  };
  const auto together = transferred(Comm());
  if (Comm().is_root()) {
    EXPECT_EQ(together, transferred(Comm(MPI_COMM_SELF)));
  }
}

// Area vectors of a coarse face's halves add up to its own: free stream preservation carries over.
TEST(GridTransfer, CoarseFacesAreTheSumsOfFineOnes) {
  on_any_division(doubled_ring(), [](const DoubledLattice<2>&, const TwoGrids<2>& grids) {
    for (std::size_t b = 0; b < grids.fine.domain.blocks().size(); ++b) {
      const auto& fine = grids.fine.domain.blocks()[b].geometry;
      const auto& coarse = grids.coarse.domain.blocks()[b].geometry;
      for (int d = 0; d < 2; ++d) {
        Box<2> faces = box_of<2>(coarse.layout.extents);
        ++faces.end[d];
        for_each(faces, [&](const Index<2>& face) {
          const auto first = fine.layout.offset(DoubledLattice<2>::doubled(face));
          for (int c = 0; c < 2; ++c)
            EXPECT_NEAR(coarse.normal[d][c][coarse.layout.offset(face)],
                        fine.normal[d][c][first] + fine.normal[d][c][first + fine.layout.strides[1 - d]],
                        1e-14);  // differences of coordinates up to 5
        });
      }
    }
  });
}

TEST(GridTransfer, RefusesFieldsAndMeshesThatDoNotFit) {
  const auto lattice = doubled_ring();
  const Comm self(MPI_COMM_SELF);
  const auto& mesh = lattice.fine.mesh();
  const TwoGrids<2> grids(mesh, partition_mesh(mesh, 1, {}), self);
  std::vector<double> fine(grids.fine.count() * 4), coarse(grids.coarse.count() * 4);
  EXPECT_NO_THROW(grids.transfer.restrict_sum(fine, coarse, 1));
  EXPECT_THROW(grids.transfer.restrict_sum(coarse, coarse, 1), InternalError);
  EXPECT_THROW(grids.transfer.prolong_add(coarse, fine, 2), InternalError);
  EXPECT_THROW(grids.transfer.interpolate(coarse, fine, 1, 0), InternalError);
  EXPECT_THROW(GridTransfer<2>(grids.coarse.domain, grids.fine.domain), InternalError);
}

}  // namespace
}  // namespace wingbeat
