#pragma once

#include <string>

#include "core/mesh/multiblock_mesh.hpp"

namespace wingbeat {

// The worst value of a measure and the cell that has it.
template <int Dim>
struct Extreme {
  double value = 0.0;
  int zone = 0;
  Index<Dim> cell{};
};

// How well shaped the cells are. Lengths and volumes in the mesh's own unit.
template <int Dim>
struct MeshQuality {
  std::size_t zones = 0;
  std::size_t cells = 0;
  std::size_t patches = 0;
  std::size_t interfaces = 0;
  std::size_t wall_faces = 0;
  std::size_t symmetry_faces = 0;
  std::size_t farfield_faces = 0;
  double total_volume = 0.0;
  Extreme<Dim> min_volume;
  Extreme<Dim> max_volume;
  Extreme<Dim> min_angle_deg;     // smallest angle between two edges at a corner, taken below 90
  Extreme<Dim> max_aspect_ratio;  // longest over shortest mean edge of a cell
  Extreme<Dim> max_volume_ratio;  // larger over smaller volume of two neighbours
  Extreme<Dim> min_determinant;   // of the unit edges at a corner: 1 in a box, 0 in a flat cell
};

template <int Dim>
MeshQuality<Dim> measure_quality(const MultiblockMesh<Dim>& mesh);

// A table for people, zones by name and cells counted from 1.
template <int Dim>
std::string format_quality(const MultiblockMesh<Dim>& mesh, const MeshQuality<Dim>& quality);

}  // namespace wingbeat
