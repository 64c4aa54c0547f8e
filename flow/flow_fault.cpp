#include "flow/flow_fault.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "core/mesh/cell_geometry.hpp"
#include "core/mesh/mesh_names.hpp"

namespace wingbeat {
namespace {

// A cell of an instance, and what is wrong with it.
struct Fault {
  std::size_t instance = 0;
  std::size_t cell = 0;
  double density = 0.0, pressure = 0.0;
  bool is_of_residual = false;
};

template <int Dim>
State<Dim, double> state_at(std::span<const double> w, std::size_t first) {
  State<Dim, double> state;
  for (int v = 0; v < state_size<Dim>; ++v) state[v] = w[first + static_cast<std::size_t>(v)];
  return state;
}

template <int Dim>
std::optional<Fault> first_fault(std::span<const double> w, std::span<const double> r, std::size_t cells,
                                 double gamma) {
  constexpr std::size_t n = state_size<Dim>;
  const auto fault_at = [&](std::size_t first, bool is_of_residual) {
    const auto state = state_at<Dim>(w, first);
    const std::size_t position = first / n;
    return Fault{position / cells, position % cells, state[0], pressure<Dim, double>(state, gamma),
                 is_of_residual};
  };
  for (std::size_t first = 0; first < w.size(); first += n) {
    const Fault fault = fault_at(first, false);
    const bool is_finite = std::isfinite(fault.density) && std::isfinite(fault.pressure);
    if (!is_finite || !(fault.density > 0.0 && fault.pressure > 0.0)) return fault;
  }
  for (std::size_t i = 0; i < r.size(); ++i)
    if (!std::isfinite(r[i])) return fault_at(i / n * n, true);
  return std::nullopt;
}

// `fault.cell` counts the cells of the whole mesh.
template <int Dim>
std::string text_of(const MultiblockMesh<Dim>& mesh, const Fault& fault, std::size_t instances) {
  std::size_t number = fault.cell, z = 0;
  for (; number >= box_of<Dim>(mesh.zones[z].cells).size(); ++z)
    number -= box_of<Dim>(mesh.zones[z].cells).size();
  const Zone<Dim>& zone = mesh.zones[z];
  Index<Dim> cell{};
  for (int d = 0; d < Dim; ++d) {
    cell[d] = static_cast<int>(number % static_cast<std::size_t>(zone.cells[d]));
    number /= static_cast<std::size_t>(zone.cells[d]);
  }
  const Vec<double, Dim> place = cell_centre<Dim>(zone, cell);
  std::string at;
  for (int d = 0; d < Dim; ++d) at += fmt::format("{} {} = {:.6g}", d == 0 ? "" : ",", "xyz"[d], place[d]);
  return fmt::format("instance {} of {}, block \"{}\", cell {} at{}: density {:.6g}, pressure {:.6g}{}",
                     fault.instance + 1, instances, zone.name, index_text<Dim>(cell), at, fault.density,
                     fault.pressure, fault.is_of_residual ? ", a residual that is not finite" : "");
}

}  // namespace

template <int Dim>
std::string describe_fault(const MultiblockMesh<Dim>& mesh, std::span<const double> w, double gamma) {
  const std::size_t cells = mesh.cell_count();
  const auto fault = first_fault<Dim>(w, {}, cells, gamma);
  return fault ? text_of<Dim>(mesh, *fault, w.size() / (cells * state_size<Dim>)) : "";
}

template <int Dim>
std::string describe_fault(const FlowLevel<Dim>& level, std::span<const double> w,
                           std::span<const double> r) {
  const auto cells = static_cast<std::size_t>(level.domain.owned_count());
  const auto own = first_fault<Dim>(w, r, cells, level.steady.model().freestream.gamma);
  constexpr std::size_t width = 6;
  std::array<double, width> row{};
  if (own)
    row = {1.0,
           static_cast<double>(own->instance),
           static_cast<double>(level.local.global_cell[own->cell]),
           own->density,
           own->pressure,
           own->is_of_residual ? 1.0 : 0.0};
  const std::vector<double> rows = level.comm().gather(row);
  std::string text;
  for (std::size_t i = 0; i < rows.size() && text.empty(); i += width)
    if (rows[i] != 0.0)
      text = text_of<Dim>(level.mesh,
                          {static_cast<std::size_t>(rows[i + 1]), static_cast<std::size_t>(rows[i + 2]),
                           rows[i + 3], rows[i + 4], rows[i + 5] != 0.0},
                          w.size() / (cells * state_size<Dim>));
  return level.comm().broadcast(text);
}

template std::string describe_fault<2>(const FlowLevel<2>&, std::span<const double>, std::span<const double>);
template std::string describe_fault<3>(const FlowLevel<3>&, std::span<const double>, std::span<const double>);
template std::string describe_fault<2>(const MultiblockMesh<2>&, std::span<const double>, double);
template std::string describe_fault<3>(const MultiblockMesh<3>&, std::span<const double>, double);

}  // namespace wingbeat
