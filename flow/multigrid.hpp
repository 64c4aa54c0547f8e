#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "flow/flow_equations.hpp"
#include "flow/grid_transfer.hpp"
#include "flow/runge_kutta.hpp"
#include "partition/coarsening.hpp"

namespace wingbeat {

// A mesh divided among ranks: what multigrid makes its coarse meshes from.
template <int Dim>
struct DividedMesh {
  const MultiblockMesh<Dim>& mesh;
  const Partition<Dim>& partition;
};

// Cells of a zone in each direction below which a mesh no longer resembles the flow.
inline constexpr int least_multigrid_cells = 4;

struct MultigridOptions {
  std::optional<int> levels;  // meshes, the finest included; unset: as many as every block allows
  int recursion = 2;          // coarse-mesh visits a visit of the next finer mesh: 1 = V cycle, 2 = W cycle
  RungeKuttaOptions runge_kutta;
  double coarse_dissipation = 0.125;  // coefficient k of eq:first-order
};

// One coarse mesh with its equations and fields.
template <int Dim>
struct CoarseLevel {
  CoarseGrid<Dim> grid;
  LocalMesh<Dim> local;
  FlowDomain<Dim> domain;
  FlowEquations<Dim> flow;
  GridTransfer<Dim> transfer;  // from and to the next finer mesh
  RungeKutta<Dim> smoother;
  std::vector<double> w, restricted, source;

  CoarseLevel(CoarseGrid<Dim> coarse, const FlowModel<Dim, double>& model, const TimeSpectral& time,
              const FlowDomain<Dim>& finer);
  CoarseLevel(const CoarseLevel&) = delete;
  CoarseLevel& operator=(const CoarseLevel&) = delete;
};

// Full-approximation-storage multigrid with Runge-Kutta smoothing for all instances of R(w) = 0
// (eq:multigrid). Coarse meshes take every second node; their dissipation is of first order.
template <int Dim>
class Multigrid {
 public:
  // `flow` is kept by reference. Collective.
  Multigrid(FlowEquations<Dim>& flow, const DividedMesh<Dim>& mesh, const MultigridOptions& options);

  int levels() const { return 1 + static_cast<int>(coarse_.size()); }
  // Runge-Kutta steps of a cycle on all meshes, in steps on the finest: what a cycle costs.
  double work() const;

  // One cycle towards R(w) = source, which is empty (none) or has the size of w. Returns this rank's sum
  // of squares of R - source at the w given. Collective.
  double cycle(std::span<double> w, std::span<const MotionState> motions, TimeTerm term,
               const RungeKuttaOptions& options, std::span<const double> source = {});

 private:
  double visit(std::size_t level, std::span<double> w, std::span<const MotionState> motions, TimeTerm term,
               std::span<const double> source, const RungeKuttaOptions& options);

  FlowEquations<Dim>& flow_;
  int recursion_;
  RungeKutta<Dim> smoother_;
  std::vector<std::unique_ptr<CoarseLevel<Dim>>> coarse_;  // [0] the finest of them
  std::vector<std::vector<double>> residual_;              // [level]
};

}  // namespace wingbeat
