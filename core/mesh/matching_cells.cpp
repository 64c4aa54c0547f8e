#include "core/mesh/matching_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "core/mesh/cell_geometry.hpp"

namespace wingbeat {
namespace {

template <int Dim>
std::vector<Vec<double, Dim>> cell_centres(const MultiblockMesh<Dim>& mesh) {
  std::vector<Vec<double, Dim>> centres;
  centres.reserve(mesh.cell_count());
  for (const Zone<Dim>& zone : mesh.zones)
    for_each<Dim>(box_of<Dim>(zone.cells),
                  [&](const Index<Dim>& cell) { centres.push_back(cell_centre<Dim>(zone, cell)); });
  return centres;
}

// Cells by the box of a fine grid in space that their centres lie in.
template <int Dim>
class PlaceIndex {
 public:
  PlaceIndex(std::vector<Vec<double, Dim>> places, double tolerance)
      : places_(std::move(places)), tolerance_(tolerance) {
    for (std::size_t i = 0; i < places_.size(); ++i)
      cells_.emplace(key(box(places_[i])), static_cast<long>(i));
  }

  // The one cell there; -1 where there is none.
  long at(const Vec<double, Dim>& place) const {
    const auto middle = box(place);
    int neighbours = 1;
    for (int d = 0; d < Dim; ++d) neighbours *= 3;
    for (int n = 0; n < neighbours; ++n) {
      auto near = middle;
      for (int d = 0, rest = n; d < Dim; ++d, rest /= 3) near[static_cast<std::size_t>(d)] += rest % 3 - 1;
      const auto [first, last] = cells_.equal_range(key(near));
      const auto found = std::find_if(first, last, [&](const auto& entry) {
        return is_near(places_[static_cast<std::size_t>(entry.second)], place);
      });
      if (found != last) return found->second;
    }
    return -1;
  }

 private:
  using Boxes = std::array<long, Dim>;

  Boxes box(const Vec<double, Dim>& place) const {
    Boxes result{};
    for (int d = 0; d < Dim; ++d) result[static_cast<std::size_t>(d)] = std::lround(place[d] / tolerance_);
    return result;
  }
  static std::size_t key(const Boxes& box) {
    std::size_t mixed = 0;
    for (const long number : box) mixed = mixed * 0x9e3779b97f4a7c15u + static_cast<std::size_t>(number);
    return mixed;
  }
  bool is_near(const Vec<double, Dim>& a, const Vec<double, Dim>& b) const {
    for (int d = 0; d < Dim; ++d)
      if (!(std::abs(a[d] - b[d]) <= tolerance_)) return false;
    return true;
  }

  std::vector<Vec<double, Dim>> places_;
  double tolerance_;
  std::unordered_multimap<std::size_t, long> cells_;
};

}  // namespace

template <int Dim>
std::optional<std::vector<long>> matching_cells(const MultiblockMesh<Dim>& from,
                                                const MultiblockMesh<Dim>& to, double tolerance) {
  if (from.cell_count() != to.cell_count()) return std::nullopt;
  const PlaceIndex<Dim> index(cell_centres(from), tolerance);
  std::vector<long> cells;
  std::vector<char> is_taken(from.cell_count(), 0);
  for (const auto& place : cell_centres(to)) {
    const long cell = index.at(place);
    if (cell < 0 || is_taken[static_cast<std::size_t>(cell)]) return std::nullopt;
    is_taken[static_cast<std::size_t>(cell)] = 1;
    cells.push_back(cell);
  }
  return cells;
}

template std::optional<std::vector<long>> matching_cells<2>(const MultiblockMesh<2>&,
                                                            const MultiblockMesh<2>&, double);
template std::optional<std::vector<long>> matching_cells<3>(const MultiblockMesh<3>&,
                                                            const MultiblockMesh<3>&, double);

}  // namespace wingbeat
