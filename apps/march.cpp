#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/case_mesh.hpp"
#include "apps/flow_setup.hpp"
#include "apps/linear_flutter_output.hpp"
#include "apps/march_run.hpp"
#include "apps/restart.hpp"
#include "apps/solution_names.hpp"
#include "apps/steady_stage.hpp"
#include "apps/verbs.hpp"
#include "core/io/error.hpp"
#include "core/spectral/mean_instance.hpp"
#include "structure/energy.hpp"
#include "structure/growth_bracket.hpp"

namespace wingbeat {
namespace {

constexpr double least_energy = 1e-6;  // of a start that the case does not describe
constexpr double search_share = 0.01;  // of march.small_energy, the most that a march of a search starts with
constexpr int max_marches = 15;
constexpr const char* stopped = "stopped by a signal or --walltime; continue with --restart and this folder";

// What a march begins with.
struct MarchStart {
  SolveStatus status = SolveStatus::converged;
  TimeLevels levels;
  RestState rest;
};

class MarchCase {
 public:
  explicit MarchCase(Context& context)
      : context_(context),
        settings_(context.settings),
        model_(structure_model(typical_section(settings_.structure))),
        levels_(make_levels<2>(context, make_plane_mesh(context.comm, settings_.mesh))),
        level_(*levels_.back()),
        history_(context) {}

  SolveStatus run();

 private:
  SolveStatus find_flutter(Marcher& marcher, const MarchStart& start);
  MarchStart begin();
  MarchStart from_stored(StoredSolution stored);
  RestState rest_at(double reduced_velocity);
  TimeLevels disturbed(const RestState& rest, double reduced_velocity) const;
  double energy_of(std::span<const double> y, const RestState& rest) const;
  std::optional<GrowthAtSpeed> growth_of(const MarchRun& run, const RestState& rest) const;
  TimeLevels shrunk(const TimeLevels& levels, const RestState& from, const RestState& to,
                    double reduced_velocity) const;
  MarchCriteria criteria() const;
  double speed(std::optional<double> stored = {}) const;
  void finish(const MarchRun& run);

