#include "core/mesh/plot3d.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "core/io/error.hpp"
#include "core/io/file.hpp"
#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/collapse_to_2d.hpp"
#include "core/mesh/find_interfaces.hpp"
#include "core/mesh/interface_transform.hpp"
#include "core/mesh/mesh_check.hpp"
#include "core/mesh/mesh_names.hpp"
#include "core/mesh/reorient.hpp"

namespace wingbeat {
namespace {

constexpr double flatness = 1e-6;  // of a plane, relative to the extent of what is taken to be plane
constexpr std::size_t most_blocks = 100'000;

[[noreturn]] void refuse_token(const std::string& name, const std::string& text, const char* place,
                               std::string_view token) {
  const auto line = 1 + std::count(text.data(), place, '\n');
  throw InputError(fmt::format("{}:{}: '{}' is not a number; a formatted Plot3D file holds numbers only",
                               name, line, token.substr(0, 30)));
}

// A number, its exponent written with E or, as Fortran does, with D.
std::optional<double> as_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  std::string with_e;
  if (text.find_first_of("Dd") != std::string_view::npos) {
    with_e = text;
    std::replace_if(
        with_e.begin(), with_e.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
    text = with_e;
  }
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

// Every number of the text. Fortran's repeat counts (3*0.5) are understood.
std::vector<double> parse_numbers(const std::string& name, const std::string& text) {
  std::vector<double> values;
  const char* place = text.data();
  const char* const end = text.data() + text.size();
  const auto is_space = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == ','; };
  while (true) {
    place = std::find_if_not(place, end, is_space);
    if (place == end) return values;
    const char* const token_end = std::find_if(place, end, is_space);
    const std::string_view token(place, static_cast<std::size_t>(token_end - place));
    const std::size_t star = token.find('*');
    const bool repeated = star != std::string_view::npos;
    const auto repeat = repeated ? as_number(token.substr(0, star)) : 1.0;
    const auto value = as_number(repeated ? token.substr(star + 1) : token);
    if (!value || !repeat || !(*repeat >= 1 && *repeat <= 1e9)) refuse_token(name, text, place, token);
    values.insert(values.end(), static_cast<std::size_t>(*repeat), *value);
    place = token_end;
  }
}

// Where the header ends and how many nodes each block has (third extent 1 in a 2-D file).
struct Layout {
  std::size_t header = 0;
  int coordinates = 2;
  std::vector<Index<3>> nodes;

