#include "adjoint/section_wall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/interface_transform.hpp"

namespace wingbeat {
namespace {

using Point = Vec<double, 2>;
constexpr double alike = 1e-11;  // relative: distances and angles that differ by round-off only

double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }
Point unit(const Point& a) { return (1.0 / norm(a)) * a; }

[[noreturn]] void refuse(const std::string& found) {
  throw InputError("shape variables need a wall that is one closed curve around one section; " + found);
}

// For each node of the mesh the one that follows on the wall, with the fluid on the left; -1 off the wall.
std::vector<int> following_nodes(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers) {
  std::vector<int> next(numbers.count, -1);
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for (const BoundaryPatch<2>& patch : mesh.zones[z].patches) {
      if (patch.type != BoundaryType::slip_wall) continue;
      // Blocks are right-handed: along i the inside of side j-low is on the left, along j that of i-high.
      const bool forward = (patch.side.direction == 1) == (patch.side.end == 0);
      for_each(patch.cells, [&](const Index<2>& cell) {
        const Box<2> face =
            nodes_of_side_cells<2>(mesh.zones[z].cells, patch.side, box_between<2>(cell, cell));
        const int low = numbers.zones[z](face.begin), high = numbers.zones[z](last_index(face));
        int& successor = next[forward ? low : high];
        if (successor >= 0) refuse("here curves meet in a node: several bodies touch, or one touches itself");
        successor = forward ? high : low;
      });
    }
  return next;
}

// The nodes of the wall in order, from its lowest number.
std::vector<int> closed_curve(const std::vector<int>& next) {
  std::vector<char> seen(next.size(), 0);
  std::vector<std::vector<int>> curves;
  for (int start = 0; start < std::ssize(next); ++start) {
    if (next[start] < 0 || seen[start]) continue;
    std::vector<int>& curve = curves.emplace_back();
    int node = start;
    while (node >= 0 && !seen[node]) {
      seen[node] = 1;
      curve.push_back(node);
      node = next[node];
    }
    if (node != start) refuse("here it is open: it begins or ends at another boundary");
  }
  if (curves.empty()) refuse("the mesh has no slip wall");
  if (curves.size() == 1) return curves.front();
  std::string faces;
  for (const auto& curve : curves) faces += fmt::format("{}{}", faces.empty() ? "" : ", ", curve.size());
  refuse(
      fmt::format("the mesh has {} bodies, with {} wall faces: shape variables move one section only; give a "
                  "mesh of one body",
                  curves.size(), faces));
}

// Twice the enclosed area, positive where the curve runs counter-clockwise.
double enclosed(const std::vector<Point>& curve) {
  double sum = 0.0;
  for (std::size_t w = 0; w < curve.size(); ++w)
    sum += cross(curve[w] - curve[0], curve[(w + 1) % curve.size()] - curve[0]);
  return sum;
}

// Where the curve turns most; among those alike, the one farthest downstream.
std::size_t trailing_edge(const std::vector<Point>& curve) {
  const std::size_t n = curve.size();
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t w = 0; w < n; ++w) {
    const Point before = curve[w] - curve[(w + n - 1) % n], after = curve[(w + 1) % n] - curve[w];
    const double turn = std::abs(std::atan2(cross(before, after), dot(before, after)));
    const bool tie = std::abs(turn - most) < alike;
    if (tie ? curve[w][0] > curve[best][0] : turn > most) best = w, most = turn;
  }
  return best;
}

// Where the leading edge lies on the curve: entry `node`, or the middle of the face from there on.
struct LeadingEdge {
  std::size_t node = 0;
  bool between = false;
};

LeadingEdge leading_edge(const std::vector<Point>& curve) {
  LeadingEdge found;
  double farthest = 0.0;
  for (std::size_t w = 1; w < curve.size(); ++w) {
    const double distance = norm(curve[w] - curve[0]);
    if (w == found.node + 1 && std::abs(distance - farthest) < alike * farthest)
      found.between = true;
    else if (distance > farthest)
      found = {w, false}, farthest = distance;
  }
  return found;
}

// Lengths are summed from the trailing edge on both surfaces, so that those of mirrored nodes are alike.
std::vector<double> arc_parameters(const std::vector<Point>& curve) {
  const std::size_t n = curve.size();
  const auto face = [&](std::size_t w) { return norm(curve[(w + 1) % n] - curve[w]); };
  const LeadingEdge edge = leading_edge(curve);
  std::vector<double> s(n, 0.0);
  double lower = 0.0, upper = 0.0;
  for (std::size_t w = 1; w <= edge.node; ++w) s[w] = lower += face(w - 1);
  const std::size_t first_upper = edge.node + 1;
  for (std::size_t w = n - 1; w >= first_upper; --w) s[w] = upper += face(w);
  const double nose = face(edge.node);
  lower += edge.between ? 0.5 * nose : 0.0;
  upper += edge.between ? 0.5 * nose : nose;
  for (std::size_t w = 1; w < n; ++w)
    s[w] = w < first_upper ? 0.5 * (s[w] / lower) : 1.0 - 0.5 * (s[w] / upper);
  return s;
}

}  // namespace

double SectionWall::chord() const {
  double farthest = 0.0;
  for (const Point& x : positions) farthest = std::max(farthest, norm(x - positions.front()));
  return farthest;
}

SectionWall section_wall(const MultiblockMesh<2>& mesh, const NodeNumbers<2>& numbers) {
  const std::vector<Point> all = unique_positions(mesh, numbers);
  SectionWall wall;
  wall.nodes = closed_curve(following_nodes(mesh, numbers));
  const auto place = [&] {
    wall.positions.clear();
    for (const int node : wall.nodes) wall.positions.push_back(all[node]);
  };
  place();
  if (enclosed(wall.positions) >= 0.0) refuse("here it encloses the fluid");
  const auto edge = static_cast<std::ptrdiff_t>(trailing_edge(wall.positions));
  std::ranges::rotate(wall.nodes, wall.nodes.begin() + edge);
  place();

  const std::size_t n = wall.size();
  for (std::size_t w = 0; w < n; ++w) {
    const Point before = wall.positions[w] - wall.positions[(w + n - 1) % n];
    const Point after = wall.positions[(w + 1) % n] - wall.positions[w];
    const Point along = before + after;
    wall.normals.push_back(w == 0 ? unit(unit(before) - unit(after)) : unit({{-along[1], along[0]}}));
    wall.areas.push_back(0.5 * (norm(before) + norm(after)));
  }
  wall.s = arc_parameters(wall.positions);
  return wall;
}

}  // namespace wingbeat
