#include "adjoint/grid_lines.hpp"

#include <algorithm>

#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"

namespace wingbeat {
namespace {

constexpr double reach = 2.0;  // chords along a line over which the displacement falls to 0

[[noreturn]] void refuse(const std::string& found) {
  throw InputError(
      "design.deformation = \"grid_lines\" needs lines that run from the wall to another boundary and cover "
      "the "
      "mesh once, as in an O-mesh; " +
      found + "; set design.deformation = \"inverse_distance\"");
}

bool ends_at_wall(const MultiblockMesh<2>& mesh, const CellPosition<2>& position, int d, int step) {
  const int direction = position.axis[d];
  const Side side{direction, step * position.sign[d] > 0 ? 1 : 0};
  return std::ranges::any_of(mesh.zones[position.zone].patches, [&](const BoundaryPatch<2>& patch) {
    return patch.type == BoundaryType::slip_wall && patch.side == side && patch.cells.contains(position.cell);
  });
}

// The nodes of the line that leaves the wall at one of the two nodes (0 or 1) of a cell's face on `side`, the
// wall's first.
std::vector<int> line_from(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers,
                           CellPosition<2> position, const Side& side, int of_face) {
  const int d = side.direction, step = side.end == 0 ? 1 : -1;
  Index<2> corner{};
  corner[1 - d] = of_face;
  corner[d] = side.end;
  const auto number = [&] { return numbers.zones[position.zone](corner_node<2>(position, corner)); };
  std::vector<int> line{number()};
  corner[d] = 1 - side.end;
  line.push_back(number());
  while (step_to_neighbour(mesh, position, d, step)) {
    line.push_back(number());
    if (std::ssize(line) > numbers.count) refuse("here a line closes on itself");
  }
  if (ends_at_wall(mesh, position, d, step)) refuse("here a line leads from wall to wall");
  return line;
}

// From 1 to 0 as x goes from 0 to 1, with neither slope nor curvature at either end.
double smooth_fall(double x) {
  const double y = 1.0 - x;
  return y * y * y * (1.0 + x * (3.0 + 6.0 * x));
}

}  // namespace

GridLines::GridLines(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers, const SectionWall& wall)
    : line_(numbers.count, -1), fraction_(numbers.count, 0.0) {
  const std::vector<Vec<double, 2>> positions = unique_positions(mesh, numbers);
  std::vector<int> entry(numbers.count, -1);  // of the wall, [number]
  for (std::size_t w = 0; w < wall.size(); ++w) entry[wall.nodes[w]] = static_cast<int>(w);

  int covered = 0;
  const auto cover = [&](const std::vector<int>& line) {
    if (line_[line.front()] >= 0) return;  // begun from the other face of this node
    std::vector<double> length{0.0};
    for (std::size_t n = 1; n < line.size(); ++n)
      length.push_back(length.back() + norm(positions[line[n]] - positions[line[n - 1]]));
    const double end = std::min(reach * wall.chord(), length.back());
    for (std::size_t n = 0; n < line.size(); ++n) {
      if (line_[line[n]] >= 0) refuse("here two lines share a node");
      line_[line[n]] = entry[line.front()];
      fraction_[line[n]] = smooth_fall(std::min(1.0, length[n] / end));
      ++covered;
    }
  };
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for (const BoundaryPatch<2>& patch : mesh.zones[z].patches)
      if (patch.type == BoundaryType::slip_wall)
        for_each(patch.cells, [&](const Index<2>& cell) {
          const auto start = start_position<2>(static_cast<int>(z), cell);
          for (const int of_face : {0, 1}) cover(line_from(mesh, numbers, start, patch.side, of_face));
        });
  if (covered < numbers.count)
    refuse("here " + std::to_string(numbers.count - covered) + " of " + std::to_string(numbers.count) +
           " nodes lie on no line from the wall");
}

std::vector<Vec<double, 2>> GridLines::displacement(std::span<const Vec<double, 2>> wall,
                                                    std::span<const int> nodes) const {
  std::vector<Vec<double, 2>> moved;
  for (const int node : nodes) moved.push_back(fraction_[node] * wall[line_[node]]);
  return moved;
}

void GridLines::add_transpose(std::span<const Vec<double, 2>> sensitivities, std::span<const int> nodes,
                              std::span<Vec<double, 2>> wall) const {
  for (std::size_t n = 0; n < nodes.size(); ++n)
    wall[line_[nodes[n]]] += fraction_[nodes[n]] * sensitivities[n];
}

}  // namespace wingbeat
