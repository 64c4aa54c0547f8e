#include "optimize/flutter_roots_at.hpp"

#include <algorithm>

#include "core/io/error.hpp"
#include "core/mesh/coarsen.hpp"
#include "optimize/root_tracker.hpp"
#include "structure/harmonic_motion.hpp"

namespace wingbeat {
namespace {

constexpr int least_normal_cells = 12;  // of a coarse mesh

}  // namespace

FlutterRootsAt::FlutterRootsAt(const DomainBase<2>& base, const MultiblockMesh<2>& mesh,
                               const ShapeVariables& shape, const StructureModel& model, double mean_pitch,
                               FlutterRootOptions options)
    : base_(base),
      mesh_(mesh),
      shape_(shape),
      model_(model),
      mean_pitch_(mean_pitch),
      options_(std::move(options)) {}

std::unique_ptr<FlowLevel<2>> FlutterRootsAt::level(MultiblockMesh<2> mesh,
                                                    const Parameters<2>& change) const {
  return std::make_unique<FlowLevel<2>>(base_.comm, std::move(mesh), changed_model<2>(base_.model, change),
                                        base_.axis, options_.level);
}

SectionKinematics FlutterRootsAt::kinematics(const FlowLevel<2>& level) const {
  SectionKinematics kinematics;
  kinematics.flow_speed = level.steady.model().freestream.speed();
  kinematics.mean_pitch = mean_pitch_;
  return kinematics;
}

void FlutterRootsAt::solve(FlowLevelRange<2> levels) const {
  const auto result = solve_steady<2>(levels, {mean_pitch_, 0.0, 0.0}, options_.steady);
  if (result.status != SolveStatus::converged)
    throw SolveFailure(result.status, "the steady flow behind the flutter roots has not converged");
}

std::vector<FlutterRoot> FlutterRootsAt::roots(std::span<const double> amplitudes,
                                               const Parameters<2>& change) {
  MultiblockMesh<2> mesh = shape_.deformed_mesh(base_.comm, mesh_, amplitudes);
  if (auto coarse = coarsened(mesh, least_normal_cells)) mesh = std::move(*coarse);
  FlowLevels<2> levels;
  levels.push_back(level(std::move(mesh), change));
  levels[0]->w = coarse_w_;
  solve(levels);
  coarse_w_ = levels[0]->w;
  LinearFlutterOptions linear = options_.linear;
  linear.settled_speed = 1e-2;  // enough to see which roots there are
  return solve_linear_flutter<2>(levels, model_, kinematics(*levels[0]), linear).flutter.roots;
}

FlutterRootsAt::Polished FlutterRootsAt::polish(std::span<const double> amplitudes,
                                                const Parameters<2>& change, const FlutterRoot& wanted,
                                                const TimeSpectral& time, double energy) {
  MultiblockMesh<2> mesh = shape_.deformed_mesh(base_.comm, mesh_, amplitudes);
  FlowLevels<2> levels;
  if (auto coarse = coarsened(mesh, least_normal_cells)) levels.push_back(level(std::move(*coarse), change));
  levels.push_back(level(std::move(mesh), change));
  const FlowLevel<2>& finest = *levels.back();
  const bool is_alike = finest.domain.state_count() == base_.mesh.global_cell.size() * state_size<2> &&
                        std::ranges::equal(finest.local.global_cell, base_.mesh.global_cell);
  ensure(!base_.comm.any(!is_alike), "a deformed mesh is shared among ranks in another way");
  solve(levels);
  LinearFlutterSolution<2> linear =
      solve_linear_flutter<2>(levels, model_, kinematics(finest), options_.linear);
  const FlutterRoot* nearest = nullptr;
  for (const FlutterRoot& root : linear.flutter.roots)
    if (root.is_destabilising() && (!nearest || distance(root, wanted) < distance(*nearest, wanted)))
      nearest = &root;
  if (!nearest) throw SolveFailure(SolveStatus::stalled, "no flutter root was found on the mesh itself");
  const Eigen::VectorXcd u_hat = scaled_to_energy(model_, nearest->mode, nearest->frequency, energy);
  return {*nearest,
          linear.section->harmonic_state(model_, time, u_hat, nearest->frequency, nearest->reduced_velocity),
          linear.section->rest()};
}

}  // namespace wingbeat