  Context& context_;
  const CaseSettings& settings_;
  StructureModel model_;
  FlowLevels<2> levels_;
  FlowLevel<2>& level_;
  History history_;
};

MarchCriteria MarchCase::criteria() const {
  const MarchSettings& march = settings_.march;
  return {march.growth_tolerance, std::nullopt, march.energy_tolerance, march.small_energy};
}

double MarchCase::speed(std::optional<double> stored) const {
  if (settings_.march.reduced_velocity) return *settings_.march.reduced_velocity;
  if (stored) return *stored;
  throw InputError(
      "march.reduced_velocity: missing; wingbeat march needs it, or a --restart that has a speed: V = U/(c "
      "omega_alpha) (number, > 0)");
}

// The section's equilibrium at a speed. The level holds the steady flow about it undeflected.
RestState MarchCase::rest_at(double reduced_velocity) {
  const std::vector<MotionState> unmoved{at_rest(settings_)};
  if (!is_deflected(level_.steady.loads(level_.w, unmoved)[0]))
    return {level_.w, std::vector<double>(4, 0.0)};
  const auto part = context_.timer.measure("equilibrium");
  AeroelasticState state = static_equilibrium<2>(level_, model_, section_kinematics(settings_),
                                                 reduced_velocity, linear_flutter_options(context_));
  return {std::move(state.w), std::move(state.y)};
}

// The flow at rest and the section pushed off.
TimeLevels MarchCase::disturbed(const RestState& rest, double reduced_velocity) const {
  const MarchSettings& march = settings_.march;
  std::vector<double> push{march.initial_plunge, march.initial_pitch_deg * std::numbers::pi / 180.0,
                           march.initial_plunge_rate, march.initial_pitch_rate.value_or(0.0)};
  if (!march.initial_pitch_rate && average_energy(model_, push) == 0.0)
    push[3] = std::sqrt(2.0 * least_energy / model_.mass(pitch_mode, pitch_mode));
  for (std::size_t j = 0; j < push.size(); ++j) push[j] += rest.y[j];
  return {{rest.w}, {push}, march.time_step(), reduced_velocity, rest.y};
}

double MarchCase::energy_of(std::span<const double> y, const RestState& rest) const {
  std::vector<double> departure(y.begin(), y.end());
  for (std::size_t j = 0; j < departure.size(); ++j) departure[j] -= rest.y[j];
  return average_energy(model_, departure);
}

// Of motion that outgrew march.small_energy before its rate was known, the energy tells that it grows, and
// the rate to no better than itself. Nothing where neither is known.
std::optional<GrowthAtSpeed> MarchCase::growth_of(const MarchRun& run, const RestState& rest) const {
  const double v = run.levels.reduced_velocity, energy = energy_of(run.levels.y.front(), rest);
  const auto& growth = run.summary.assessment.growth;
  const bool is_large = energy > settings_.march.small_energy;
  if (growth && (!is_large || growth->rate > growth->rate_error))
    return GrowthAtSpeed{v, growth->rate, growth->rate_error, growth->frequency, growth->frequency_error};
  if (!is_large) return std::nullopt;
  const double time = static_cast<double>(run.summary.time_steps) * run.levels.dtau;
  const auto start = std::span<const double>(run.levels.progress.record).first(4);
  const double rate = 0.5 * std::log(energy / energy_of(start, rest)) / time;
  return GrowthAtSpeed{v, rate, rate, 1.0, 1.0};
}

// The motion of some levels, about rest at another speed and as small as a start is.
TimeLevels MarchCase::shrunk(const TimeLevels& levels, const RestState& from, const RestState& to,
                             double reduced_velocity) const {
  const double energy = std::min(least_energy, search_share * settings_.march.small_energy);
  const double factor = std::sqrt(energy / energy_of(levels.y.front(), from));
  TimeLevels result = levels;
  result.reduced_velocity = reduced_velocity;
  result.rest_y = to.y;
  for (std::size_t k = 0; k < result.w.size(); ++k)
    for (std::size_t i = 0; i < result.w[k].size(); ++i)
      result.w[k][i] = to.w[i] + factor * (result.w[k][i] - from.w[i]);
  for (auto& y : result.y)
    for (std::size_t j = 0; j < y.size(); ++j) y[j] = to.y[j] + factor * (y[j] - from.y[j]);
  return result;
}

MarchProgress progress_of(StoredSolution stored) {
  using namespace solution_names;
  return {std::move(stored.data[record_name]), std::move(stored.data[rows_name]),
          std::move(stored.data[search_name]), std::move(stored.text[entries_name]),
          std::move(stored.memory)};
}

// From a period, or from the levels of an earlier march.
MarchStart MarchCase::from_stored(StoredSolution stored) {
  MarchStart start;
  AeroelasticState& state = stored.state;
  const double stored_v = stored.data.contains(solution_names::reduced_velocity_name)
                              ? stored.data[solution_names::reduced_velocity_name].at(0)
                              : section_kinematics(settings_).reduced_velocity(state.r);
  const double dtau = settings_.march.time_step();
  const bool same_step = stored.time_step() && std::abs(*stored.time_step() - dtau) <= 1e-9 * dtau;
  const bool goes_on = same_step && stored.memory && stored.memory->stage == march_stage(context_);
  const double v = goes_on ? stored_v : speed(stored_v);
  const int order = settings_.march.order;
  start.levels.dtau = dtau;
  start.levels.reduced_velocity = v;
  if (!stored.time_step()) {
    const TimeSpectral time((stored.instances() - 1) / 2);
    start.levels.w = periodic_history(time, state.w, state.omega, dtau, order + 1);
    start.levels.y = periodic_history(time, state.y, state.omega, dtau, order + 1);
    start.rest = {mean_instance(state.w, time), mean_instance(state.y, time)};
  } else {
    const std::size_t count = level_.domain.state_count();
    if (!same_step)
      context_.log.line("{}: its time step is {:.6g}, not {:.6g}: goes on from its last level alone",
                        context_.restart->string(), *stored.time_step(), dtau);
    for (std::size_t k = 0; k < (same_step ? static_cast<std::size_t>(stored.instances()) : 1); ++k) {
      start.levels.w.emplace_back(state.w.begin() + static_cast<std::ptrdiff_t>(k * count),
                                  state.w.begin() + static_cast<std::ptrdiff_t>((k + 1) * count));
      start.levels.y.emplace_back(state.y.begin() + static_cast<std::ptrdiff_t>(4 * k),
                                  state.y.begin() + static_cast<std::ptrdiff_t>(4 * (k + 1)));
    }
    start.rest.y = stored.rest_y();
    if (goes_on) start.levels.progress = progress_of(std::move(stored));
  }
  start.levels.rest_y = start.rest.y;
  return start;
}

MarchStart MarchCase::begin() {
  std::optional<MarchStart> start;
  if (context_.restart) {
    StoredSolution stored = read_stored_solution(context_, level_, *context_.restart);
    if (stored.time_step() || stored.instances() > 1)
      start = from_stored(std::move(stored));
    else
      level_.w = std::move(stored.state.w);
  }
  if (start && !context_.find_flutter) return *std::move(start);
  const double v = start ? start->levels.reduced_velocity : speed();
  const SolveStatus steady = run_steady_stage(context_, levels_, history_);
  if (steady != SolveStatus::converged) return {steady, {}, {}};
  RestState rest = rest_at(v);
  if (!start) return {SolveStatus::converged, disturbed(rest, v), std::move(rest)};
  start->rest = std::move(rest);
  return *std::move(start);
}

void MarchCase::finish(const MarchRun& run) {
  const auto part = context_.timer.measure("output");
  write_time_levels(context_, level_, run.levels);
  print_march(context_, run.summary);
}

// Speeds whose growth is known, as a checkpoint holds them.
std::vector<double> numbers_of(const std::vector<GrowthAtSpeed>& points) {
  std::vector<double> numbers;
  for (const GrowthAtSpeed& p : points)
    numbers.insert(numbers.end(), {p.reduced_velocity, p.rate, p.rate_error, p.frequency, p.frequency_error});
  return numbers;
}

std::vector<GrowthAtSpeed> points_of(const std::vector<double>& numbers) {
  std::vector<GrowthAtSpeed> points;
  for (std::size_t i = 0; i + 5 <= numbers.size(); i += 5)
    points.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3], numbers[i + 4]});
  return points;
}

