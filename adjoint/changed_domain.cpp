#include "adjoint/changed_domain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/algebra/newton.hpp"

namespace wingbeat {
namespace {

template <int Dim>
LocalMesh<Dim> moved(LocalMesh<Dim> mesh, const LocalNodes<Dim>& nodes,
                     std::span<const Vec<double, Dim>> change) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (std::size_t i = 0; i < mesh.blocks[b].nodes.size(); ++i)
      if (const int node = nodes.blocks[b].data()[i]; node >= 0)
        mesh.blocks[b].nodes.data()[i] += change[static_cast<std::size_t>(node)];
  return mesh;
}

template <int Dim>
Vec<double, 2> moved_axis(const DomainBase<Dim>& base, const Parameters<Dim>& change) {
  Vec<double, 2> axis = base.axis;
  if (base.turns_about_elastic_axis) axis[0] += 0.5 * change[Scalar::elastic_axis];
  return axis;
}

}  // namespace

template <int Dim>
FlowModel<Dim, double> changed_model(FlowModel<Dim, double> model, const Parameters<Dim>& change) {
  auto& f = model.freestream;
  f.mach += change[Scalar::mach];
  const double turn = change[Scalar::angle_of_attack] * std::numbers::pi / 180.0;
  const double cosine = f.angle_cosine, sine = f.angle_sine;
  f.angle_cosine = cosine * std::cos(turn) - sine * std::sin(turn);
  f.angle_sine = sine * std::cos(turn) + cosine * std::sin(turn);
  return model;
}

template <int Dim>
ChangedDomain<Dim>::ChangedDomain(const DomainBase<Dim>& base, const Parameters<Dim>& change,
                                  const TimeSpectral& time)
    : mesh(moved<Dim>(base.mesh, base.nodes, change.nodes)),
      model(changed_model(base.model, change)),
      domain(base.comm, mesh, moved_axis(base, change)),
      flow(domain, model, time) {
  const auto volumes = domain.volumes();
  if (base.comm.any(std::ranges::any_of(volumes, [](double volume) { return !(volume > 0.0); })))
    throw SolveFailure(SolveStatus::diverged,
                       "the deformed mesh has a cell without positive volume; lower design.bound, or set "
                       "design.deformation to the other of grid_lines and inverse_distance");
}

template FlowModel<2, double> changed_model<2>(FlowModel<2, double>, const Parameters<2>&);
template FlowModel<3, double> changed_model<3>(FlowModel<3, double>, const Parameters<3>&);
template struct ChangedDomain<2>;
template struct ChangedDomain<3>;

}  // namespace wingbeat
