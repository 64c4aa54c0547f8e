#include "flow/surface.hpp"

#include <algorithm>
#include <cmath>

#include "flow/boundary.hpp"

namespace wingbeat {
namespace {

// Mean of the corners of the face of `cell` on a side.
template <int Dim>
Vec<double, Dim> face_centre(const LocalBlock<Dim>& block, const Index<Dim>& cell, const Side& side) {
  Box<Dim> corners{cell, cell};
  for (int d = 0; d < Dim; ++d) corners.end[d] += 2;
  corners.begin[side.direction] += side.end;
  corners.end[side.direction] = corners.begin[side.direction] + 1;
  Vec<double, Dim> centre{};
  for_each(corners, [&](const Index<Dim>& node) { centre += block.nodes(node); });
  return (1.0 / static_cast<double>(corners.size())) * centre;
}

constexpr std::size_t record = 8;  // doubles a point in a message

std::vector<SurfacePoint> unpacked(const std::vector<double>& packed) {
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i + record <= packed.size(); i += record) {
    const double* p = packed.data() + i;
    points.push_back(
        {std::lround(p[0]), static_cast<int>(p[1]), {{{p[2], p[3]}}}, {{{p[4], p[5]}}}, p[6], p[7]});
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const SurfacePoint& a, const SurfacePoint& b) { return a.cell < b.cell; });
  return points;
}

}  // namespace

template <int Dim>
Vec<double, Dim> carried(const Vec<double, Dim>& at_rest, const Vec<double, 2>& axis,
                         const SectionPosition& position) {
  Vec<double, Dim> arm = at_rest;
  arm[0] -= axis[0];
  arm[1] -= axis[1];
  Vec<double, Dim> place = rigid_motion({position.pitch, 0.0, 0.0}).turned(arm);
  place[0] += axis[0];
  place[1] += axis[1] - position.plunge;
  return place;
}

template <int Dim>
std::vector<SurfacePoint> surface_points(const FlowLevel<Dim>& level, const FlowModel<Dim, double>& model,
                                         std::span<const double> w, const SectionPosition& position) {
  constexpr int n = state_size<Dim>;
  const double gamma = model.freestream.gamma;
  std::vector<double> ghosts(level.local.ghosts.size() * n);
  level.domain.exchange().template gather<double>(w, ghosts, 1, n);
  const auto state_of = [&](int cell) {
    const int owned = level.local.owned_count;
    const double* from = cell < owned ? w.data() + cell * n : ghosts.data() + (cell - owned) * n;
    State<Dim, double> state;
    for (int v = 0; v < n; ++v) state[v] = from[v];
    return state;
  };
  std::vector<double> packed;
  for (const LocalBlock<Dim>& block : level.local.blocks)
    for (const BoundaryPatch<Dim>& patch : block.patches) {
      if (patch.type != BoundaryType::slip_wall) continue;
      for_each(patch.cells, [&](const Index<Dim>& cell) {
        Index<Dim> inner = cell;
        inner[patch.side.direction] += patch.side.end == 0 ? 1 : -1;
        const int first = block.cell_number(cell), second = block.cell_number(inner);
        const auto near = state_of(first);
        const double p_near = pressure<Dim, double>(near, gamma);
        const double p_second = second >= 0 ? pressure<Dim, double>(state_of(second), gamma) : p_near;
        const double p = wall_pressure(p_near, p_second);
        const auto u = velocity<Dim, double>(near);
        const auto body = face_centre<Dim>(block, cell, patch.side);
        const auto place = carried<Dim>(body, level.domain.axis(), position);
        packed.insert(packed.end(),
                      {static_cast<double>(level.local.global_cell[static_cast<std::size_t>(first)]),
                       static_cast<double>(block.zone), body[0], body[1], place[0], place[1],
                       (p - 1.0) / model.freestream.dynamic_pressure(),
                       std::sqrt(dot(u, u) * near[0] / (gamma * p_near))});
      });
    }
  return unpacked(level.comm().gather(packed));
}

template Vec<double, 2> carried<2>(const Vec<double, 2>&, const Vec<double, 2>&, const SectionPosition&);
template Vec<double, 3> carried<3>(const Vec<double, 3>&, const Vec<double, 2>&, const SectionPosition&);
template std::vector<SurfacePoint> surface_points<2>(const FlowLevel<2>&, const FlowModel<2, double>&,
                                                     std::span<const double>, const SectionPosition&);
template std::vector<SurfacePoint> surface_points<3>(const FlowLevel<3>&, const FlowModel<3, double>&,
                                                     std::span<const double>, const SectionPosition&);

}  // namespace wingbeat
