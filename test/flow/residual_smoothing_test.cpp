#include "flow/residual_smoothing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "test/partition/lattice_mesh.hpp"
#include "test/partition/lattice_partition.hpp"

namespace wingbeat {
namespace {

constexpr double spike_cut = 1e-6;

// Zones in a row, every other one reversed, in which directions bear the same index: their lines
// go on.
LatticeMesh<2> ring_of_four() {
  return {{72, 14},
          true,
          {{{{0, 0}, {18, 14}}, {{0, 1}, {1, 1}}},
           {{{18, 0}, {36, 14}}, {{0, 1}, {-1, -1}}},
           {{{36, 0}, {54, 14}}, {{0, 1}, {1, 1}}},
           {{{54, 0}, {72, 14}}, {{0, 1}, {-1, -1}}}}};
}
LatticeMesh<3> single_box() {
  return {{24, 22, 5}, false, {{{{0, 0, 0}, {24, 22, 5}}, {{0, 1, 2}, {1, 1, 1}}}}};
}

// A lattice of which this rank has a part.
template <int Dim>
struct SmoothingCase {
  static constexpr int n = state_size<Dim>;
  Comm comm;
  LatticeMesh<Dim> lattice;
  Partition<Dim> partition;
  LocalMesh<Dim> local;
  FlowDomain<Dim> domain;
  ResidualSmoothing<Dim> smoothing;
  std::vector<Index<Dim>> cells;  // of the lattice, [owned cell]

  SmoothingCase(LatticeMesh<Dim> l, Partition<Dim> p)
      : lattice(std::move(l)),
        partition(std::move(p)),
        local(build_local_mesh<Dim>(lattice.mesh(), partition, comm.rank())),
        domain(comm, local, {}),
        smoothing(domain) {
    for (const auto& block : local.blocks)
      for_each(block.zone_cells,
               [&](const Index<Dim>& cell) { cells.push_back(lattice.lattice_cell(block.zone, cell)); });
  }
  explicit SmoothingCase(const LatticeMesh<Dim>& l)
      : SmoothingCase(l, partition_mesh<Dim>(l.mesh(), Comm().size(), {})) {}

