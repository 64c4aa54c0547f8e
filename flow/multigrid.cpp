#include "flow/multigrid.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

template <int Dim>
FlowModel<Dim, double> coarse_model(const FlowModel<Dim, double>& model, double dissipation) {
  return {model.freestream, FirstOrderScheme{dissipation}};
}

// Runge-Kutta steps in a visit of the coarsest mesh. They decide over the rate where a mesh has but
// one or two coarser ones; where it has many they cost next to nothing.
template <int Dim>
int coarsest_steps(const MultiblockMesh<Dim>& mesh) {
  int cells = 0;
  for (const auto& zone : mesh.zones) cells = std::max(cells, *std::ranges::min_element(zone.cells));
  return std::max(4, cells / 2);
}

}  // namespace

template <int Dim>
CoarseLevel<Dim>::CoarseLevel(CoarseGrid<Dim> coarse, const FlowModel<Dim, double>& model,
                              const TimeSpectral& time, const FlowDomain<Dim>& finer)
    : grid(std::move(coarse)),
      local(build_local_mesh<Dim>(grid.mesh, grid.partition, finer.comm().rank())),
      domain(finer.comm(), local, finer.axis()),
      flow(domain, model, time),
      transfer(finer, domain),
      smoother(flow),
      w(flow.state_count()),
      restricted(flow.state_count()),
      source(flow.state_count()) {}

template <int Dim>
Multigrid<Dim>::Multigrid(FlowEquations<Dim>& flow, const DividedMesh<Dim>& mesh,
                          const MultigridOptions& options)
    : flow_(flow), recursion_(options.recursion), smoother_(flow) {
  residual_.emplace_back(flow.state_count());
  const auto model = coarse_model(flow.model(), options.coarse_dissipation);
  const MultiblockMesh<Dim>* finer_mesh = &mesh.mesh;
  const Partition<Dim>* finer_partition = &mesh.partition;
  const FlowDomain<Dim>* finer_domain = &flow.domain();
  while (!options.levels || levels() < *options.levels) {
    auto grid = coarsened<Dim>(*finer_mesh, *finer_partition, least_multigrid_cells);
    if (!grid) break;
    coarse_.push_back(
        std::make_unique<CoarseLevel<Dim>>(std::move(*grid), model, flow.time(), *finer_domain));
    const CoarseLevel<Dim>& level = *coarse_.back();
    residual_.emplace_back(level.flow.state_count());
    finer_mesh = &level.grid.mesh;
    finer_partition = &level.grid.partition;
    finer_domain = &level.domain;
  }
}

template <int Dim>
double Multigrid<Dim>::work() const {
  double work = 1.0, share = 1.0;
  int visits = 1;
  for (std::size_t level = 1; level <= coarse_.size(); ++level) {
    const bool is_coarsest = level == coarse_.size();
    share /= 1 << Dim;
    if (!is_coarsest) visits *= recursion_;
    work += share * visits * (is_coarsest ? coarsest_steps<Dim>(coarse_.back()->grid.mesh) : 2);
  }
  return work;
}

template <int Dim>
double Multigrid<Dim>::visit(std::size_t level, std::span<double> w, std::span<const MotionState> motions,
                             TimeTerm term, std::span<const double> source,
                             const RungeKuttaOptions& options) {
  FlowEquations<Dim>& flow = level == 0 ? flow_ : coarse_[level - 1]->flow;
  RungeKutta<Dim>& smoother = level == 0 ? smoother_ : coarse_[level - 1]->smoother;
  const double sum_of_squares = smoother.step(w, motions, term, source, options);
  if (level == coarse_.size()) {
    const int steps = level == 0 ? 1 : coarsest_steps<Dim>(coarse_.back()->grid.mesh);
    for (int k = 1; k < steps; ++k) smoother.step(w, motions, term, source, options);
    return sum_of_squares;
  }

  CoarseLevel<Dim>& coarse = *coarse_[level];
  std::vector<double>& residual = residual_[level];
  flow.residual(w, motions, term, residual);
  for (std::size_t i = 0; i < source.size(); ++i) residual[i] -= source[i];
  coarse.transfer.restrict_mean(w, coarse.w, flow.time().instances());
  coarse.transfer.restrict_sum(residual, coarse.restricted, flow.time().instances());
  coarse.flow.residual(coarse.w, motions, term, coarse.source);
  for (std::size_t i = 0; i < coarse.source.size(); ++i) coarse.source[i] -= coarse.restricted[i];
  coarse.restricted = coarse.w;

  const bool is_coarsest = level + 1 == coarse_.size();
  for (int k = 0; k < (is_coarsest ? 1 : recursion_); ++k)
    visit(level + 1, coarse.w, motions, term, coarse.source, options);
  for (std::size_t i = 0; i < coarse.w.size(); ++i) coarse.w[i] -= coarse.restricted[i];
  coarse.transfer.prolong_add(coarse.w, w, flow.time().instances());
  // What the interpolation roughened must not reach the next finer mesh, which smooths before it
  // comes back here only.
  if (level > 0) smoother.step(w, motions, term, source, options);
  return sum_of_squares;
}

template <int Dim>
double Multigrid<Dim>::cycle(std::span<double> w, std::span<const MotionState> motions, TimeTerm term,
                             const RungeKuttaOptions& options, std::span<const double> source) {
  return visit(0, w, motions, term, source, options);
}

template struct CoarseLevel<2>;
template struct CoarseLevel<3>;
template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace wingbeat
