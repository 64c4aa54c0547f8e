#include "core/mesh/find_interfaces.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "core/io/error.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/mesh_check.hpp"
#include "core/mesh/mesh_names.hpp"
#include "core/mesh/side_faces.hpp"

namespace wingbeat {
namespace {

template <int Dim>
std::string face_text(const MultiblockMesh<Dim>& mesh, const SideFace<Dim>& face) {
  return fmt::format("zone '{}', side {}, cell {}", mesh.zones[face.zone].name, to_string(face.side),
                     index_text<Dim>(face.cell));
}

template <int Dim>
std::vector<double> face_tolerances(const MultiblockMesh<Dim>& mesh, const std::vector<SideFace<Dim>>& faces,
                                    const std::string& source) {
  std::vector<double> tolerances;
  for (const SideFace<Dim>& face : faces) {
    const double edge = shortest_edge(mesh, face);
    if (!(edge > 0))
      throw InputError(
          fmt::format("{}: {}: the side collapses to a line or a point there, which is not supported", source,
                      face_text(mesh, face)));
    tolerances.push_back(interface_tolerance * edge);
  }
  return tolerances;
}

// The one-face interface that joins two faces node by node, if one does.
template <int Dim>
std::optional<Interface<Dim>> joined(const MultiblockMesh<Dim>& mesh, const SideFace<Dim>& face,
                                     const SideFace<Dim>& other, double tolerance) {
  Interface<Dim> trial;
  trial.side = face.side;
  trial.nodes = face_nodes<Dim>(mesh, face);
  trial.donor = other.zone;
  trial.donor_side = other.side;
  const Box<Dim> donor = face_nodes<Dim>(mesh, other);
  const int normal = face.side.direction;
  Index<Dim> axis{};
  std::iota(axis.begin(), axis.end(), 0);
  do {
    if (axis[normal] != other.side.direction) continue;
    for (int signs = 0; signs < 1 << Dim; ++signs) {
      trial.axis = axis;
      for (int d = 0; d < Dim; ++d) {
        trial.sign[d] = (signs >> d & 1) != 0 ? -1 : 1;
        trial.donor_origin[axis[d]] = trial.sign[d] > 0 ? donor.begin[axis[d]] : donor.end[axis[d]] - 1;
      }
      if (trial.sign[normal] != normal_sign(trial.side, trial.donor_side)) continue;
      bool match = true;
      for_each<Dim>(trial.nodes, [&](const Index<Dim>& node) {
        const auto& here = mesh.zones[face.zone].nodes(node);
        const auto& there = mesh.zones[other.zone].nodes(donor_node<Dim>(trial, node));
        match = match && norm(there - here) <= tolerance;
      });
      if (match) return trial;
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return std::nullopt;
}

// A face and the face it meets, if any.
template <int Dim>
struct Match {
  int partner = -1;
  Interface<Dim> link;
};

template <int Dim>
std::vector<Match<Dim>> match_faces(const MultiblockMesh<Dim>& mesh, const std::vector<SideFace<Dim>>& faces,
                                    const std::string& source) {
  const std::vector<double> tolerances = face_tolerances(mesh, faces, source);
  std::vector<Vec<double, Dim>> centres;
  for (const SideFace<Dim>& face : faces) {
    Vec<double, Dim> sum{};
    const Box<Dim> nodes = face_nodes<Dim>(mesh, face);
    for_each<Dim>(nodes, [&](const Index<Dim>& node) { sum += mesh.zones[face.zone].nodes(node); });
    centres.push_back((1.0 / static_cast<double>(nodes.size())) * sum);
  }
  std::vector<Match<Dim>> matches(faces.size());
  for (const auto& [a, b] : coincident_pairs<Dim>(centres, tolerances)) {
    const auto link = joined(mesh, faces[a], faces[b], tolerances[a]);
    if (!link) continue;
    for (int f : {a, b})
      if (matches[f].partner >= 0)
        throw InputError(fmt::format("{}: {}: three faces coincide here", source, face_text(mesh, faces[f])));
    matches[a] = {b, *link};
    matches[b] = {a, reversed(*link, faces[a].zone, "")};
  }
  return matches;
}

// Whether two links are parts of one interface: the same map of indices.
template <int Dim>
bool is_continued(const Interface<Dim>& a, const Interface<Dim>& b) {
  return a.donor == b.donor && a.donor_side == b.donor_side && a.axis == b.axis && a.sign == b.sign &&
         donor_node<Dim>(a, b.nodes.begin) == b.donor_origin;
}

// Number of each face by its place on a side.
template <int Dim>
class FaceIndex {
 public:
  explicit FaceIndex(const std::vector<SideFace<Dim>>& faces) {
    for (std::size_t f = 0; f < faces.size(); ++f) numbers_[key(faces[f])] = static_cast<int>(f);
  }
  int find(const SideFace<Dim>& face) const {
    const auto found = numbers_.find(key(face));
    return found == numbers_.end() ? -1 : found->second;
  }

 private:
  using Key = std::tuple<int, int, int, Index<Dim>>;
  static Key key(const SideFace<Dim>& face) {
    return {face.zone, face.side.direction, face.side.end, face.cell};
  }
  std::map<Key, int> numbers_;
};

// Surfaces made of faces that share nodes: the number of each face's surface.
template <int Dim>
std::vector<int> connected_surfaces(const MultiblockMesh<Dim>& mesh, const std::vector<SideFace<Dim>>& faces,
                                    const std::vector<double>& face_tolerance) {
  std::vector<Vec<double, Dim>> points;
  std::vector<double> tolerances;
  std::vector<int> owner;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for_each<Dim>(face_nodes<Dim>(mesh, faces[f]), [&](const Index<Dim>& node) {
      points.push_back(mesh.zones[faces[f].zone].nodes(node));
      tolerances.push_back(face_tolerance[f]);
      owner.push_back(static_cast<int>(f));
    });
  std::vector<int> root(faces.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int f) {
    while (root[f] != f) f = root[f] = root[root[f]];
    return f;
  };
  for (const auto& [a, b] : coincident_pairs<Dim>(points, tolerances)) {
    const int first = find(owner[a]);
    const int second = find(owner[b]);
    root[std::max(first, second)] = std::min(first, second);
  }
  std::vector<int> surface;
  for (std::size_t f = 0; f < faces.size(); ++f) surface.push_back(find(static_cast<int>(f)));
  return surface;
}

template <int Dim>
struct Extents {
  Vec<double, Dim> low;
  Vec<double, Dim> high;
  Extents() {
    low.components.fill(std::numeric_limits<double>::infinity());
    high.components.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const Vec<double, Dim>& x) {
    for (int d = 0; d < Dim; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  }
};

// The surface with the largest bounding box.
template <int Dim>
int outermost(const MultiblockMesh<Dim>& mesh, const std::vector<SideFace<Dim>>& faces,
              const std::vector<int>& surface) {
  std::map<int, Extents<Dim>> extents;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for_each<Dim>(face_nodes<Dim>(mesh, faces[f]), [&](const Index<Dim>& node) {
      extents[surface[f]].add(mesh.zones[faces[f].zone].nodes(node));
    });
  const auto size = [](const auto& entry) { return norm(entry.second.high - entry.second.low); };
  return std::max_element(extents.begin(), extents.end(),
                          [&](const auto& a, const auto& b) { return size(a) < size(b); })
      ->first;
}

}  // namespace

template <int Dim>
MultiblockMesh<Dim> find_interfaces(MultiblockMesh<Dim> mesh, const std::string& source) {
  const std::vector<SideFace<Dim>> faces = uncovered_faces(mesh);
  const std::vector<Match<Dim>> matches = match_faces(mesh, faces, source);
  const FaceIndex<Dim> numbers(faces);
  std::vector<char> taken(faces.size(), 0);

  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (taken[f] || matches[f].partner < 0) continue;
    const SideFace<Dim>& face = faces[f];
    // A face is taken together with its partner: a side folded onto itself is cut at the fold.
    const auto mark = [&](int number, char value) { taken[number] = taken[matches[number].partner] = value; };
    const auto claim = [&](const Index<Dim>& cell) {
      const int next = numbers.find({face.zone, face.side, cell});
      if (next < 0 || taken[next] || matches[next].partner < 0) return false;
      if (!is_continued(matches[f].link, matches[next].link)) return false;
      mark(next, 1);
      return true;
    };
    const auto release = [&](const Index<Dim>& cell) { mark(numbers.find({face.zone, face.side, cell}), 0); };
    mark(static_cast<int>(f), 1);
    Zone<Dim>& zone = mesh.zones[face.zone];
    const Box<Dim> cells = grow_along_side<Dim>(face.cell, face.side, zone.cells, claim, release);

    Interface<Dim> connection = matches[f].link;
    connection.nodes = nodes_of_side_cells<Dim>(zone.cells, face.side, cells);
    connection.name = fmt::format("connection-{}", zone.interfaces.size() + 1);
    zone.interfaces.push_back(connection);
    Zone<Dim>& donor = mesh.zones[connection.donor];
    donor.interfaces.push_back(
        reversed(connection, face.zone, fmt::format("connection-{}", donor.interfaces.size() + 1)));
  }
  return mesh;
}

template <int Dim>
MultiblockMesh<Dim> guess_boundaries(MultiblockMesh<Dim> mesh, const std::string& source) {
  const std::vector<SideFace<Dim>> faces = uncovered_faces(mesh);
  if (faces.empty()) return mesh;
  const std::vector<int> surface = connected_surfaces(mesh, faces, face_tolerances(mesh, faces, source));
  const int outer = outermost(mesh, faces, surface);
  if (std::all_of(surface.begin(), surface.end(), [&](int s) { return s == outer; }))
    throw InputError(
        source +
        ": the file states no boundary conditions, and the mesh has a single boundary surface, so that "
        "wall and far field cannot be told apart; convert it to CGNS with boundary conditions");

  const FaceIndex<Dim> numbers(faces);
  std::vector<char> taken(faces.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (taken[f]) continue;
    const SideFace<Dim>& face = faces[f];
    const auto claim = [&](const Index<Dim>& cell) {
      const int next = numbers.find({face.zone, face.side, cell});
      if (next < 0 || taken[next] || surface[next] != surface[f]) return false;
      return (taken[next] = 1) != 0;
    };
    const auto release = [&](const Index<Dim>& cell) {
      taken[numbers.find({face.zone, face.side, cell})] = 0;
    };
    taken[f] = 1;
    Zone<Dim>& zone = mesh.zones[face.zone];
    const bool is_outer = surface[f] == outer;
    const std::string family = is_outer ? "farfield" : "wall";
    const auto alike = std::count_if(zone.patches.begin(), zone.patches.end(),
                                     [&](const BoundaryPatch<Dim>& patch) { return patch.family == family; });
    zone.patches.push_back({alike == 0 ? family : fmt::format("{}-{}", family, alike + 1), family,
                            is_outer ? BoundaryType::farfield : BoundaryType::slip_wall, face.side,
                            grow_along_side<Dim>(face.cell, face.side, zone.cells, claim, release)});
  }
  return mesh;
}

template MultiblockMesh<2> find_interfaces<2>(MultiblockMesh<2>, const std::string&);
template MultiblockMesh<3> find_interfaces<3>(MultiblockMesh<3>, const std::string&);
template MultiblockMesh<2> guess_boundaries<2>(MultiblockMesh<2>, const std::string&);
template MultiblockMesh<3> guess_boundaries<3>(MultiblockMesh<3>, const std::string&);

}  // namespace wingbeat
