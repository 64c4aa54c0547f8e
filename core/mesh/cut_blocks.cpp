#include "core/mesh/cut_blocks.hpp"

#include <algorithm>
#include <climits>
#include <optional>
#include <string>

#include "core/io/error.hpp"
#include "core/mesh/interface_transform.hpp"

namespace wingbeat {

namespace {

// A piece of a zone of the mesh that is cut.
template <int Dim>
struct Piece {
  int zone = 0;  // of the uncut mesh
  Box<Dim> cells;
  std::string name;
};

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
                                          const std::vector<Piece<Dim>>& pieces, int donor_number) {
  const Piece<Dim>& donor = pieces[static_cast<std::size_t>(donor_number)];
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
  part.donor = donor_number;
  part.donor_origin = donor_node<Dim>(interface, nodes.begin);
  for (int d = 0; d < Dim; ++d) part.donor_origin[d] -= donor.cells.begin[d];
  return part;
}

template <int Dim>
void add_divided_interfaces(const MultiblockMesh<Dim>& mesh, const std::vector<Piece<Dim>>& pieces,
                            const Piece<Dim>& piece, Zone<Dim>& zone) {
  for (const auto& interface : mesh.zones[static_cast<std::size_t>(piece.zone)].interfaces) {
    const std::size_t first = zone.interfaces.size();
    for (std::size_t donor = 0; donor < pieces.size(); ++donor) {
      if (pieces[donor].zone != interface.donor) continue;
      if (const auto part = common_part(interface, piece, pieces, static_cast<int>(donor)))
        zone.interfaces.push_back(*part);
    }
    if (zone.interfaces.size() - first > 1)
      for (std::size_t k = first; k < zone.interfaces.size(); ++k)
        zone.interfaces[k].name.append("-").append(std::to_string(k - first + 1));
  }
}

// Connections to the other pieces of the same zone.
template <int Dim>
void add_cut_interfaces(const std::vector<Piece<Dim>>& pieces, std::size_t number, Zone<Dim>& zone) {
  const Piece<Dim>& piece = pieces[number];
  for (std::size_t other = 0; other < pieces.size(); ++other) {
    if (other == number || pieces[other].zone != piece.zone) continue;
    for (int d = 0; d < Dim; ++d)
      for (int end = 0; end < 2; ++end) {
        const Side side{d, end}, donor_side{d, 1 - end};
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

// Pieces of `minimum_width` that fit into a box.
template <int Dim>
std::size_t capacity(const Box<Dim>& box, int minimum_width) {
  std::size_t pieces = 1;
  for (int d = 0; d < Dim; ++d)
    pieces *= static_cast<std::size_t>(std::max(1, box.extent(d) / std::max(1, minimum_width)));
  return pieces;
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
      if (static_cast<std::size_t>(shares[z]) < capacity(box, minimum_width) && size > largest_size)
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

template <int Dim>
void cut_recursively(const Box<Dim>& box, int count, int minimum_width, std::vector<Box<Dim>>& boxes) {
  if (count == 1) {
    boxes.push_back(box);
    return;
  }
  int direction = 0;
  for (int d = 1; d < Dim; ++d)
    if (box.extent(d) > box.extent(direction)) direction = d;
  for (int d = Dim - 1; d >= 0; --d)
    if (box.extent(d) >= count * minimum_width) direction = d;

  // Each part must be wide enough for its pieces, `per_layer` of them side by side; where both
  // do not fit, the first takes whole layers.
  const int width = box.extent(direction);
  const auto layers = static_cast<std::size_t>(std::max(1, width / minimum_width));
  const int per_layer =
      static_cast<int>(std::min<std::size_t>(capacity(box, minimum_width) / layers, INT_MAX));
  const auto width_for = [&](int pieces) { return ((pieces - 1) / per_layer + 1) * minimum_width; };
  int low_count = count / 2;
  if (width_for(low_count) + width_for(count - low_count) > width) low_count -= low_count % per_layer;
  const int even = static_cast<int>((2L * width * low_count + count) / (2L * count));
  const int position = std::clamp(even, width_for(low_count), width - width_for(count - low_count));

  Box<Dim> low = box, high = box;
  low.end[direction] = high.begin[direction] = box.begin[direction] + position;
  cut_recursively(low, low_count, minimum_width, boxes);
  cut_recursively(high, count - low_count, minimum_width, boxes);
}

}  // namespace

template <int Dim>
std::vector<Box<Dim>> cut_box(const Box<Dim>& box, int count, int minimum_width) {
  ensure(count >= 1 && minimum_width >= 1, "cut_box needs a positive count and width");
  if (static_cast<std::size_t>(count) > capacity(box, minimum_width))
    throw InputError("a block of " + std::to_string(box.size()) + " cells cannot be cut into " +
                     std::to_string(count) + " pieces at least " + std::to_string(minimum_width) +
                     " cells wide; ask for fewer blocks or a finer mesh");
  std::vector<Box<Dim>> boxes;
  cut_recursively(box, count, minimum_width, boxes);
  return boxes;
}

template <int Dim>
MultiblockMesh<Dim> cut_blocks(const MultiblockMesh<Dim>& mesh, int count, int minimum_width) {
  const std::vector<int> shares = share_pieces(mesh, count, minimum_width);
  std::vector<Piece<Dim>> pieces;
  for (std::size_t z = 0; z < mesh.zones.size(); ++z) {
    const auto& zone = mesh.zones[z];
    const auto boxes = cut_box(box_of<Dim>(zone.cells), shares[z], minimum_width);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const std::string name = boxes.size() == 1 ? zone.name : zone.name + "-" + std::to_string(k + 1);
      pieces.push_back({static_cast<int>(z), boxes[k], name});
    }
  }
  MultiblockMesh<Dim> cut;
  for (std::size_t number = 0; number < pieces.size(); ++number) {
    const Piece<Dim>& piece = pieces[number];
    Zone<Dim> zone = cut_zone(mesh.zones[static_cast<std::size_t>(piece.zone)], piece);
    add_divided_interfaces(mesh, pieces, piece, zone);
    add_cut_interfaces(pieces, number, zone);
    cut.zones.push_back(std::move(zone));
  }
  return cut;
}

template std::vector<Box<2>> cut_box(const Box<2>&, int, int);
template std::vector<Box<3>> cut_box(const Box<3>&, int, int);
template MultiblockMesh<2> cut_blocks(const MultiblockMesh<2>&, int, int);
template MultiblockMesh<3> cut_blocks(const MultiblockMesh<3>&, int, int);

}  // namespace wingbeat