  // values(lattice cell, variable, instance) of the owned cells.
  template <class F>
  std::vector<double> field(int variables, int instances, F&& values) const {
    std::vector<double> result;
    for (int i = 0; i < instances; ++i)
      for (const auto& cell : cells)
        for (int v = 0; v < variables; ++v) result.push_back(values(cell, v, i));
    return result;
  }
  std::vector<double> smoothed(std::vector<double> r, int instances = 1) const {
    smoothing.apply(r, instances);
    return r;
  }
  // Fewest cells between two ends at which a line goes on. A line of a single box ends at its sides.
  int shortest_crossing(bool closed) const {
    int shortest = 1 << 20;
    for (const auto& block : partition.blocks)
      for (int d = 0; d < Dim; ++d)
        if ((d == 0 && closed) || block.cells.extent(d) < lattice.cells()[d])
          shortest = std::min(shortest, block.cells.extent(d));
    return shortest;
  }
  double dot(const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return comm.sum(sum);
  }
};

// In [-1, 1], the same on any number of ranks.
double noise(long cell, int variable, int instance) {
  std::mt19937_64 random(static_cast<std::uint64_t>((cell * 8 + variable) * 16 + instance));
  random.discard(3);
  return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

// Radii that vary smoothly by a factor of some ten from direction to direction and cell to cell.
template <int Dim>
double uneven_radius(const LatticeMesh<Dim>& lattice, const Index<Dim>& cell, int d, int instance) {
  double phase = 0.4 * instance + 1.3 * d;
  for (int e = 0; e < Dim; ++e)
    phase += 2.0 * std::numbers::pi * cell[e] / lattice.cells()[e] * (e == 0 ? 1.0 : 0.6);
  return std::exp(1.1 * std::sin(phase)) * (1.0 + 0.5 * d);
}

// The smoothing equations on the whole lattice, one line after the other, by Gauss-Seidel sweeps
// until nothing changes.
template <int Dim>
std::vector<double> smoothed_lattice(const LatticeMesh<Dim>& lattice, bool closed, std::vector<double> x,
                                     const std::function<double(const Index<Dim>&, int)>& eps) {
  constexpr int n = state_size<Dim>;
  const Box<Dim> box = box_of<Dim>(lattice.cells());
  for (int d = 0; d < Dim; ++d) {
    const std::vector<double> r = x;
    for (double change = 1.0; change > 1e-15;) {
      change = 0.0;
      for_each(box, [&](const Index<Dim>& cell) {
        const auto at = static_cast<std::size_t>(lattice.number(cell)) * n;
        const double e = eps(cell, d);
        for (std::size_t v = 0; v < n; ++v) {
          double sum = r[at + v], diagonal = 1.0;
          for (const int step : {-1, 1}) {
            Index<Dim> next = cell;
            next[d] += step;
            if (!(d == 0 && closed) && !box.contains(next)) continue;
            next[d] = (next[d] + lattice.cells()[d]) % lattice.cells()[d];
            sum += e * x[static_cast<std::size_t>(lattice.number(next)) * n + v];
            diagonal += e;
          }
          change = std::max(change, std::abs(sum / diagonal - x[at + v]));
          x[at + v] = sum / diagonal;
        }
      });
    }
  }
  return x;
}

// Error allowed for |r| <= 1: jumps are at most 2; a spike that crosses a block of L cells and is
// reflected at zero gradient arrives as at most 2 z^L, z the decaying root of the equation; it is
// weighted by own / (1 + 2 own) < 1/2, at two ends in each direction. Cutting spikes off adds the
// jump times the cut.
double allowed_error(int dim, double largest_eps, int shortest) {
  const double half = 1.0 + 0.5 / largest_eps;
  const double root = half - std::sqrt(half * half - 1.0);
  return dim * 2 * 2.0 * (std::pow(root, shortest) + spike_cut);
}

template <int Dim>
void expect_agreement_with_the_whole_lattice(SmoothingCase<Dim>& c, bool closed, double ratio) {
  constexpr int n = state_size<Dim>;
  const auto& lattice = c.lattice;
  constexpr int instances = 2;
  const auto lambda = c.field(Dim, instances, [&](const Index<Dim>& cell, int d, int i) {
    return uneven_radius<Dim>(lattice, cell, d, i);
  });
  c.smoothing.set_coefficients(lambda, instances, ratio);

  double largest = 0.0;
  const auto eps = [&](const Index<Dim>& cell, int d) {
    Vec<double, Dim> mean;
    for (int e = 0; e < Dim; ++e)
      mean[e] = 0.5 * (uneven_radius<Dim>(lattice, cell, e, 0) + uneven_radius<Dim>(lattice, cell, e, 1));
    const double value = smoothing_coefficients<Dim>(mean, ratio)[d];
    largest = std::max(largest, value);
    return value;
  };
  const auto result = c.smoothed(
      c.field(n, instances,
              [&](const Index<Dim>& cell, int v, int i) { return noise(lattice.number(cell), v, i); }),
      instances);
  for (int i = 0; i < instances; ++i) {
    std::vector<double> whole(box_of<Dim>(lattice.cells()).size() * n);
    for_each(box_of<Dim>(lattice.cells()), [&](const Index<Dim>& cell) {
      for (int v = 0; v < n; ++v)
        whole[static_cast<std::size_t>(lattice.number(cell)) * n + static_cast<std::size_t>(v)] =
            noise(lattice.number(cell), v, i);
    });
    whole = smoothed_lattice<Dim>(lattice, closed, std::move(whole), eps);
    double error = 0.0;
    for (std::size_t k = 0; k < c.cells.size(); ++k)
      for (std::size_t v = 0; v < n; ++v)
        error =
            std::max(error, std::abs(result[(static_cast<std::size_t>(i) * c.cells.size() + k) * n + v] -
                                     whole[static_cast<std::size_t>(lattice.number(c.cells[k])) * n + v]));
    const double allowed = allowed_error(Dim, largest, c.shortest_crossing(closed));
    EXPECT_LE(error, allowed);
    EXPECT_LT(allowed, 0.02) << "the bound must say something";
  }
}

TEST(ResidualSmoothing, SmoothsCellsOfEqualRadiiFullyAndLongOnesAcross) {
  const double full = 0.25 * (2.0 * 2.0 - 1.0);
  for (int d = 0; d < 2; ++d) EXPECT_NEAR(smoothing_coefficients<2>({{3.0, 3.0}}, 2.0)[d], full, 1e-14);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(smoothing_coefficients<3>({{3.0, 3.0, 3.0}}, 2.0)[d], full, 1e-14);
  const auto stretched = smoothing_coefficients<2>({{1.0, 1000.0}}, 2.0);
  EXPECT_EQ(stretched[0], 0.0);
  EXPECT_NEAR(stretched[1], full, 0.03);
  EXPECT_GE(smoothing_coefficients<2>({{1.0, 8.0}}, 2.0)[1], full);
  for (int d = 0; d < 2; ++d) EXPECT_EQ(smoothing_coefficients<2>({{2.0, 2.0}}, 1.0)[d], 0.0);
}

TEST(ResidualSmoothing, SolvesTheLinesOfARingAcrossItsCutAndItsRanks) {
  SmoothingCase<2> c(single_ring(64, 13));
  expect_agreement_with_the_whole_lattice(c, true, 2.0);
}

TEST(ResidualSmoothing, SolvesLinesThroughZonesAndThroughReversedOnes) {
  SmoothingCase<2> c(ring_of_four());
  expect_agreement_with_the_whole_lattice(c, true, 2.0);
}

TEST(ResidualSmoothing, SolvesLinesInThreeDimensions) {
  SmoothingCase<3> c(single_box());
  expect_agreement_with_the_whole_lattice(c, false, 1.7);
}

// A wave of length 2 pi / theta is damped by 1 / (1 + 2 eps (1 - cos theta)): the shortest by 1 + 4 eps.
TEST(ResidualSmoothing, DampsWavesByTheirSymbol) {
  constexpr int around = 64;
  constexpr double ratio = 2.2, eps = 0.25 * (ratio * ratio - 1.0);
  SmoothingCase<2> c(single_ring(around, 12));
  c.smoothing.set_coefficients(c.field(2, 1, [](const auto&, int, int) { return 0.7; }), 1, ratio);
  for (const int waves : {around / 2, 5}) {
    const double theta = 2.0 * std::numbers::pi * waves / around;
    const auto r = c.field(4, 1, [&](const Index<2>& cell, int, int) { return std::cos(theta * cell[0]); });
    const auto result = c.smoothed(r);
    const double damping = 1.0 / (1.0 + 2.0 * eps * (1.0 - std::cos(theta)));
    if (waves == around / 2) {
      EXPECT_NEAR(damping, 1.0 / (1.0 + 4.0 * eps), 1e-15);
    }
    for (std::size_t i = 0; i < r.size(); ++i)
      ASSERT_NEAR(result[i], damping * r[i], allowed_error(2, eps, c.shortest_crossing(true)));
  }
}

template <int Dim>
void expect_constants_preserved(const LatticeMesh<Dim>& lattice) {
  for (const unsigned seed : {1u, 2u}) {
    SmoothingCase<Dim> c(lattice, random_partition<Dim>(lattice.mesh(), Comm().size(), seed));
    c.smoothing.set_coefficients(
        c.field(Dim, 1,
                [&](const Index<Dim>& cell, int d, int) { return uneven_radius<Dim>(lattice, cell, d, 0); }),
        1, 3.0);
    const auto r = c.field(Dim + 2, 2, [](const auto&, int v, int i) { return 1.0 + v - 0.3 * i; });
    const auto result = c.smoothed(r, 2);
    for (std::size_t i = 0; i < r.size(); ++i) ASSERT_NEAR(result[i], r[i], 1e-12);
  }
}

TEST(ResidualSmoothing, PreservesConstantsWhateverTheBlocks) {
  expect_constants_preserved(single_ring(24, 9));
  expect_constants_preserved(turned_ring());
  expect_constants_preserved(turned_box());
  expect_constants_preserved(turned_shell());
}

// Blocks of a single cell in one direction, dealt to the ranks in turn.
Partition<2> slices(const LatticeMesh<2>& lattice, int direction) {
  const int ranks = Comm().size();
  Partition<2> partition{ranks, {}};
  for (int k = 0; k < lattice.cells()[direction]; ++k) {
    Box<2> slice = box_of<2>(lattice.cells());
    slice.begin[direction] = k, slice.end[direction] = k + 1;
    partition.blocks.push_back({0, slice, k % ranks});
  }
  return partition;
}

// With one coefficient everywhere the smoothing of a direction is symmetric, keeps the sum of the
// residuals, and neither enlarges nor turns around a residual, be the blocks ever so thin.
void expect_symmetric_and_damping(SmoothingCase<2>& c, int direction) {
  c.smoothing.set_coefficients(
      c.field(2, 1, [&](const auto&, int d, int) { return d == direction ? 1.0 : 1e-9; }), 1, 3.0);
  const auto a =
      c.field(4, 1, [&](const Index<2>& cell, int v, int) { return noise(c.lattice.number(cell), v, 0); });
  const auto b =
      c.field(4, 1, [&](const Index<2>& cell, int v, int) { return noise(c.lattice.number(cell), v, 1); });
  const auto alternating =
      c.field(4, 1, [&](const Index<2>& cell, int, int) { return cell[direction] % 2 == 0 ? 1.0 : -1.0; });
  const std::vector<double> ones(a.size(), 1.0);
  // What a cut spike leaves out: at most the cut times a jump of 2 in each cell.
  const double cut = 2.0 * spike_cut * c.dot(ones, ones);
  EXPECT_NEAR(c.dot(b, c.smoothed(a)), c.dot(a, c.smoothed(b)), cut);
  EXPECT_NEAR(c.dot(ones, c.smoothed(a)), c.dot(ones, a), cut);
  for (const auto& r : {a, alternating}) {
    const auto result = c.smoothed(r);
    EXPECT_LT(c.dot(result, result), c.dot(r, r));
    EXPECT_GT(c.dot(r, result), -cut);
  }
}

TEST(ResidualSmoothing, IsSymmetricAndDampingBetweenTheThinnestBlocks) {
  for (int d = 0; d < 2; ++d) {
    for (const auto& lattice : {single_ring(24, 9), turned_ring()})
      for (const unsigned seed : {3u, 4u}) {
        SmoothingCase<2> c(lattice, random_partition<2>(lattice.mesh(), Comm().size(), seed));
        expect_symmetric_and_damping(c, d);
      }
    SmoothingCase<2> sliced(single_ring(24, 9), slices(single_ring(24, 9), d));
    expect_symmetric_and_damping(sliced, d);
  }
}

TEST(ResidualSmoothing, LeavesResidualsAloneWhereTheRatioIsOne) {
  SmoothingCase<2> c(ring_of_four());
  c.smoothing.set_coefficients(c.field(2, 1, [](const auto&, int, int) { return 2.0; }), 1, 1.0);
  const auto r =
      c.field(4, 1, [&](const Index<2>& cell, int v, int) { return noise(c.lattice.number(cell), v, 0); });
  EXPECT_EQ(c.smoothed(r), r);
}

}  // namespace
}  // namespace wingbeat