  std::size_t value_count() const {
    std::size_t count = header;
    for (const Index<3>& n : nodes) count += box_of<3>(n).size() * static_cast<std::size_t>(coordinates);
    return count;
  }
};

std::optional<int> as_count(std::span<const double> values, std::size_t position) {
  if (position >= values.size()) return std::nullopt;
  const double value = values[position];
  if (!(value >= 1 && value <= 1e8 && value == std::floor(value))) return std::nullopt;
  return static_cast<int>(value);
}

// The header read as one with or without a count of blocks, of 2 or 3 dimensions.
std::optional<Layout> read_layout(std::span<const double> values, bool counted, int coordinates) {
  Layout layout;
  layout.coordinates = coordinates;
  std::size_t blocks = 1;
  if (counted) {
    const auto count = as_count(values, layout.header++);
    if (!count || static_cast<std::size_t>(*count) > most_blocks) return std::nullopt;
    blocks = static_cast<std::size_t>(*count);
  }
  for (std::size_t b = 0; b < blocks; ++b) {
    Index<3> nodes{1, 1, 1};
    for (std::size_t d = 0; d < static_cast<std::size_t>(coordinates); ++d) {
      const auto count = as_count(values, layout.header++);
      if (!count) return std::nullopt;
      nodes[d] = *count;
    }
    layout.nodes.push_back(nodes);
  }
  return layout;
}

Layout find_layout(const std::string& name, std::span<const double> values) {
  std::string tried;
  for (bool counted : {true, false})
    for (int coordinates : {2, 3}) {
      const auto layout = read_layout(values, counted, coordinates);
      if (!layout) continue;
      if (layout->value_count() == values.size()) return *layout;
      tried += fmt::format("\n  as {}-D {} a count of blocks: {} values", coordinates,
                           counted ? "with" : "without", layout->value_count());
    }
  throw InputError(fmt::format("{}: holds {} values, which fits no formatted Plot3D mesh without IBLANK{}",
                               name, values.size(),
                               tried.empty() ? ": it does not begin with counts of nodes" : tried));
}

// Blocks of the file as zones of `Dim` dimensions, from the given coordinates of each node.
template <int Dim>
MultiblockMesh<Dim> make_zones(const std::string& name, const Layout& layout,
                               std::span<const double> values) {
  MultiblockMesh<Dim> mesh;
  const double* block = values.data() + layout.header;
  for (const Index<3>& extents : layout.nodes) {
    Zone<Dim> zone;
    zone.name = fmt::format("block-{}", mesh.zones.size() + 1);
    Index<Dim> nodes{};
    for (std::size_t d = 0; d < Dim; ++d) {
      nodes[d] = extents[d];
      zone.cells[d] = extents[d] - 1;
      if (nodes[d] < 2)
        throw InputError(fmt::format("{}: zone '{}': has 1 node in direction {}; at least 2 are needed", name,
                                     zone.name, "ijk"[d]));
    }
    zone.nodes = BlockArray<Vec<double, Dim>, Dim>(nodes, 0);
    const std::size_t count = box_of<Dim>(nodes).size();
    std::size_t n = 0;
    for_each<Dim>(zone.nodes.interior(), [&](const Index<Dim>& node) {
      for (std::size_t c = 0; c < Dim; ++c) zone.nodes(node)[static_cast<int>(c)] = block[c * count + n];
      ++n;
    });
    block += count * static_cast<std::size_t>(layout.coordinates);
    mesh.zones.push_back(std::move(zone));
  }
  return mesh;
}

// Refuses a plane of nodes in a 3-D file unless its z is constant.
void check_plane(const std::string& name, const Layout& layout, std::span<const double> values) {
  const double* block = values.data() + layout.header;
  for (std::size_t b = 0; b < layout.nodes.size(); ++b) {
    const std::size_t count = box_of<3>(layout.nodes[b]).size();
    const auto [x_low, x_high] = std::minmax_element(block, block + count);
    const auto [z_low, z_high] = std::minmax_element(block + 2 * count, block + 3 * count);
    if (!(*z_high - *z_low <= flatness * (*x_high - *x_low)))
      throw InputError(fmt::format(
          "{}: zone 'block-{}': has one node in direction k, but its z is not constant", name, b + 1));
    block += 3 * count;
  }
}

// Whether the nodes of one layer have the same coordinate c, measured by `extent`.
bool is_level(const Zone<3>& zone, const Box<3>& layer, int c, double extent) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for_each<3>(layer, [&](const Index<3>& node) {
    low = std::min(low, zone.nodes(node)[c]);
    high = std::max(high, zone.nodes(node)[c]);
  });
  return high - low <= flatness * extent;
}

// The direction of one cell between two sides level in a coordinate, or -1.
int flat_direction(const Zone<3>& zone) {
  for (int d : {2, 1, 0}) {
    if (zone.cells[d] != 1) continue;
    Index<3> far{};
    far[d] = 1;
    const Vec<double, 3> span = zone.nodes(far) - zone.nodes(Index<3>{});
    for (int c = 0; c < 3; ++c) {
      const auto level = [&](int end) {
        const Box<3> cells = side_cells<3>(zone.cells, {d, end});
        return is_level(zone, nodes_of_side_cells<3>(zone.cells, {d, end}, cells), c, norm(span));
      };
      if (std::abs(span[c]) > 0.5 * norm(span) && level(0) && level(1)) return d;
    }
  }
  return -1;
}

// Declares the sides of a mesh one cell thick symmetry planes, if it is one.
void mark_symmetry_planes(MultiblockMesh<3>& mesh) {
  std::vector<int> thin;
  for (const Zone<3>& zone : mesh.zones) thin.push_back(flat_direction(zone));
  if (std::count(thin.begin(), thin.end(), -1) > 0) return;
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    for (int end : {0, 1}) {
      const Side side{thin[z], end};
      mesh.zones[z].patches.push_back({end == 0 ? "symmetry" : "symmetry-2", "symmetry",
                                       BoundaryType::symmetry, side,
                                       side_cells<3>(mesh.zones[z].cells, side)});
    }
}

template <int Dim>
MultiblockMesh<Dim> completed(MultiblockMesh<Dim> mesh, const std::string& name) {
  for (const Zone<Dim>& zone : mesh.zones)
    for_each<Dim>(zone.nodes.interior(), [&](const Index<Dim>& node) {
      for (int c = 0; c < Dim; ++c)
        if (!std::isfinite(zone.nodes(node)[c]))
          throw InputError(fmt::format("{}: zone '{}', node {}: coordinates are not finite", name, zone.name,
                                       index_text<Dim>(node)));
    });
  mesh = guess_boundaries(find_interfaces(make_right_handed(std::move(mesh)), name), name);
  validate(mesh, name);
  return mesh;
}

}  // namespace

AnyMesh read_plot3d(const std::filesystem::path& path) {
  const std::string name = path.string();
  const std::vector<double> values = parse_numbers(name, read_file(path));
  const Layout layout = find_layout(name, values);
  const bool is_plane =
      std::all_of(layout.nodes.begin(), layout.nodes.end(), [](const Index<3>& n) { return n[2] == 1; });
  if (is_plane && layout.coordinates == 3) check_plane(name, layout, values);
  if (is_plane) return completed(make_zones<2>(name, layout, values), name);

  MultiblockMesh<3> mesh = make_zones<3>(name, layout, values);
  mark_symmetry_planes(mesh);
  if (auto plane = collapse_to_2d(mesh, name)) return completed(std::move(*plane), name);
  return completed(std::move(mesh), name);
}

template <int Dim>
void write_plot3d(const MultiblockMesh<Dim>& mesh, const std::filesystem::path& path) {
  std::string text = fmt::format("{}\n", mesh.zones.size());
  auto out = std::back_inserter(text);
  for (const Zone<Dim>& zone : mesh.zones) {
    for (int d = 0; d < Dim; ++d) fmt::format_to(out, "{}{}", zone.cells[d] + 1, d + 1 < Dim ? " " : "\n");
  }
  for (const Zone<Dim>& zone : mesh.zones)
    for (int c = 0; c < Dim; ++c)
      for_each<Dim>(zone.nodes.interior(),
                    [&](const Index<Dim>& node) { fmt::format_to(out, "{:.17g}\n", zone.nodes(node)[c]); });
  write_file(path, text);
}

template void write_plot3d<2>(const MultiblockMesh<2>&, const std::filesystem::path&);
template void write_plot3d<3>(const MultiblockMesh<3>&, const std::filesystem::path&);

}  // namespace wingbeat
