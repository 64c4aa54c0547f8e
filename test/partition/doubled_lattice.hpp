#pragma once

#include "test/partition/lattice_mesh.hpp"
#include "test/partition/lattice_partition.hpp"

namespace wingbeat {

// A lattice and the one with two cells for each of its own in every direction.
template <int Dim>
struct DoubledLattice {
  LatticeMesh<Dim> coarse;
  LatticeMesh<Dim> fine;

  DoubledLattice(Index<Dim> cells, bool closed, std::vector<LatticeZone<Dim>> zones)
      : coarse(cells, closed, zones), fine(doubled(cells), closed, doubled(zones)) {}

  static Index<Dim> doubled(Index<Dim> index) {
    for (int& i : index) i *= 2;
    return index;
  }
  static Index<Dim> halved(Index<Dim> index) {
    for (int& i : index) i /= 2;
    return index;
  }
  static std::vector<LatticeZone<Dim>> doubled(std::vector<LatticeZone<Dim>> zones) {
    for (auto& [cells, orientation] : zones) cells = {doubled(cells.begin), doubled(cells.end)};
    return zones;
  }
};

// An O-mesh: reversed and permuted zones, one a single cell thick, a T-junction.
inline DoubledLattice<2> doubled_ring() {
  return {{12, 5},
          true,
          {{{{0, 0}, {4, 5}}, {{0, 1}, {1, 1}}},
           {{{4, 0}, {7, 2}}, {{1, 0}, {1, -1}}},
           {{{4, 2}, {7, 5}}, {{0, 1}, {-1, -1}}},
           {{{7, 0}, {8, 5}}, {{1, 0}, {-1, 1}}},
           {{{8, 0}, {12, 5}}, {{0, 1}, {-1, -1}}}}};
}
inline DoubledLattice<3> doubled_shell() {
  return {{8, 3, 4},
          true,
          {{{{0, 0, 0}, {3, 3, 4}}, {{2, 0, 1}, {1, 1, 1}}},
           {{{3, 0, 0}, {8, 3, 2}}, {{0, 1, 2}, {-1, -1, 1}}},
           {{{3, 0, 2}, {8, 3, 4}}, {{1, 0, 2}, {-1, 1, 1}}}}};
}
inline DoubledLattice<3> doubled_box() {
  return {{6, 5, 3},
          false,
          {{{{0, 0, 0}, {3, 5, 3}}, {{0, 1, 2}, {1, 1, 1}}},
           {{{3, 0, 0}, {6, 2, 3}}, {{1, 2, 0}, {1, 1, 1}}},
           {{{3, 2, 0}, {6, 5, 1}}, {{2, 1, 0}, {-1, 1, 1}}},
           {{{3, 2, 1}, {6, 5, 3}}, {{0, 2, 1}, {1, -1, 1}}}}};
}

}  // namespace wingbeat
