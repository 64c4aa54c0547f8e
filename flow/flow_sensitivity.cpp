#include "flow/flow_sensitivity.hpp"

#include "core/algebra/krylov_kernels.hpp"
#include "flow/geometry_sensitivity.hpp"

namespace wingbeat {
namespace {

using D = Dual<double, 3>;

// Seeds 0 and 1 on Mach number and angle of attack.
template <int Dim>
FlowModel<Dim, D> seeded(const FlowModel<Dim, double>& model) {
  const auto& f = model.freestream;
  const D angle = D::seed(0.0, 1);  // of which sine and cosine are given
  return {{f.gamma, D::seed(f.mach, 0), chain(angle, f.angle_cosine, -f.angle_sine),
           chain(angle, f.angle_sine, f.angle_cosine)},
          model.scheme};
}

// multipliers . balance of one instance, to Mach number and angle.
template <int Dim>
std::array<double, 2> stream_sensitivity(FluxBalance<Dim, D>& balance, std::span<const double> w,
                                         std::span<const double> ghosts, const RigidMotion<double>& motion,
                                         std::span<const double> multipliers) {
  const std::vector<D> dual_w(w.begin(), w.end()), dual_ghosts(ghosts.begin(), ghosts.end());
  std::vector<D> result(w.size());
  balance.evaluate(dual_w, dual_ghosts, {motion.cosine, motion.sine, motion.pitch_rate, motion.plunge_rate},
                   result);
  std::array<double, 2> sums{};
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) sums[k] += multipliers[i] * result[i].gradient[static_cast<int>(k)];
  return sums;
}

// multipliers . kappa D (Omega w), to kappa and to the volumes.
template <int Dim>
void add_time_sensitivity(const FlowEquations<Dim>& flow, const FlowPoint& at,
                          std::span<const double> multipliers, FlowInputs<Dim>& result) {
  constexpr std::size_t n = state_size<Dim>;
  if (flow.instance_count() == 1) return;
  std::vector<double> derivative(at.w.size(), 0.0);
  flow.add_time_derivative(1.0, at.w, derivative);
  const std::size_t count = flow.domain().state_count();
  const auto volumes = flow.domain().volumes();
  std::vector<double> by_cell(volumes.size(), 0.0);
  for (std::size_t i = 0; i < derivative.size(); ++i)
    by_cell[i % count / n] += multipliers[i] * derivative[i];
  for (std::size_t b = 0; b < result.geometry.size(); ++b) {
    auto& by_volume = result.geometry[b].volume;
    const auto first = static_cast<std::size_t>(flow.domain().blocks()[b].first_cell);
    for (std::size_t c = 0; c < by_volume.size(); ++c) {
      result.kappa += by_cell[first + c];
      by_volume[c] += at.kappa * by_cell[first + c] / volumes[first + c];
    }
  }
}

// weights . loads of one instance, to the geometry and the dynamic pressure that they are divided by.
template <int Dim>
void add_load_sensitivities(const FlowEquations<Dim>& flow, std::span<const double> w,
                            std::span<const double> ghosts, const RigidMotion<double>& motion,
                            const Loads<double>& weights, FlowInputs<Dim>& result) {
  const auto& freestream = flow.model().freestream;
  Loads<double> loads;
  for (const WallFace& wall : flow.walls().faces()) {
    const auto& geometry = flow.domain().blocks()[wall.block].geometry;
    const double push = wall.face.outward * (flow.walls().wall_pressure_at(wall, w, ghosts) - 1.0) /
                        freestream.dynamic_pressure();
    add_wall_load<Dim, double>(resting_face<Dim, double>(geometry, wall.face.direction, wall.face.face),
                               motion, push, loads);
    add_load_sensitivity<Dim>(geometry, wall.face, motion, push, weights, result.geometry[wall.block]);
  }
  result.mach -=
      2.0 / freestream.mach *
      (weights.force_x * loads.force_x + weights.force_y * loads.force_y + weights.moment * loads.moment);
}

MotionState load_motion_sensitivity(const Loads<D>& loads, const Loads<double>& weights) {
  const auto sums = weights.force_x * loads.force_x.gradient + weights.force_y * loads.force_y.gradient +
                    weights.moment * loads.moment.gradient;
  return {sums[0], sums[1], sums[2]};
}

void sum_over_ranks(const Comm& comm, auto& result) {
  std::vector<double> values{result.mach, result.angle, result.kappa};
  for (const MotionState& m : result.motions)
    values.insert(values.end(), {m.pitch, m.pitch_rate, m.plunge_rate});
  comm.sum(values);
  result.mach = values[0], result.angle = values[1], result.kappa = values[2];
  for (std::size_t n = 0; n < result.motions.size(); ++n)
    result.motions[n] = {values[3 * n + 3], values[3 * n + 4], values[3 * n + 5]};
}

}  // namespace

template <int Dim>
FlowInputs<Dim> flow_sensitivity(const FlowEquations<Dim>& flow, const FlowPoint& at,
                                 std::span<const double> multipliers,
                                 std::span<const Loads<double>> weights) {
  const FlowDomain<Dim>& domain = flow.domain();
  const std::size_t count = domain.state_count(), instances = flow.instance_count();
  const std::vector<double> ghosts = ghost_cells(flow, at.w);
  const std::size_t ghost_count = ghosts.size() / instances;

  FlowInputs<Dim> result(flow);
  FluxBalance<Dim, D> stream_balance(domain, seeded(flow.model()));
  for (std::size_t i = 0; i < instances; ++i) {
    const auto w = at.w.subspan(i * count, count), lambda = multipliers.subspan(i * count, count);
    const auto beyond = std::span<const double>(ghosts).subspan(i * ghost_count, ghost_count);
    const RigidMotion<double> motion = rigid_motion(at.motions[i]);
    for (std::size_t b = 0; b < domain.blocks().size(); ++b)
      add_balance_sensitivity<Dim>(domain.blocks()[b], domain.owned_count(), flow.model(), w, beyond, motion,
                                   lambda, result.geometry[b]);
    const auto stream = stream_sensitivity<Dim>(stream_balance, w, beyond, motion, lambda);
    result.mach += stream[0];
    result.angle += stream[1];
    const auto& columns = flow.motion_gradients(i);
    result.motions[i] = {local_dot(columns[0], lambda), local_dot(columns[1], lambda),
                         local_dot(columns[2], lambda)};
    add_load_sensitivities<Dim>(flow, w, beyond, motion, weights[i], result);
  }
  add_time_sensitivity<Dim>(flow, at, multipliers, result);
  sum_over_ranks(domain.comm(), result);
  // The linearized loads are those of all ranks already.
  for (std::size_t i = 0; i < instances; ++i) {
    const MotionState by_loads = load_motion_sensitivity(flow.linearized_loads(i), weights[i]);
    result.motions[i].pitch += by_loads.pitch;
    result.motions[i].pitch_rate += by_loads.pitch_rate;
    result.motions[i].plunge_rate += by_loads.plunge_rate;
  }
  return result;
}

template FlowInputs<2> flow_sensitivity<2>(const FlowEquations<2>&, const FlowPoint&, std::span<const double>,
                                           std::span<const Loads<double>>);
template FlowInputs<3> flow_sensitivity<3>(const FlowEquations<3>&, const FlowPoint&, std::span<const double>,
                                           std::span<const Loads<double>>);

}  // namespace wingbeat
