#include "flow/flow_tangent.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

using D = Dual<double, 1>;

D changing(double value, double change) {
  D x(value);
  x.gradient[0] = change;
  return x;
}

template <int Dim>
FlowModel<Dim, D> changing(const FlowModel<Dim, double>& model, const FlowInputs<Dim>& change) {
  const auto& f = model.freestream;
  return {{f.gamma, changing(f.mach, change.mach), changing(f.angle_cosine, -f.angle_sine * change.angle),
           changing(f.angle_sine, f.angle_cosine * change.angle)},
          model.scheme};
}

RigidMotion<D> changing(const MotionState& motion, const MotionState& change) {
  const D pitch = changing(motion.pitch, change.pitch);
  return {chain(pitch, std::cos(motion.pitch), -std::sin(motion.pitch)),
          chain(pitch, std::sin(motion.pitch), std::cos(motion.pitch)),
          changing(motion.pitch_rate, change.pitch_rate), changing(motion.plunge_rate, change.plunge_rate)};
}

// Of this rank's walls, at given pressures.
template <int Dim>
Loads<double> load_change(const FlowEquations<Dim>& flow, const RigidMotion<D>& motion,
                          const Freestream<Dim, D>& freestream, std::span<const double> w,
                          std::span<const double> ghosts, const FlowInputs<Dim>& change) {
  const D scale = 1.0 / freestream.dynamic_pressure();
  Loads<D> loads;
  for (const WallFace& wall : flow.walls().faces()) {
    const ChangedGeometry<Dim> geometry{flow.domain().blocks()[wall.block].geometry,
                                        change.geometry[wall.block]};
    const D push = wall.face.outward * (flow.walls().wall_pressure_at(wall, w, ghosts) - 1.0) * scale;
    add_wall_load<Dim, D>(resting_face<Dim, D>(geometry, wall.face.direction, wall.face.face), motion, push,
                          loads);
  }
  return {loads.force_x.gradient[0], loads.force_y.gradient[0], loads.moment.gradient[0]};
}

// kappa D (dOmega w) + dkappa D (Omega w).
template <int Dim>
void add_time_change(const FlowEquations<Dim>& flow, const FlowPoint& at, const FlowInputs<Dim>& change,
                     std::span<double> residual) {
  constexpr std::size_t n = state_size<Dim>;
  const std::size_t count = flow.domain().state_count();
  const auto volumes = flow.domain().volumes();
  std::vector<double> relative(volumes.size());
  for (std::size_t b = 0; b < change.geometry.size(); ++b) {
    const auto first = static_cast<std::size_t>(flow.domain().blocks()[b].first_cell);
    const auto& by_cell = change.geometry[b].volume;
    for (std::size_t c = 0; c < by_cell.size(); ++c) relative[first + c] = by_cell[c] / volumes[first + c];
  }
  std::vector<double> stretched(at.w.begin(), at.w.end());
  for (std::size_t i = 0; i < stretched.size(); ++i)
    stretched[i] *= at.kappa * relative[i % count / n] + change.kappa;
  flow.add_time_derivative(1.0, stretched, residual);
}

}  // namespace

template <int Dim>
FlowTangent flow_tangent(const FlowEquations<Dim>& flow, const FlowPoint& at, const FlowInputs<Dim>& change) {
  const FlowDomain<Dim>& domain = flow.domain();
  const std::size_t count = domain.state_count(), instances = flow.instance_count();
  const std::vector<double> ghosts = ghost_cells(flow, at.w);
  const std::size_t ghost_count = ghosts.size() / instances;

  const FlowModel<Dim, D> model = changing(flow.model(), change);
  FluxBalance<Dim, D> balance(domain, model);
  std::vector<D> dual_w(count), dual_ghosts(ghost_count), dual_balance(count);
  FlowTangent tangent;
  tangent.residual.resize(at.w.size());
  std::vector<double> loads;
  for (std::size_t i = 0; i < instances; ++i) {
    const auto w = at.w.subspan(i * count, count);
    const auto beyond = std::span<const double>(ghosts).subspan(i * ghost_count, ghost_count);
    const RigidMotion<D> motion = changing(at.motions[i], change.motions[i]);
    std::copy(w.begin(), w.end(), dual_w.begin());
    std::copy(beyond.begin(), beyond.end(), dual_ghosts.begin());
    balance.evaluate_changed(dual_w, dual_ghosts, motion, change.geometry, dual_balance);
    for (std::size_t j = 0; j < count; ++j) tangent.residual[i * count + j] = dual_balance[j].gradient[0];
    const Loads<double> part = load_change(flow, motion, model.freestream, w, beyond, change);
    loads.insert(loads.end(), {part.force_x, part.force_y, part.moment});
  }
  add_time_change(flow, at, change, tangent.residual);
  domain.comm().sum(loads);
  for (std::size_t i = 0; i < loads.size(); i += 3)
    tangent.loads.push_back({loads[i], loads[i + 1], loads[i + 2]});
  return tangent;
}

template FlowTangent flow_tangent<2>(const FlowEquations<2>&, const FlowPoint&, const FlowInputs<2>&);
template FlowTangent flow_tangent<3>(const FlowEquations<3>&, const FlowPoint&, const FlowInputs<3>&);

}  // namespace wingbeat
