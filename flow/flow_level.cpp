#include "flow/flow_level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/io/error.hpp"
#include "partition/gather_field.hpp"

namespace wingbeat {
namespace {

// Where a fine cell's centre lies among the coarse cells of a direction.
struct Bracket {
  int low = 0;
  double fraction = 0.0;  // towards low + 1
};
Bracket bracket(int fine_cell, int fine_count, int coarse_count) {
  const double position = (fine_cell + 0.5) * coarse_count / fine_count - 0.5;
  const double clamped = std::clamp(position, 0.0, coarse_count - 1.0);
  const int low = std::min(static_cast<int>(clamped), std::max(coarse_count - 2, 0));
  return {low, clamped - low};
}

// Multilinear interpolation of a whole zone's cells, [cell][variable], first index fastest.
template <int Dim>
void interpolate_zone(const Index<Dim>& coarse, const double* from, const Index<Dim>& fine, double* to) {
  constexpr int n = state_size<Dim>;
  for_each(box_of<Dim>(fine), [&](const Index<Dim>& cell) {
    std::array<Bracket, Dim> brackets;
    for (std::size_t d = 0; d < Dim; ++d) brackets[d] = bracket(cell[d], fine[d], coarse[d]);
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      double weight = 1.0;
      std::ptrdiff_t at = 0, stride = 1;
      for (std::size_t d = 0; d < Dim; ++d) {
        const bool high = (corner >> d) & 1;
        weight *= high ? brackets[d].fraction : 1.0 - brackets[d].fraction;
        at += std::min(brackets[d].low + (high ? 1 : 0), coarse[d] - 1) * stride;
        stride *= coarse[d];
      }
      for (int v = 0; v < n; ++v) to[v] += weight * from[at * n + v];
    }
    to += n;
  });
}

}  // namespace

template <int Dim>
FlowLevel<Dim>::FlowLevel(const Comm& comm, MultiblockMesh<Dim> level_mesh,
                          const FlowModel<Dim, double>& model, const Vec<double, 2>& axis,
                          const FlowLevelOptions& options)
    : mesh(std::move(level_mesh)),
      partition(partition_mesh<Dim>(mesh, comm.size(), options.partition)),
      local(build_local_mesh<Dim>(mesh, partition, comm.rank())),
      domain(comm, local, axis),
      subdomain(
          std::make_shared<const Subdomain>(comm, domain.exchange(), domain.pattern(), options.subdomain)),
      steady(domain, model, TimeSpectral(0)),
      solver(std::make_shared<SchwarzSolver<double>>(comm, subdomain, state_size<Dim>)) {}

template <int Dim>
std::string mesh_size_text(const MultiblockMesh<Dim>& mesh) {
  if (mesh.zones.size() > 1) return fmt::format("{} cells in {} zones", mesh.cell_count(), mesh.zones.size());
  std::string text = fmt::format("{}", mesh.zones[0].cells[0]);
  for (std::size_t d = 1; d < Dim; ++d) text += fmt::format("x{}", mesh.zones[0].cells[d]);
  return text;
}

template <int Dim>
std::vector<double> transferred_state(const FlowLevel<Dim>& from, std::span<const double> w,
                                      const FlowLevel<Dim>& to) {
  constexpr int n = state_size<Dim>;
  ensure(from.mesh.zones.size() == to.mesh.zones.size(), "the two meshes have different zones");
  const std::vector<double> coarse = gather_to_root(from.comm(), from.local.global_cell, w, 1, n);
  std::vector<double> fine;
  if (to.comm().is_root()) {
    fine.assign(to.mesh.cell_count() * n, 0.0);
    const double* in = coarse.data();
    double* out = fine.data();
    for (std::size_t z = 0; z < to.mesh.zones.size(); ++z) {
      const auto& coarse_cells = from.mesh.zones[z].cells;
      const auto& fine_cells = to.mesh.zones[z].cells;
      interpolate_zone<Dim>(coarse_cells, in, fine_cells, out);
      in += box_of<Dim>(coarse_cells).size() * n;
      out += box_of<Dim>(fine_cells).size() * n;
    }
  }
  return scatter_from_root(to.comm(), to.local.global_cell, fine, 1, n);
}

template struct FlowLevel<2>;
template struct FlowLevel<3>;
template std::string mesh_size_text<2>(const MultiblockMesh<2>&);
template std::string mesh_size_text<3>(const MultiblockMesh<3>&);
template std::vector<double> transferred_state<2>(const FlowLevel<2>&, std::span<const double>,
                                                  const FlowLevel<2>&);
template std::vector<double> transferred_state<3>(const FlowLevel<3>&, std::span<const double>,
                                                  const FlowLevel<3>&);

}  // namespace wingbeat
