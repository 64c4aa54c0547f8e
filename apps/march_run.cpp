#include "apps/march_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "apps/breakdown.hpp"
#include "apps/flow_setup.hpp"
#include "apps/memory_packing.hpp"
#include "core/io/progress.hpp"
#include "structure/energy.hpp"
#include "structure/harmonic_motion.hpp"

namespace wingbeat {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
// Verdicts are sought this often, and not before so many periods of uncoupled pitch.
constexpr double assessed_every = 0.5;
constexpr double assessed_from = 4.0;
constexpr int amplitude_instances = 33;

DualTimeOptions dual_time_options(const Context& context) {
  const CaseSettings& settings = context.settings;
  DualTimeOptions options;
  options.order = settings.march.order;
  options.tolerance = settings.march.tolerance;
  options.by_cycles = settings.solver.flow_solver() == "runge_kutta";
  options.max_cycles = settings.pseudo_time.max_cycles;
  options.max_retreats = settings.pseudo_time.max_retreats;
  options.gmres = gmres_options(settings.solver);
  if (options.by_cycles)
    options.multigrid =
        settings.pseudo_time.options(flow_model<2>(settings.flow).scheme, options.tolerance).multigrid;
  return options;
}

double energy_about(const StructureModel& model, std::span<const double> y, const std::vector<double>& rest) {
  std::vector<double> departure(y.begin(), y.end());
  for (std::size_t i = 0; i < departure.size(); ++i) departure[i] -= rest[i];
  return average_energy(model, departure);
}

bool ends(MarchVerdict verdict, const std::string& until) {
  if (until == "end" || verdict == MarchVerdict::undecided) return false;
  return !(until == "limit_cycle" && verdict == MarchVerdict::grows);
}

long steps_in(double periods, double dtau) { return std::max(1L, std::lround(periods * turn / dtau)); }

// Verdicts are sought after so many steps.
bool is_judged_after(long steps, double dtau) {
  return steps % steps_in(assessed_every, dtau) == 0 && steps >= steps_in(assessed_from, dtau);
}

// What was found when it was last sought.
MarchAssessment last_assessment(const StructureModel& model, std::span<const double> record, double dtau,
                                const MarchCriteria& criteria) {
  long steps = static_cast<long>(record.size() / 4) - 1;
  while (steps > 0 && !is_judged_after(steps, dtau)) --steps;
  if (steps <= 0) return {};
  return assess(model, {record.first(4 * static_cast<std::size_t>(steps + 1)), dtau}, criteria);
}

}  // namespace

std::string march_stage(const Context& context) { return context.find_flutter ? "search" : "march"; }

bool is_complete(const Context& context, const StructureModel& model, const TimeLevels& levels,
                 const MarchCriteria& criteria, const std::string& until) {
  const MarchProgress& progress = levels.progress;
  if (!progress.memory || !unpacked_march(*progress.memory).is_over) return false;
  const long steps = static_cast<long>(progress.record.size() / 4) - 1;
  return steps >= steps_in(context.settings.march.periods, levels.dtau) ||
         ends(last_assessment(model, progress.record, levels.dtau, criteria).verdict, until);
}

// A march under way.
struct Marcher::March {
  const RestState& rest;
  double reduced_velocity;
  SectionLoads<2> flow;
  std::unique_ptr<TimeMarching> structure;
  std::vector<double> record;  // states of all steps
  const MarchProgress& before;
  long steps = 0;
};

Marcher::Marcher(Context& context, FlowLevel<2>& level, const StructureModel& model, MarchTable& table)
    : context_(context),
      level_(level),
      model_(model),
      table_(table),
      flow_(level, dual_time_options(context)) {}

SolveStatus Marcher::advance(March& march, bool is_kept) {
  const TimeStepResult result = march.structure->step();
  if (result.status == SolveStatus::diverged) note_breakdown(context_, level_, flow_.w());
  if (result.status != SolveStatus::converged) return result.status;
  const std::span<const double> y = march.structure->y();
  march.record.insert(march.record.end(), y.begin(), y.end());
  ++march.steps;
  table_.add({.time = static_cast<double>(march.steps) * march.structure->dtau(),
              .reduced_velocity = march.reduced_velocity,
              .energy = energy_about(model_, y, march.rest.y),
              .y = y,
              .loads = march.flow.loads(),
              .flow_iterations = march.flow.iterations(),
              .coupling_iterations = result.iterations});
  const bool goes_on = is_kept ? context_.checkpoints.goes_on(
                                     [&] { write_time_levels(context_, level_, levels_of(march, false)); })
                               : !context_.stop.is_set();
  return goes_on ? SolveStatus::converged : SolveStatus::interrupted;
}

void Marcher::go_on(March& march, const MarchProgress& progress) {
  if (!progress.memory) return;
  MarchMemory memory = unpacked_march(*progress.memory);
  flow_.resume(memory.flow);
  march.structure->resume(std::move(memory.structure));
  march.record = progress.record;
  march.steps = static_cast<long>(march.record.size() / 4) - 1;
  context_.log.line("the march goes on after {} steps", march.steps);
}

void Marcher::summarize(const March& march, MarchSummary& summary) const {
  if (!summary.assessment.last) return;
  const std::vector<double> period = sampled_period(model_, {march.record, march.structure->dtau()},
                                                    *summary.assessment.last, amplitude_instances);
  const Eigen::VectorXcd u = first_harmonic(model_, TimeSpectral((amplitude_instances - 1) / 2), period);
  summary.pitch_amplitude_deg = std::abs(u[pitch_mode]) * 180.0 / std::numbers::pi;
  summary.plunge_amplitude = std::abs(u[plunge_mode]);
}

