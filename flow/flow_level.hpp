#pragma once

#include <memory>
#include <string>

#include "core/algebra/schwarz.hpp"
#include "flow/flow_equations.hpp"
#include "partition/local_mesh.hpp"
#include "partition/partition.hpp"

namespace wingbeat {

struct FlowLevelOptions {
  PartitionOptions partition;
  SubdomainOptions subdomain{};  // of the Schwarz solvers
};

// One mesh with everything that solving the steady flow on it takes. Not copied or moved: parts
// refer to one another.
template <int Dim>
struct FlowLevel {
  MultiblockMesh<Dim> mesh;
  Partition<Dim> partition;
  LocalMesh<Dim> local;
  FlowDomain<Dim> domain;
  std::shared_ptr<const Subdomain> subdomain;
  FlowEquations<Dim> steady;                      // one instance
  std::shared_ptr<SchwarzSolver<double>> solver;  // of a matrix near the steady Jacobian, once solved
  std::vector<double> w;                          // the steady state, once solved

  FlowLevel(const Comm& comm, MultiblockMesh<Dim> level_mesh, const FlowModel<Dim, double>& model,
            const Vec<double, 2>& axis, const FlowLevelOptions& options);
  FlowLevel(const FlowLevel&) = delete;
  FlowLevel& operator=(const FlowLevel&) = delete;

  const Comm& comm() const { return domain.comm(); }
};

// "250x50" for one zone, "12500 cells in 5 zones" for more.
template <int Dim>
std::string mesh_size_text(const MultiblockMesh<Dim>& mesh);

// The state of one instance carried from one mesh to another with the same zones, linearly in the
// zones' index space. Collective.
template <int Dim>
std::vector<double> transferred_state(const FlowLevel<Dim>& from, std::span<const double> w,
                                      const FlowLevel<Dim>& to);

}  // namespace wingbeat
