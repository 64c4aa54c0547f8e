#pragma once

#include <span>
#include <vector>

#include "adjoint/section_wall.hpp"
#include "core/mesh/node_numbers.hpp"

namespace wingbeat {

// Displacement of a node: that of the wall node where its grid line starts, times a fraction that falls with
// the length of the line up to it (eq:grid-lines).
class GridLines {
 public:
  // Follows the lines from the wall through all blocks. Throws InputError where they do not cover the mesh
  // once, each from the wall to another boundary.
  GridLines(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers, const SectionWall& wall);

  // See MeshDeformation.
  std::vector<Vec<double, 2>> displacement(std::span<const Vec<double, 2>> wall,
                                           std::span<const int> nodes) const;
  void add_transpose(std::span<const Vec<double, 2>> sensitivities, std::span<const int> nodes,
                     std::span<Vec<double, 2>> wall) const;

 private:
  std::vector<int> line_;         // [number]: entry of the wall where its line starts
  std::vector<double> fraction_;  // [number]: of that entry's displacement
};

}  // namespace wingbeat
