#include "core/mesh/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/mesh_names.hpp"

namespace wingbeat {
namespace {

template <int Dim>
double smallest_angle_deg(const CellCorners<Dim>& corners) {
  double largest_cosine = 0.0;
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (int d = 0; d < Dim; ++d)
      for (int e = 0; e < d; ++e) {
        const auto a = corner_edge<Dim>(corners, c, d);
        const auto b = corner_edge<Dim>(corners, c, e);
        largest_cosine = std::max(largest_cosine, std::abs(dot(a, b)) / (norm(a) * norm(b)));
      }
  return std::acos(std::min(1.0, largest_cosine)) * 180.0 / std::numbers::pi;
}

template <int Dim>
double aspect_ratio(const CellCorners<Dim>& corners) {
  Vec<double, Dim> length{};
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (int d = 0; d < Dim; ++d) length[d] += norm(corner_edge<Dim>(corners, c, d));
  const auto [shortest, longest] = std::minmax_element(length.components.begin(), length.components.end());
  return *longest / *shortest;
}

template <int Dim>
double smallest_determinant(const CellCorners<Dim>& corners) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < corners.size(); ++c) {
    double scale = 1.0;
    for (int d = 0; d < Dim; ++d) scale *= norm(corner_edge<Dim>(corners, c, d));
    smallest = std::min(smallest, corner_determinant<Dim>(corners, c) / scale);
  }
  return smallest;
}

template <int Dim>
void count_faces(const Zone<Dim>& zone, MeshQuality<Dim>& quality) {
  quality.patches += zone.patches.size();
  quality.interfaces += zone.interfaces.size();
  for (const BoundaryPatch<Dim>& patch : zone.patches) switch (patch.type) {
      case BoundaryType::slip_wall:
        quality.wall_faces += patch.cells.size();
        break;
      case BoundaryType::symmetry:
        quality.symmetry_faces += patch.cells.size();
        break;
      case BoundaryType::farfield:
        quality.farfield_faces += patch.cells.size();
        break;
    }
}

// Ratio of a cell's volume to that of its neighbours at higher index, or its inverse.
template <int Dim>
double volume_ratio(const MultiblockMesh<Dim>& mesh, int zone, const Index<Dim>& cell, double volume) {
  double largest = 1.0;
  for (int d = 0; d < Dim; ++d) {
    CellPosition<Dim> neighbour = start_position<Dim>(zone, cell);
    if (!step_to_neighbour(mesh, neighbour, d, 1)) continue;
    const double other = cell_volume(cell_corners<Dim>(mesh.zones[neighbour.zone], neighbour.cell));
    largest = std::max({largest, volume / other, other / volume});
  }
  return largest;
}

}  // namespace

template <int Dim>
MeshQuality<Dim> measure_quality(const MultiblockMesh<Dim>& mesh) {
  MeshQuality<Dim> quality;
  quality.zones = mesh.zones.size();
  quality.cells = mesh.cell_count();
  for (auto* extreme : {&quality.min_volume, &quality.min_angle_deg, &quality.min_determinant})
    extreme->value = std::numeric_limits<double>::infinity();
  for (auto* extreme : {&quality.max_volume, &quality.max_aspect_ratio, &quality.max_volume_ratio})
    extreme->value = -std::numeric_limits<double>::infinity();

  for (int z = 0; z < static_cast<int>(mesh.zones.size()); ++z) {
    const Zone<Dim>& zone = mesh.zones[z];
    count_faces(zone, quality);
    for_each<Dim>(box_of<Dim>(zone.cells), [&](const Index<Dim>& cell) {
      const auto lower = [&](Extreme<Dim>& extreme, double value) {
        if (value < extreme.value) extreme = {value, z, cell};
      };
      const auto raise = [&](Extreme<Dim>& extreme, double value) {
        if (value > extreme.value) extreme = {value, z, cell};
      };
      const CellCorners<Dim> corners = cell_corners<Dim>(zone, cell);
      const double volume = cell_volume(corners);
      quality.total_volume += volume;
      lower(quality.min_volume, volume);
      raise(quality.max_volume, volume);
      lower(quality.min_angle_deg, smallest_angle_deg<Dim>(corners));
      lower(quality.min_determinant, smallest_determinant<Dim>(corners));
      raise(quality.max_aspect_ratio, aspect_ratio<Dim>(corners));
      raise(quality.max_volume_ratio, volume_ratio<Dim>(mesh, z, cell, volume));
    });
  }
  return quality;
}

template <int Dim>
std::string format_quality(const MultiblockMesh<Dim>& mesh, const MeshQuality<Dim>& quality) {
  const auto row = [&](std::string_view label, const Extreme<Dim>& extreme) {
    return fmt::format("{:<24}{:>12.5g}   zone {}, cell {}\n", label, extreme.value,
                       mesh.zones[extreme.zone].name, index_text<Dim>(extreme.cell));
  };
  return fmt::format("zones {}, cells {}, patches {}, interfaces {}\n", quality.zones, quality.cells,
                     quality.patches, quality.interfaces) +
         fmt::format("boundary faces: wall {}, symmetry {}, far field {}\n", quality.wall_faces,
                     quality.symmetry_faces, quality.farfield_faces) +
         fmt::format("{:<24}{:>12.5g}\n", "total volume", quality.total_volume) +
         row("smallest volume", quality.min_volume) + row("largest volume", quality.max_volume) +
         row("smallest angle, deg", quality.min_angle_deg) +
         row("smallest determinant", quality.min_determinant) +
         row("largest aspect ratio", quality.max_aspect_ratio) +
         row("largest volume ratio", quality.max_volume_ratio);
}

template MeshQuality<2> measure_quality<2>(const MultiblockMesh<2>&);
template MeshQuality<3> measure_quality<3>(const MultiblockMesh<3>&);
template std::string format_quality<2>(const MultiblockMesh<2>&, const MeshQuality<2>&);
template std::string format_quality<3>(const MultiblockMesh<3>&, const MeshQuality<3>&);

}  // namespace wingbeat
