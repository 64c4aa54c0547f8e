#include "core/mesh/cut_blocks.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/io/error.hpp"
#include "core/mesh/coarsen.hpp"
#include "core/mesh/cut_box.hpp"
#include "core/mesh/interface_transform.hpp"

namespace wingbeat {

namespace {

// How much larger than the mean a piece may be for the sake of multigrid.
constexpr double allowed_excess = 0.05;

// A piece of a zone of the mesh that is cut.
template <int Dim>
struct Piece {
  int zone = 0;  // of the uncut mesh
  Box<Dim> cells;
  std::string name;
};

// The pieces that have a side in a plane of nodes of a zone.
struct SidePlane {
  int zone = 0;
  int direction = 0;
  int end = 0;
  int plane = 0;
  friend auto operator<=>(const SidePlane&, const SidePlane&) = default;
};
using PiecesAtPlanes = std::map<SidePlane, std::vector<std::size_t>>;

template <int Dim>
PiecesAtPlanes pieces_at_planes(const std::vector<Piece<Dim>>& pieces) {
  PiecesAtPlanes at;
  for (std::size_t number = 0; number < pieces.size(); ++number)
    for (int d = 0; d < Dim; ++d) {
      const auto& [zone, cells, name] = pieces[number];
      at[{zone, d, 0, cells.begin[d]}].push_back(number);
      at[{zone, d, 1, cells.end[d]}].push_back(number);
    }
  return at;
}

std::span<const std::size_t> touching(const PiecesAtPlanes& at, const SidePlane& side) {
  const auto found = at.find(side);
  return found == at.end() ? std::span<const std::size_t>{} : found->second;
}

template <int Dim>
Box<Dim> intersection(const Box<Dim>& a, const Box<Dim>& b) {
  Box<Dim> common;
  for (int d = 0; d < Dim; ++d) {
    common.begin[d] = std::max(a.begin[d], b.begin[d]);
    common.end[d] = std::min(a.end[d], b.end[d]);
  }
  return common;
}

template <int Dim>
Box<Dim> shifted(Box<Dim> box, const Index<Dim>& origin) {
  for (int d = 0; d < Dim; ++d) box.begin[d] -= origin[d], box.end[d] -= origin[d];
  return box;
}

// Nodes of one side of a box of cells.
template <int Dim>
Box<Dim> side_nodes(Box<Dim> cells, const Side& side) {
  for (int d = 0; d < Dim; ++d) ++cells.end[d];
  int& begin = cells.begin[side.direction];
  int& end = cells.end[side.direction];
  (side.end == 0 ? end : begin) = side.end == 0 ? begin + 1 : end - 1;
  return cells;
}

// Whether a box of nodes normal to `direction` spans at least one face.
template <int Dim>
bool spans_a_face(const Box<Dim>& nodes, int direction) {
  for (int d = 0; d < Dim; ++d)
    if (nodes.extent(d) < (d == direction ? 1 : 2)) return false;
  return true;
}

// The part of an interface between two pieces, in their own indices; none if they share no face.
template <int Dim>
std::optional<Interface<Dim>> common_part(const Interface<Dim>& interface, const Piece<Dim>& piece,
                                          const std::vector<Piece<Dim>>& pieces, std::size_t donor_number) {
  const Piece<Dim>& donor = pieces[donor_number];
  const Box<Dim> own = intersection(interface.nodes, side_nodes(piece.cells, interface.side));
  if (!spans_a_face(own, interface.side.direction)) return std::nullopt;
  const Interface<Dim> back = reversed(interface, piece.zone, interface.name);
  const Box<Dim> offered = side_nodes(donor.cells, interface.donor_side);
  const Box<Dim> seen =
      box_between<Dim>(donor_node<Dim>(back, offered.begin), donor_node<Dim>(back, last_index(offered)));
  const Box<Dim> nodes = intersection(own, seen);
  if (!spans_a_face(nodes, interface.side.direction)) return std::nullopt;
  Interface<Dim> part = interface;
  part.nodes = shifted<Dim>(nodes, piece.cells.begin);
  part.donor = static_cast<int>(donor_number);
  part.donor_origin = donor_node<Dim>(interface, nodes.begin);
  for (int d = 0; d < Dim; ++d) part.donor_origin[d] -= donor.cells.begin[d];
  return part;
}

template <int Dim>
void add_divided_interfaces(const MultiblockMesh<Dim>& mesh, const std::vector<Piece<Dim>>& pieces,
                            const PiecesAtPlanes& at, const Piece<Dim>& piece, Zone<Dim>& zone) {
  for (const auto& interface : mesh.zones[static_cast<std::size_t>(piece.zone)].interfaces) {
    const std::size_t first = zone.interfaces.size();
    const auto& [direction, end] = interface.donor_side;
    for (const std::size_t donor :
         touching(at, {interface.donor, direction, end, interface.donor_origin[direction]}))
      if (const auto part = common_part(interface, piece, pieces, donor)) zone.interfaces.push_back(*part);
    if (zone.interfaces.size() - first > 1)
      for (std::size_t k = first; k < zone.interfaces.size(); ++k)
        zone.interfaces[k].name.append("-").append(std::to_string(k - first + 1));
  }
}

// Connections to the other pieces of the same zone.
template <int Dim>
void add_cut_interfaces(const std::vector<Piece<Dim>>& pieces, const PiecesAtPlanes& at, std::size_t number,
                        Zone<Dim>& zone) {
  const Piece<Dim>& piece = pieces[number];
  for (int d = 0; d < Dim; ++d)
    for (int end = 0; end < 2; ++end) {
      const Side side{d, end}, donor_side{d, 1 - end};
      const int plane = end == 0 ? piece.cells.begin[d] : piece.cells.end[d];
      for (const std::size_t other : touching(at, {piece.zone, d, 1 - end, plane})) {
        const Box<Dim> nodes =
            intersection(side_nodes(piece.cells, side), side_nodes(pieces[other].cells, donor_side));
        if (!spans_a_face(nodes, d)) continue;
        Interface<Dim> cut;
        cut.name = "to-" + pieces[other].name;
        cut.side = side;
        cut.nodes = shifted<Dim>(nodes, piece.cells.begin);
        cut.donor = static_cast<int>(other);
        cut.donor_side = donor_side;
        cut.donor_origin = shifted<Dim>(nodes, pieces[other].cells.begin).begin;
        for (int axis = 0; axis < Dim; ++axis) cut.axis[axis] = axis, cut.sign[axis] = 1;
        zone.interfaces.push_back(cut);
      }
    }
}

template <int Dim>
Zone<Dim> cut_zone(const Zone<Dim>& whole, const Piece<Dim>& piece) {
  Zone<Dim> zone;
  zone.name = piece.name;
  Index<Dim> node_extents;
  for (int d = 0; d < Dim; ++d) {
    zone.cells[d] = piece.cells.extent(d);
    node_extents[d] = zone.cells[d] + 1;
  }
  zone.nodes = BlockArray<Vec<double, Dim>, Dim>(node_extents, whole.nodes.halo());
  for_each(box_of<Dim>(node_extents), [&](const Index<Dim>& index) {
    Index<Dim> source = index;
    for (int d = 0; d < Dim; ++d) source[d] += piece.cells.begin[d];
    zone.nodes(index) = whole.nodes(source);
  });
  for (const auto& patch : whole.patches) {
    const Box<Dim> cells = intersection(patch.cells, piece.cells);
    if (cells.size() == 0) continue;
    zone.patches.push_back(patch);
    zone.patches.back().cells = shifted<Dim>(cells, piece.cells.begin);
  }
  return zone;
}

// Number of pieces for each zone: the next one always goes where pieces are largest.
template <int Dim>
std::vector<int> share_pieces(const MultiblockMesh<Dim>& mesh, int count, int minimum_width) {
  const std::size_t zones = mesh.zones.size();
  if (count < static_cast<int>(zones))
    throw InputError(std::to_string(count) + " blocks asked of a mesh with " + std::to_string(zones) +
                     " zones; zones are cut, never joined: ask for at least " + std::to_string(zones));
  std::vector<int> shares(zones, 1);
  for (int given = static_cast<int>(zones); given < count; ++given) {
    std::size_t largest = zones;
    double largest_size = 0.0;
    for (std::size_t z = 0; z < zones; ++z) {
      const Box<Dim> box = box_of<Dim>(mesh.zones[z].cells);
      const double size = static_cast<double>(box.size()) / shares[z];
      if (static_cast<std::size_t>(shares[z]) < cut_capacity(box, minimum_width) && size > largest_size)
        largest = z, largest_size = size;
    }
    if (largest == zones)
      throw InputError(std::to_string(count) + " blocks asked of a mesh that can be cut into " +
                       std::to_string(given) + " at most, each at least " + std::to_string(minimum_width) +
                       " cells wide; ask for fewer blocks or a finer mesh");
    ++shares[largest];
  }
  return shares;
}

// The box of a zone cut at planes that a coarser mesh keeps; none where pieces would be too uneven.
template <int Dim>
std::vector<Box<Dim>> cut_coarse_box(const Index<Dim>& cells, const Index<Dim>& coarse, int count,
                                     int minimum_width) {
  Index<Dim> ratio;
  for (int d = 0; d < Dim; ++d) ratio[d] = cells[d] / coarse[d];
  // Directions of one cell, which alone may have another ratio, are not cut.
  const int coarse_width = (minimum_width - 1) / *std::max_element(ratio.begin(), ratio.end()) + 1;
  if (static_cast<std::size_t>(count) > cut_capacity(box_of<Dim>(coarse), coarse_width)) return {};
  std::vector<Box<Dim>> boxes = cut_box(box_of<Dim>(coarse), count, coarse_width);
  for (Box<Dim>& box : boxes)
    for (int d = 0; d < Dim; ++d) box.begin[d] *= ratio[d], box.end[d] *= ratio[d];
  const double mean = static_cast<double>(box_of<Dim>(cells).size()) / count;
  const bool even = std::all_of(boxes.begin(), boxes.end(), [&](const Box<Dim>& box) {
    return static_cast<double>(box.size()) <= (1.0 + allowed_excess) * mean;
  });
  return even ? boxes : std::vector<Box<Dim>>{};
}

// Zone z of the mesh in `count` boxes that can be halved as often as evenness allows; `coarser` are
// the meshes of every second node, the finest first.
template <int Dim>
std::vector<Box<Dim>> cut_for_multigrid(const MultiblockMesh<Dim>& mesh,
                                        const std::vector<MultiblockMesh<Dim>>& coarser, std::size_t z,
                                        int count, int minimum_width) {
  const Index<Dim>& cells = mesh.zones[z].cells;
  for (auto coarse = coarser.rbegin(); coarse != coarser.rend(); ++coarse)
    if (auto boxes = cut_coarse_box<Dim>(cells, coarse->zones[z].cells, count, minimum_width); !boxes.empty())
      return boxes;
  return cut_box(box_of<Dim>(cells), count, minimum_width);
}

}  // namespace

template <int Dim>
MultiblockMesh<Dim> cut_blocks(const MultiblockMesh<Dim>& mesh, int count, int minimum_width) {
  const std::vector<int> shares = share_pieces(mesh, count, minimum_width);
  std::vector<MultiblockMesh<Dim>> coarser;
  while (auto next = coarsened(coarser.empty() ? mesh : coarser.back(), 1))
    coarser.push_back(std::move(*next));
  std::vector<Piece<Dim>> pieces;
  for (std::size_t z = 0; z < mesh.zones.size(); ++z) {
    const auto& zone = mesh.zones[z];
    const auto boxes = cut_for_multigrid(mesh, coarser, z, shares[z], minimum_width);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const std::string name = boxes.size() == 1 ? zone.name : zone.name + "-" + std::to_string(k + 1);
      pieces.push_back({static_cast<int>(z), boxes[k], name});
    }
  }
  const PiecesAtPlanes at = pieces_at_planes(pieces);
  MultiblockMesh<Dim> cut;
  for (std::size_t number = 0; number < pieces.size(); ++number) {
    const Piece<Dim>& piece = pieces[number];
    Zone<Dim> zone = cut_zone(mesh.zones[static_cast<std::size_t>(piece.zone)], piece);
    add_divided_interfaces(mesh, pieces, at, piece, zone);
    add_cut_interfaces(pieces, at, number, zone);
    cut.zones.push_back(std::move(zone));
  }
  return cut;
}

template MultiblockMesh<2> cut_blocks(const MultiblockMesh<2>&, int, int);
template MultiblockMesh<3> cut_blocks(const MultiblockMesh<3>&, int, int);

}  // namespace wingbeat