MarchRun Marcher::run(const TimeLevels& start, const RestState& rest, const MarchCriteria& criteria,
                      const std::string& until, int snapshots) {
  const auto part = context_.timer.measure("march");
  const MarchSettings& settings = context_.settings.march;
  const double v = start.reduced_velocity;
  flow_.start(start.w);
  March march{
      rest,          v, SectionLoads<2>(flow_, section_kinematics(context_.settings), v), {}, start.y.front(),
      start.progress};
  march.structure = std::make_unique<TimeMarching>(
      model_, model_.load(v), start.dtau, march.flow,
      TimeMarchingOptions{.order = settings.order, .tolerance = settings.tolerance});
  march.structure->start(start.y);
  go_on(march, start.progress);

  MarchRun run;
  run.summary.reduced_velocity = v;
  MarchAssessment& found = run.summary.assessment;
  run.status = march_to_verdict(march, criteria, until, found);
  summarize(march, run.summary);
  const bool is_over = run.status == SolveStatus::converged || run.status == SolveStatus::iteration_limit;
  const bool has_snapshots = is_over && snapshots > 0 && found.last;
  run.summary.time_steps = march.steps;
  run.levels = levels_of(march, is_over && !has_snapshots);
  if (!has_snapshots) return run;
  const SolveStatus status = take_snapshots(march, found, snapshots);
  if (status == SolveStatus::converged) {
    run.summary.time_steps = march.steps;
    run.levels = levels_of(march, true);
  } else {
    run.status = status;  // the levels are those that the snapshots began with, and begin with again
  }
  return run;
}

TimeLevels Marcher::levels_of(const March& march, bool is_over) const {
  TimeLevels levels{flow_.history(), march.structure->history(), march.structure->dtau(),
                    march.reduced_velocity, march.rest.y};
  // There is no going on from within a step that failed.
  if (flow_.is_open()) return levels;
  levels.progress = {
      march.record, table_.rows(), march.before.search, march.before.entries,
      packed(march_stage(context_), MarchMemory{is_over, flow_.memory(), march.structure->memory()})};
  return levels;
}

// Whether the march is over because the motion has grown large.
bool Marcher::is_too_large(const March& march, const MarchCriteria& criteria) const {
  return criteria.ends_when_large &&
         energy_about(model_, march.structure->y(), march.rest.y) > criteria.small_energy;
}

SolveStatus Marcher::march_to_verdict(March& march, const MarchCriteria& criteria, const std::string& until,
                                      MarchAssessment& found) {
  const double dtau = march.structure->dtau();
  const long most = steps_in(context_.settings.march.periods, dtau), line = steps_in(1.0, dtau);
  Progress progress(context_.log, fmt::format("march at V = {:.6f}", march.reduced_velocity),
                    {"periods", "E", "growth", "+-", "flow"});
  int flow_iterations = 0;
  // A march that goes on is judged as it was when it was left.
  found = last_assessment(model_, march.record, dtau, criteria);
  bool is_large = march.steps > 0 && is_too_large(march, criteria);
  if (is_large) found = assess(model_, {march.record, dtau}, criteria);
  while (!is_large && march.steps < most && !ends(found.verdict, until)) {
    const SolveStatus status = advance(march, true);
    if (status != SolveStatus::converged) return status;
    flow_iterations += march.flow.iterations();
    is_large = is_too_large(march, criteria);
    if (is_large || is_judged_after(march.steps, dtau))
      found = assess(model_, {march.record, dtau}, criteria);
    if (is_large) break;
    const double fraction = static_cast<double>(march.steps) / static_cast<double>(most);
    if (march.steps % line != 0) {
      progress.show(fraction);
      continue;
    }
    const double energy = energy_about(model_, march.structure->y(), march.rest.y);
    const auto& growth = found.growth;
    progress.row({fmt::format("{}", march.steps / line), fmt::format("{:.3e}", energy),
                  growth ? fmt::format("{:+.3e}", growth->rate) : "",
                  growth ? fmt::format("{:.0e}", growth->rate_error) : "",
                  fmt::format("{:.1f}", static_cast<double>(flow_iterations) / static_cast<double>(line))},
                 fraction);
    flow_iterations = 0;
  }
  const bool is_known = found.verdict != MarchVerdict::undecided || until == "end";
  return is_known ? SolveStatus::converged : SolveStatus::iteration_limit;
}

SolveStatus Marcher::take_snapshots(March& march, const MarchAssessment& found, int snapshots) {
  const double dtau = march.structure->dtau();
  const MarchedPeriod& last = *found.last;
  const double begin = phase_at_begin(model_, {march.record, dtau}, last);
  const auto phase_at = [&](long step) {
    return begin + turn * (static_cast<double>(step) * dtau - last.begin) / last.period;
  };
  const double first = turn * std::ceil(phase_at(march.steps + 1) / turn);
  SurfaceTable surface;
  while (surface.instances() < snapshots) {
    const SolveStatus status = advance(march, false);
    if (status != SolveStatus::converged) return status;
    // The step nearest to the phase wanted.
    const double wanted = first + turn * static_cast<double>(surface.instances()) / snapshots;
    const double phase = phase_at(march.steps), half = 0.5 * turn * dtau / last.period;
    if (phase + half > wanted) surface.add(context_, level_, phase - first, flow_.w(), march.structure->y());
  }
  surface.write(context_);
  return SolveStatus::converged;
}

}  // namespace wingbeat
