#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "core/mesh/interface_transform.hpp"
#include "core/mesh/multiblock_mesh.hpp"
#include "core/mesh/reorient.hpp"

// Small meshes with every kind of connection.
namespace wingbeat::example {

// A zone with nodes placed by position(index), no patches and no interfaces.
template <int Dim, class Position>
Zone<Dim> make_zone(const std::string& name, const Index<Dim>& cells, Position&& position) {
  Zone<Dim> zone;
  zone.name = name;
  zone.cells = cells;
  Index<Dim> nodes = cells;
  for (int& n : nodes) ++n;
  zone.nodes = BlockArray<Vec<double, Dim>, Dim>(nodes, 0);
  for_each<Dim>(box_of<Dim>(nodes), [&](const Index<Dim>& node) { zone.nodes(node) = position(node); });
  return zone;
}

template <int Dim>
void add_patch(Zone<Dim>& zone, const std::string& name, BoundaryType type, const Side& side) {
  zone.patches.push_back({name, name + "-family", type, side, side_cells<Dim>(zone.cells, side)});
}

// A smooth, curved image of a lattice of unit spacing.
template <int Dim>
Vec<double, Dim> bent(const Vec<double, Dim>& x) {
  Vec<double, Dim> y = x;
  for (int d = 0; d < Dim; ++d) y[d] += 0.1 * std::sin(0.7 * x[(d + 1) % Dim] + d);
  return y;
}

// Blocks side by side along i, each of the given size, joined i-high to i-low; curved.
template <int Dim>
MultiblockMesh<Dim> row_of_blocks(int blocks, const Index<Dim>& cells) {
  MultiblockMesh<Dim> mesh;
  for (int b = 0; b < blocks; ++b) {
    Zone<Dim> zone = make_zone<Dim>("block-" + std::to_string(b + 1), cells, [&](const Index<Dim>& node) {
      Vec<double, Dim> x{};
      for (int d = 0; d < Dim; ++d) x[d] = node[d] + (d == 0 ? b * cells[0] : 0);
      return bent<Dim>(x);
    });
    for (int d = 1; d < Dim; ++d)
      for (int end : {0, 1}) {
        const auto type = d == 1 && end == 0 ? BoundaryType::slip_wall : BoundaryType::farfield;
        add_patch<Dim>(zone, std::string(1, "ijk"[d]) + std::to_string(end), type, {d, end});
      }
    if (b == 0) add_patch<Dim>(zone, "first", BoundaryType::symmetry, {0, 0});
    if (b == blocks - 1) add_patch<Dim>(zone, "last", BoundaryType::symmetry, {0, 1});
    mesh.zones.push_back(std::move(zone));
  }
  for (int b = 0; b + 1 < blocks; ++b) {
    Interface<Dim> join;
    join.name = "next";
    join.side = {0, 1};
    join.nodes = nodes_of_side_cells<Dim>(cells, join.side, side_cells<Dim>(cells, join.side));
    join.donor = b + 1;
    join.donor_side = {0, 0};
    join.donor_origin = Index<Dim>{};
    for (int d = 0; d < Dim; ++d) join.axis[d] = d, join.sign[d] = 1;
    mesh.zones[b].interfaces.push_back(join);
    mesh.zones[b + 1].interfaces.push_back(reversed(join, b, "previous"));
  }
  return mesh;
}

// O-mesh around a circle, i counter-clockwise reversed so that it is right-handed (j outwards):
// wall on j-low, far field on j-high, the zone joined to itself at the O-cut.
inline MultiblockMesh<2> ring(int around, int normal, const std::string& name = "ring") {
  Zone<2> zone = make_zone<2>(name, {around, normal}, [&](const Index<2>& node) {
    const double angle = -2.0 * std::numbers::pi * (node[0] % around) / around;
    const double radius = std::pow(1.3, node[1]);
    return Vec<double, 2>{{{radius * std::cos(angle), radius * std::sin(angle)}}};
  });
  add_patch<2>(zone, "wall", BoundaryType::slip_wall, {1, 0});
  add_patch<2>(zone, "farfield", BoundaryType::farfield, {1, 1});
  Interface<2> cut;
  cut.name = "cut-low";
  cut.side = {0, 0};
  cut.nodes = {{0, 0}, {1, normal + 1}};
  cut.donor_side = {0, 1};
  cut.donor_origin = {around, 0};
  cut.axis = {0, 1};
  cut.sign = {1, 1};
  zone.interfaces = {cut, reversed(cut, 0, "cut-high")};
  return {{zone}};
}

// C-mesh around a circle with a wake of `wake` cells: j-low of the wake is joined to itself.
// Bare: no patches, no interfaces.
inline MultiblockMesh<2> bare_c_mesh(int wake = 4, int body = 8, int normal = 2) {
  const int around = 2 * wake + body;
  return {{make_zone<2>("c-mesh", {around, normal}, [&](const Index<2>& node) {
    const double h = 0.2 * node[1];
    const int from_end = std::min(node[0], around - node[0]);
    const double up = 2 * node[0] < around ? 1.0 : -1.0;
    if (from_end <= wake) {
      const double x = 0.5 + 0.5 * (wake - from_end) + (from_end == wake ? 0.3 * h : 0.0);
      return Vec<double, 2>{{{x, up * h}}};
    }
    const double angle = 2.0 * std::numbers::pi * (node[0] - wake) / body;
    return Vec<double, 2>{{{(0.5 + h) * std::cos(angle), (0.5 + h) * std::sin(angle)}}};
  })}};
}

// A 2-D mesh extruded by one cell: k is the new direction, and `span` the coordinate it runs
// along (the others keep their order), between two symmetry planes.
inline MultiblockMesh<3> extruded(const MultiblockMesh<2>& plane, int span, double width) {
  const Index<2> kept{span == 0 ? 1 : 0, span == 2 ? 1 : 2};
  MultiblockMesh<3> mesh;
  for (const Zone<2>& zone : plane.zones) {
    Zone<3> thick = make_zone<3>(zone.name, {zone.cells[0], zone.cells[1], 1}, [&](const Index<3>& node) {
      Vec<double, 3> x{};
      x[kept[0]] = zone.nodes({node[0], node[1]})[0];
      x[kept[1]] = zone.nodes({node[0], node[1]})[1];
      x[span] = width * node[2];
      return x;
    });
    for (const BoundaryPatch<2>& patch : zone.patches)
      thick.patches.push_back(
          {patch.name,
           patch.family,
           patch.type,
           patch.side,
           {{patch.cells.begin[0], patch.cells.begin[1], 0}, {patch.cells.end[0], patch.cells.end[1], 1}}});
    add_patch<3>(thick, "left", BoundaryType::symmetry, {2, 0});
    add_patch<3>(thick, "right", BoundaryType::symmetry, {2, 1});
    for (const Interface<2>& flat : zone.interfaces) {
      Interface<3> join;
      join.name = flat.name;
      join.side = flat.side;
      join.nodes = {{flat.nodes.begin[0], flat.nodes.begin[1], 0}, {flat.nodes.end[0], flat.nodes.end[1], 2}};
      join.donor = flat.donor;
      join.donor_side = flat.donor_side;
      join.donor_origin = {flat.donor_origin[0], flat.donor_origin[1], 0};
      join.axis = {flat.axis[0], flat.axis[1], 2};
      join.sign = {flat.sign[0], flat.sign[1], 1};
      thick.interfaces.push_back(join);
    }
    mesh.zones.push_back(std::move(thick));
  }
  return mesh;
}

// All 8 (2-D) or 48 (3-D) renumberings of a block; about half of them make it left-handed.
template <int Dim>
std::vector<Orientation<Dim>> all_orientations() {
  std::vector<Orientation<Dim>> all;
  Index<Dim> axis{};
  std::iota(axis.begin(), axis.end(), 0);
  do {
    for (int signs = 0; signs < 1 << Dim; ++signs) {
      Orientation<Dim> o{axis, {}};
      for (int d = 0; d < Dim; ++d) o.sign[d] = (signs >> d & 1) != 0 ? -1 : 1;
      all.push_back(o);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return all;
}

// Centre of a cell: what a cell is, however its block is numbered.
template <int Dim>
Vec<double, Dim> centre(const MultiblockMesh<Dim>& mesh, int zone, const Index<Dim>& cell) {
  Vec<double, Dim> sum{};
  Index<Dim> end = cell;
  for (int& e : end) e += 2;
  for_each<Dim>(Box<Dim>{cell, end}, [&](const Index<Dim>& node) { sum += mesh.zones[zone].nodes(node); });
  return (1.0 / (1 << Dim)) * sum;
}

template <int Dim>
double distance(const Vec<double, Dim>& a, const Vec<double, Dim>& b) {
  return std::sqrt(dot(a - b, a - b));
}

// Equality of everything, coordinates bit for bit.
template <int Dim>
bool same(const MultiblockMesh<Dim>& a, const MultiblockMesh<Dim>& b) {
  const auto patches_equal = [](const BoundaryPatch<Dim>& p, const BoundaryPatch<Dim>& q) {
    return p.name == q.name && p.family == q.family && p.type == q.type && p.side == q.side &&
           p.cells == q.cells;
  };
  const auto interfaces_equal = [](const Interface<Dim>& p, const Interface<Dim>& q) {
    return p.name == q.name && p.side == q.side && p.nodes == q.nodes && p.donor == q.donor &&
           p.donor_side == q.donor_side && p.donor_origin == q.donor_origin && p.axis == q.axis &&
           p.sign == q.sign;
  };
  return std::equal(a.zones.begin(), a.zones.end(), b.zones.begin(), b.zones.end(),
                    [&](const Zone<Dim>& p, const Zone<Dim>& q) {
                      return p.name == q.name && p.cells == q.cells && p.nodes.size() == q.nodes.size() &&
                             std::equal(p.nodes.data(), p.nodes.data() + p.nodes.size(), q.nodes.data()) &&
                             std::equal(p.patches.begin(), p.patches.end(), q.patches.begin(),
                                        q.patches.end(), patches_equal) &&
                             std::equal(p.interfaces.begin(), p.interfaces.end(), q.interfaces.begin(),
                                        q.interfaces.end(), interfaces_equal);
                    });
}

}  // namespace wingbeat::example
