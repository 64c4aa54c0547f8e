#pragma once

#include <span>
#include <vector>

#include "adjoint/design_settings.hpp"
#include "core/parallel/comm.hpp"
#include "partition/local_nodes.hpp"

namespace wingbeat {

// From the amplitudes of bumps to the nodes that a rank sees, and back.
class ShapeVariables {
 public:
  ShapeVariables(const MultiblockMesh<2>& mesh, const LocalMesh<2>& local, const DesignSettings& settings);

  const NodeNumbers<2>& numbers() const { return numbers_; }
  const LocalNodes<2>& nodes() const { return nodes_; }
  const SectionWall& wall() const { return wall_; }
  const HicksHenne& bumps() const { return bumps_; }

  // Displacement of each local node.
  std::vector<Vec<double, 2>> node_change(std::span<const double> amplitudes) const;
  // The whole mesh with its wall moved. Cells may fold. Collective.
  MultiblockMesh<2> deformed_mesh(const Comm& comm, const MultiblockMesh<2>& mesh,
                                  std::span<const double> amplitudes) const;
  // The transpose of node_change, in two steps: from this rank's part of the sensitivities to its nodes to those to the
  // wall's nodes, summed over ranks, the mesh following the wall; from those to the amplitudes. Collective.
  std::vector<Vec<double, 2>> wall_sensitivity(const Comm& comm, std::span<const Vec<double, 2>> nodes) const;
  std::vector<double> amplitude_gradient(std::span<const Vec<double, 2>> wall) const {
    return bumps_.amplitude_gradient(wall);
  }

 private:
  NodeNumbers<2> numbers_;
  LocalNodes<2> nodes_;
  SectionWall wall_;
  HicksHenne bumps_;
  MeshDeformation deformation_;
};

}  // namespace wingbeat
