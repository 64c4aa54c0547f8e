#pragma once

#include <memory>
#include <span>
#include <vector>

#include "adjoint/changed_domain.hpp"
#include "adjoint/shape_variables.hpp"
#include "flow/pseudo_transient.hpp"
#include "structure/linear_flutter.hpp"

namespace wingbeat {

struct FlutterRootOptions {
  FlowLevelOptions level;
  PseudoTransientOptions steady;
  LinearFlutterOptions linear;
};

// Flutter of deformed sections by linearization alone: all roots, on a mesh of every second node where the
// mesh allows it, to see which there are and how they move; or polished on the mesh itself, to start a cycle
// from. All methods are collective and throw SolveFailure where the flow is not found.
class FlutterRootsAt {
 public:
  // All that is given by reference outlives it.
  FlutterRootsAt(const DomainBase<2>& base, const MultiblockMesh<2>& mesh, const ShapeVariables& shape,
                 const StructureModel& model, double mean_pitch, FlutterRootOptions options);

  // `change`: of the free stream; its nodes are not used.
  std::vector<FlutterRoot> roots(std::span<const double> amplitudes, const Parameters<2>& change);

  // The destabilising root nearest to `wanted` in speed and frequency, with its flow.
  struct Polished {
    FlutterRoot root;
    AeroelasticState state;  // small motion of the energy given
    AeroelasticState rest;
  };
  Polished polish(std::span<const double> amplitudes, const Parameters<2>& change, const FlutterRoot& wanted,
                  const TimeSpectral& time, double energy);

 private:
  std::unique_ptr<FlowLevel<2>> level(MultiblockMesh<2> mesh, const Parameters<2>& change) const;
  SectionKinematics kinematics(const FlowLevel<2>& level) const;
  void solve(FlowLevelRange<2> levels) const;

  DomainBase<2> base_;
  const MultiblockMesh<2>& mesh_;
  const ShapeVariables& shape_;
  const StructureModel& model_;
  double mean_pitch_;
  FlutterRootOptions options_;
  std::vector<double> coarse_w_;  // the last coarse steady flow
};

}  // namespace wingbeat