SolveStatus MarchCase::find_flutter(Marcher& marcher, const MarchStart& start) {
  const double tolerance = settings_.march.velocity_tolerance;
  const std::vector<GrowthAtSpeed> known = points_of(start.levels.progress.search);
  GrowthBracket search(known.empty() ? start.levels.reduced_velocity : known.front().reduced_velocity,
                       {.tolerance = tolerance});
  for (const GrowthAtSpeed& point : known) search.add(point);
  RestState rest = start.rest;
  TimeLevels levels = start.levels.progress.memory
                          ? start.levels
                          : shrunk(start.levels, rest, rest, start.levels.reduced_velocity);
  MarchRun run;
  auto marches = nlohmann::ordered_json::array();
  if (!levels.progress.entries.empty()) marches = nlohmann::ordered_json::parse(levels.progress.entries);
  while (!search.is_found() && !search.is_exhausted()) {
    if (search.points().size() == max_marches) {
      context_.result.message = fmt::format(
          "the flutter speed was not enclosed to march.velocity_tolerance = {:g} by {} marches; allow longer "
          "march.periods, or start nearer",
          tolerance, max_marches);
      return SolveStatus::iteration_limit;
    }
    MarchCriteria wanted = criteria();
    wanted.rate_tolerance = search.rate_tolerance();
    wanted.energy_tolerance = 0.0;  // small motion only
    wanted.ends_when_large = true;
    run = marcher.run(levels, rest, wanted, "verdict");
    context_.result.findings["march"] = march_entry(settings_, run.summary);
    marches.push_back(context_.result.findings["march"]);
    context_.result.findings["marches"] = marches;
    finish(run);
    const bool is_marched =
        run.status == SolveStatus::converged || run.status == SolveStatus::iteration_limit;
    if (run.status == SolveStatus::interrupted) {
      context_.result.message = stopped;
      return run.status;
    }
    const auto point = is_marched ? growth_of(run, rest) : std::nullopt;
    if (!point) {
      context_.result.message = fmt::format(
          "the march at V = {:.6f} ended without a growth rate: {}; take more march.steps_per_period, allow "
          "longer march.periods, or start nearer",
          levels.reduced_velocity, to_string(run.status));
      return run.status == SolveStatus::converged ? SolveStatus::stalled : run.status;
    }
    search.add(*point);
    const double next = search.next();
    RestState there = rest_at(next);
    levels = shrunk(run.levels, rest, there, next);
    levels.progress = {};
    levels.progress.search = numbers_of(search.points());
    levels.progress.entries = marches.dump();
    rest = std::move(there);
  }
  const GrowthCrossing at = *search.crossing();
  auto entry = flutter_point(settings_, at.reduced_velocity, at.frequency);
  entry["reduced_velocity_error"] = at.reduced_velocity_error;
  entry["frequency_error"] = at.frequency_error;
  entry["growth_slope"] = at.slope;
  entry["growth_rate"] = 0.0;
  context_.result.findings["flutter"] = entry;
  context_.result.message =
      fmt::format("V_F = {:.6f} +- {:.1e}, omega = {:.6f} +- {:.1e}, by {} marches", at.reduced_velocity,
                  at.reduced_velocity_error, at.frequency, at.frequency_error, search.points().size());
  context_.log.line("{}", context_.result.message);
  return search.is_found() ? SolveStatus::converged : SolveStatus::stalled;
}

SolveStatus MarchCase::run() {
  MarchStart start = begin();
  if (start.status != SolveStatus::converged) return start.status;
  const MarchSettings& march = settings_.march;
  if (!context_.find_flutter && is_complete(context_, model_, start.levels, criteria(), march.until)) {
    context_.log.line("the march has come to its end: a new one begins from its levels");
    start.levels.progress = {};
  }
  MarchTable table(context_, std::move(start.levels.progress.rows));
  Marcher marcher(context_, level_, model_, table);
  if (context_.find_flutter) return find_flutter(marcher, start);
  const MarchRun run = marcher.run(start.levels, start.rest, criteria(), march.until, march.snapshots);
  context_.result.findings["march"] = march_entry(settings_, run.summary);
  finish(run);
  const auto verdict = to_string(run.summary.assessment.verdict);
  switch (run.status) {
    case SolveStatus::converged:
      context_.result.message = fmt::format("V = {:.6f}: {}", start.levels.reduced_velocity, verdict);
      break;
    case SolveStatus::iteration_limit:
      context_.result.message =
          "no verdict in the time allowed; allow more march.periods and continue with --restart "
          "and this folder";
      break;
    case SolveStatus::interrupted:
      context_.result.message = stopped;
      break;
    default:
      context_.result.message =
          "a time step was not solved; take more march.steps_per_period, or start from less energy";
  }
  return run.status;
}

}  // namespace

SolveStatus run_march(Context& context) { return MarchCase(context).run(); }

}  // namespace wingbeat
