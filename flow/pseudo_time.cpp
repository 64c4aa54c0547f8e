#include "flow/pseudo_time.hpp"

#include <algorithm>
#include <cmath>

namespace wingbeat {
namespace {

// A residual this many times that of uniform flow is no flow any more.
constexpr double hopeless_residual = 50.0;
// Cycles after which a state that still behaves is kept to go back to.
constexpr int cycles_to_trust = 10;

}  // namespace

template <int Dim>
PseudoTimeResult pseudo_time(FlowEquations<Dim>& flow, Multigrid<Dim>& multigrid, std::span<double> w,
                             std::span<const MotionState> motions, TimeTerm term,
                             const PseudoTimeOptions& options, const PseudoTimeObserver& observer,
                             const PseudoTimeMemory* earlier) {
  const Comm& comm = flow.domain().comm();
  const double gamma = flow.model().freestream.gamma, scale = flow.uniform_residual();
  RungeKuttaOptions step = options.multigrid.runge_kutta;
  std::vector<double> good(w.begin(), w.end()), before(w.size());
  PseudoTimeResult result;
  if (earlier) {
    good = earlier->good;
    step.cfl = earlier->cfl;
    result.cycles = earlier->cycles;
    result.retreats = earlier->retreats;
  }
  const int begun = result.cycles;
  const auto leave = [&](SolveStatus status, int cycles) {
    result.memory = PseudoTimeMemory{cycles, result.retreats, step.cfl, std::move(good)};
    result.status = status;
    return result;
  };
  while (true) {
    std::copy(w.begin(), w.end(), before.begin());
    const double norm = std::sqrt(comm.sum(multigrid.cycle(w, motions, term, step))) / scale;
    const bool is_good = norm < hopeless_residual && !comm.any(!is_physical<Dim>(w, gamma));
    result.cfl = step.cfl;
    if (std::isfinite(norm)) result.residual = norm;
    const bool is_stopped =
        observer && comm.any(!observer({result.cycles, norm, step.cfl, result.retreats, before, good}));
    const bool is_converged = norm <= options.tolerance;
    if (is_converged || is_stopped) {
      std::copy(before.begin(), before.end(), w.begin());
      if (!is_converged) return leave(SolveStatus::interrupted, result.cycles);
      return result.status = SolveStatus::converged, result;
    }
    if (!is_good) {
      std::copy(good.begin(), good.end(), w.begin());
      if (result.retreats == options.max_retreats) return result.status = SolveStatus::diverged, result;
      ++result.retreats;
      step.cfl *= 0.5;
    } else if (result.cycles % cycles_to_trust == 0) {
      good = before;
    }
    if (result.cycles - begun == options.max_cycles)
      return leave(SolveStatus::iteration_limit, result.cycles + 1);
    ++result.cycles;
  }
}

template <int Dim>
std::vector<double> full_multigrid_start(const FlowEquations<Dim>& flow, const DividedMesh<Dim>& mesh,
                                         std::span<const MotionState> motions, TimeTerm term,
                                         const PseudoTimeOptions& options,
                                         const PseudoTimeObserver& observer) {
  std::optional<CoarseGrid<Dim>> grid;
  if (options.multigrid.levels.value_or(2) > 1)
    grid = coarsened<Dim>(mesh.mesh, mesh.partition, least_multigrid_cells);
  if (!grid) return flow.uniform_state();
  const Comm& comm = flow.domain().comm();
  const LocalMesh<Dim> local = build_local_mesh<Dim>(grid->mesh, grid->partition, comm.rank());
  const FlowDomain<Dim> domain(comm, local, flow.domain().axis());
  FlowEquations<Dim> coarse(domain, flow.model(), flow.time());
  PseudoTimeOptions coarse_options = options;
  coarse_options.tolerance = std::max(options.tolerance, 1e-4);
  coarse_options.max_cycles = 100;
  if (auto& levels = coarse_options.multigrid.levels) --*levels;
  const DividedMesh<Dim> divided{grid->mesh, grid->partition};
  std::vector<double> w = full_multigrid_start(coarse, divided, motions, term, coarse_options, observer);
  Multigrid<Dim> multigrid(coarse, divided, coarse_options.multigrid);
  const PseudoTimeResult result =
      pseudo_time<Dim>(coarse, multigrid, w, motions, term, coarse_options, observer);
  if (result.status == SolveStatus::diverged) return flow.uniform_state();
  std::vector<double> fine(flow.state_count());
  GridTransfer<Dim>(flow.domain(), domain).interpolate(w, fine, flow.time().instances());
  return fine;
}

template PseudoTimeResult pseudo_time<2>(FlowEquations<2>&, Multigrid<2>&, std::span<double>,
                                         std::span<const MotionState>, TimeTerm, const PseudoTimeOptions&,
                                         const PseudoTimeObserver&, const PseudoTimeMemory*);
template PseudoTimeResult pseudo_time<3>(FlowEquations<3>&, Multigrid<3>&, std::span<double>,
                                         std::span<const MotionState>, TimeTerm, const PseudoTimeOptions&,
                                         const PseudoTimeObserver&, const PseudoTimeMemory*);
template std::vector<double> full_multigrid_start<2>(const FlowEquations<2>&, const DividedMesh<2>&,
                                                     std::span<const MotionState>, TimeTerm,
                                                     const PseudoTimeOptions&, const PseudoTimeObserver&);
template std::vector<double> full_multigrid_start<3>(const FlowEquations<3>&, const DividedMesh<3>&,
                                                     std::span<const MotionState>, TimeTerm,
                                                     const PseudoTimeOptions&, const PseudoTimeObserver&);

}  // namespace wingbeat
