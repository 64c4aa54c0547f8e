#pragma once

#include <cstddef>
#include <vector>

#include "core/mesh/node_numbers.hpp"

namespace wingbeat {

// The wall of a plane mesh as one closed curve. Entry 0 is the trailing edge; from there the nodes run along
// the lower surface over the leading edge to the upper one, each once: a last face leads back to entry 0.
struct SectionWall {
  std::vector<int> nodes;                 // node numbers
  std::vector<Vec<double, 2>> positions;  // in the mesh's unit, chords
  // Unit vectors out of the section: the mean of the two neighbouring faces, weighted by area. At the
  // trailing edge, where these two may cancel, the bisector of the corner.
  std::vector<Vec<double, 2>> normals;
  std::vector<double> areas;  // half of the two neighbouring faces
  // Arc parameter in [0, 1): arc length from the trailing edge, scaled on each surface so that s = 1/2 is the
  // leading edge. The trailing edge, where s is 0 and 1, has 0. Mirrored nodes of a symmetric section have
  // s and 1 - s, to round-off.
  std::vector<double> s;

  std::size_t size() const { return nodes.size(); }
  // Greatest distance of the wall from its trailing edge.
  double chord() const;
};

// Trailing edge: the node where the curve turns most; where several are alike, the one with the largest x.
// Leading edge: the node farthest from the trailing edge; where two neighbours are equally far, the middle of
// the face between them. The same, bit for bit, however the mesh is cut into blocks.
// Throws InputError unless the wall is one closed curve with the fluid outside.
SectionWall section_wall(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers);

}  // namespace wingbeat
