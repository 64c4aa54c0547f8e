#include "apps/flow_cycles.hpp"

#include <fmt/format.h>

#include <utility>

#include "apps/breakdown.hpp"
#include "apps/memory_packing.hpp"
#include "core/io/error.hpp"
#include "core/io/progress.hpp"

namespace wingbeat {
namespace {

// Lines of progress: every cycle at first, then at this spacing.
constexpr int cycles_a_line = 20;

}  // namespace

FlowCycles::FlowCycles(Context& context, const FlowLevel<2>& level, FlowEquations<2>& flow)
    : context_(context),
      level_(level),
      flow_(flow),
      options_(context.settings.pseudo_time.options(flow.model().scheme, 0.0)),
      multigrid_(flow, {level.mesh, level.partition}, options_.multigrid) {
  const auto& asked = context.settings.pseudo_time.levels;
  if (asked && multigrid_.levels() < *asked)
    throw InputError(fmt::format(
        "{} = {}: the mesh gives {} ({}); ask for fewer, or use cell counts divisible by {}",
        context.place("pseudo_time.levels"), *asked, multigrid_.levels(),
        describe_limit<2>(level.mesh, level.partition, least_multigrid_cells), 1 << (*asked - 1)));
}

std::vector<double> FlowCycles::start(const std::vector<MotionState>& motions, double kappa) {
  if (!context_.settings.pseudo_time.full_multigrid) return flow_.uniform_state();
  const auto part = context_.timer.measure("full multigrid");
  std::vector<double> w =
      full_multigrid_start<2>(flow_, {level_.mesh, level_.partition}, motions, kappa, options_,
                              [&](const PseudoTimeIteration&) { return !context_.stop.is_set(); });
  if (context_.stop.is_set()) throw stopped_too_early();
  return w;
}

PseudoTimeResult FlowCycles::solve(std::vector<double>& w, const std::vector<MotionState>& motions,
                                   double kappa, double tolerance, const std::string& stage, History& history,
                                   const Save& save) {
  const auto part = context_.timer.measure("cycles");
  options_.tolerance = tolerance;
  const std::string title =
      fmt::format("{}, {}, Runge-Kutta on {} mesh{}", stage, mesh_size_text<2>(level_.mesh),
                  multigrid_.levels(), multigrid_.levels() == 1 ? "" : "es");
  Progress progress(context_.log, title, {"cycle", "|R|", "CFL"});
  BreakdownWatch watch(context_, level_);
  std::optional<PseudoTimeMemory> earlier;
  if (auto memory = context_.checkpoints.recall(stage)) earlier = unpacked_pseudo_time(*std::move(memory));
  double first = 0.0;
  int retreats = earlier ? earlier->retreats : 0;
  const auto observe = [&](const PseudoTimeIteration& i) {
    history.cycle(stage, i);
    if (first == 0.0) first = i.residual;
    watch.look(w);
    if (i.retreats > retreats)
      context_.log.line("  diverged: back to the last good state, CFL number {:.3g}", i.cfl);
    retreats = i.retreats;
    const double fraction = converged_fraction(first, i.residual, tolerance);
    if (i.cycle % cycles_a_line == 0 || i.residual <= tolerance)
      progress.row(
          {fmt::format("{}", i.cycle), fmt::format("{:.2e}", i.residual), fmt::format("{:.2g}", i.cfl)},
          fraction);
    else
      progress.show(fraction);
    return context_.checkpoints.goes_on([&] {
      save({i.w.begin(), i.w.end()},
           packed(stage, PseudoTimeMemory{i.cycle, i.retreats, i.cfl, {i.good.begin(), i.good.end()}}));
    });
  };
  return pseudo_time<2>(flow_, multigrid_, w, motions, kappa, options_, observe,
                        earlier ? &*earlier : nullptr);
}

SolveFailure stopped_too_early() {
  return {SolveStatus::interrupted,
          "stopped by a signal or --walltime before the finest mesh was reached; begin anew"};
}

std::optional<SolverMemory> memory_of(const std::string& stage, PseudoTimeResult& result) {
  if (!result.memory) return std::nullopt;
  return packed(stage, *std::exchange(result.memory, std::nullopt));
}

std::string cycles_advice(SolveStatus status, double tolerance, const PseudoTimeSettings& settings) {
  switch (status) {
    case SolveStatus::iteration_limit:
      return fmt::format(
          "Runge-Kutta cycles did not bring the flow residual to {:.1e} in pseudo_time.max_cycles = {}; "
          "allow more and continue with --restart and this folder, or let Newton finish with "
          "solver.flow_method = runge_kutta_newton",
          tolerance, settings.max_cycles);
    case SolveStatus::diverged:
      return fmt::format(
          "Runge-Kutta cycles diverged with the CFL number halved pseudo_time.max_retreats = {} times; start "
          "with a smaller pseudo_time.cfl, or from less: a lower flow.mach or amplitude with --restart; or "
          "look at the mesh with `wingbeat mesh`",
          settings.max_retreats);
    case SolveStatus::interrupted:
      return "stopped by a signal or --walltime; continue with --restart and this folder";
    default:
      return "";
  }
}

}  // namespace wingbeat
