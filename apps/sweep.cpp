#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <sstream>
#include <thread>

#include "apps/on_root.hpp"
#include "apps/sweep/sweep_refine.hpp"
#include "apps/sweep/sweep_results.hpp"
#include "apps/sweep_cases.hpp"
#include "apps/sweep_journal.hpp"
#include "apps/sweep_queue.hpp"
#include "apps/verbs.hpp"
#include "core/io/counted.hpp"
#include "core/io/error.hpp"
#include "core/io/progress.hpp"

namespace wingbeat {
namespace {

constexpr auto poll_interval = std::chrono::milliseconds(50);
// The narrowest interval that refinement leaves, as a part of the narrowest asked for.
constexpr double refinement_depth = 1.0 / 16.0;

// The first rank's task on all ranks.
std::optional<SweepQueue::Task> shared(const Comm& comm, std::optional<SweepQueue::Task> task) {
  constexpr double none = -1.0;
  std::array<double, 4> numbers{none, none, none, 0.0};
  if (task) numbers[0] = static_cast<double>(task->point);
  if (task && task->start) numbers[1] = static_cast<double>(*task->start);
  if (task && task->before) {
    numbers[2] = static_cast<double>(task->before->point);
    numbers[3] = task->before->ahead;
  }
  comm.broadcast(numbers);
  if (numbers[0] == none) return std::nullopt;
  task = SweepQueue::Task{.point = static_cast<std::size_t>(numbers[0])};
  if (numbers[1] != none) task->start = static_cast<std::size_t>(numbers[1]);
  if (numbers[2] != none) task->before = PointBefore{static_cast<std::size_t>(numbers[2]), numbers[3]};
  return task;
}

class Sweep {
 public:
  Sweep(Context& context, const SweepPoints& asked)
      : context_(context),
        case_{context.settings, {}, context.sources},
        journal_(context, asked),
        groups_(context.settings.sweep.groups),
        group_(context.comm, context.comm.rank() * groups_ / context.comm.size()),
        agreement_(group_.get()) {
    if (context.comm.is_root()) shown_ = journal_.lines().size();
  }

  SolveStatus run();

 private:
  bool run_pending();
  void work(SweepQueue& queue);
  SweepOutcome solve(const SweepQueue::Task& task);
  void wait(SweepQueue& queue);
  bool refine();
  std::vector<std::string> refined_values() const;
  void show_news(const SweepQueue::Count& count);
  SolveStatus end(bool is_complete);

  Context& context_;
  ResolvedCase case_;
  SweepJournal journal_;
  int groups_;
  SplitComm group_;
  FailureAgreement agreement_;
  KeptFactors kept_factors_{};
  int refined_ = 0;                       // points added so far
  double narrowest_ = 0.0;                // interval asked for
  std::size_t shown_ = 0;                 // lines of the journal already shown, on rank 0
  std::unique_ptr<Progress> progress_{};  // rank 0
};

SweepOutcome Sweep::solve(const SweepQueue::Task& task) {
  std::optional<CaseSettings> settings;
  const std::string fault = first_failure(
      group_.get(), failure_of([&] { settings = point_settings(case_, journal_.points(), task.point); }));
  if (!fault.empty()) return {.status = "error", .reason = message_of(fault)};
  std::optional<Neighbour> neighbour;
  if (task.start && context_.settings.sweep.continuation) {
    neighbour = Neighbour{.folder = journal_.folder(*task.start)};
    if (task.before) {
      neighbour->before = journal_.folder(task.before->point);
      neighbour->ahead = task.before->ahead;
    }
  }
  return run_sweep_point(context_, group_.get(), agreement_,
                         {context_.settings.sweep.verb, *settings, journal_.folder(task.point),
                          journal_.is_begun(task.point), neighbour, kept_factors_});
}

// This group's share of the points.
void Sweep::work(SweepQueue& queue) {
  const Comm& comm = group_.get();
  std::optional<std::size_t> last;
  while (true) {
    const bool is_stopped = StopRequest(comm, context_.stop).is_set();
    std::optional<SweepQueue::Task> task;
    if (comm.is_root()) {
      if (is_stopped) queue.stop();
      task = queue.take(last, [&](std::size_t point) { journal_.record_begin(point); });
    }
    task = shared(comm, task);
    if (!task) break;
    const SweepOutcome outcome = solve(*task);
    const bool is_done = outcome.status == "converged", is_interrupted = outcome.status == "interrupted";
    on_root(comm, [&] {
      const PointState state = is_done          ? PointState::done
                               : is_interrupted ? PointState::pending
                                                : PointState::failed;
      queue.finish(task->point, state, [&] {
        if (!is_interrupted) journal_.record(task->point, task->start, outcome);
      });
      if (is_interrupted) queue.stop();
      if (context_.comm.is_root()) show_news(queue.count());
    });
    if (is_done) last = task->point;
  }
}

// Until all groups have left; rank 0 tells of what they find.
void Sweep::wait(SweepQueue& queue) {
  while (true) {
    const SweepQueue::Count count = queue.count();
    if (context_.comm.is_root()) show_news(count);
    if (count.groups == groups_) break;
    std::this_thread::sleep_for(poll_interval);
  }
  context_.comm.barrier();
}

// Runs what is pending; false when stopped before the end.
bool Sweep::run_pending() {
  if (journal_.count(PointState::pending) == 0) return true;
  SweepQueue queue(context_.comm, places_of(journal_.points()), journal_.states());
  work(queue);
  if (group_.get().is_root()) queue.leave();
  wait(queue);
  journal_.settle(queue.states());
  return journal_.count(PointState::pending) == 0;
}

void Sweep::show_news(const SweepQueue::Count& count) {
  const std::vector<SweepLine> lines = journal_.lines();
  if (!progress_)
    progress_ = std::make_unique<Progress>(
        context_.log, "points of " + context_.settings.sweep.verb,
        std::vector<std::string>{"point", "V", "omega", "status", "s", "done", "failed", "left"});
  const int all = count.done + count.failed + count.left;
  for (; shown_ < lines.size(); ++shown_) {
    const SweepLine& line = lines[shown_];
    std::vector<std::string> values;
    for (const auto& [key, value] : line["parameters"].items()) values.push_back(value.dump());
    const auto number = [&](const char* name) {
      const bool is_there = !line["results"].empty() && line["results"][0].contains(name);
      return is_there ? fmt::format("{:.6f}", line["results"][0][name].get<double>()) : std::string("-");
    };
    progress_->row(
        {fmt::format("{}", fmt::join(values, ",")), number("reduced_velocity"), number("frequency_ratio"),
         line["status"].get<std::string>(), fmt::format("{:.1f}", line["seconds"].get<double>()),
         fmt::format("{}", count.done), fmt::format("{}", count.failed), fmt::format("{}", count.left)},
        1.0 - static_cast<double>(count.left) / all);
  }
}

// Values that refinement adds, on rank 0.
std::vector<std::string> Sweep::refined_values() const {
  const std::vector<SweepLine> lines = journal_.lines();
  std::map<double, std::vector<double>> curve;
  for (std::size_t point = 0; point < journal_.states().size(); ++point) {
    auto& values = curve[*number_in(journal_.points().values[point][0])];
    for (const SweepLine& line : lines)
      if (line["point"] == journal_.number(point))
        values = curve_values(context_.settings.sweep.verb, line["results"]);
  }
  std::vector<CurvePoint> points;
  for (const auto& [place, values] : curve) points.push_back({place, values});
  const SweepSettings& sweep = context_.settings.sweep;
  std::vector<std::string> values;
  for (const double place :
       refined_places(points, sweep.refine_tolerance, refinement_depth * narrowest_, sweep.refine - refined_))
    values.push_back(fmt::format("{:.12g}", place));
  return values;
}

// Adds points where the curve bends; false where there is nothing to add.
bool Sweep::refine() {
  if (context_.settings.sweep.refine == refined_) return false;
  std::string text;
  on_root(context_.comm, [&] { text = fmt::format("{}", fmt::join(refined_values(), "\n")); });
  text = context_.comm.broadcast(text);
  if (text.empty()) return false;
  std::vector<std::string> values;
  std::istringstream lines(text);
  for (std::string value; std::getline(lines, value);) values.push_back(value);
  journal_.add(values);
  refined_ += static_cast<int>(values.size());
  context_.log.line("{} points more where the curve bends", values.size());
  return true;
}

SolveStatus Sweep::end(bool is_complete) {
  const long all = static_cast<long>(journal_.states().size());
  const long done = journal_.count(PointState::done), failed = journal_.count(PointState::failed);
  context_.result.findings["sweep"] = {
      {"points", all}, {"done", done}, {"failed", failed}, {"left", all - done - failed}};
  std::string& message = context_.result.message;
  message = fmt::format("{} of {} points done", done, all);
  if (!is_complete) {
    message += "; stopped by a signal or --walltime; the same command goes on with the rest";
    return SolveStatus::interrupted;
  }
  if (failed == 0) return SolveStatus::converged;
  message += fmt::format(
      "; {} failed, for the reasons in sweep.csv; the same command with --retry-failed tries "
      "these again",
      failed);
  return SolveStatus::stalled;
}

SolveStatus Sweep::run() {
  if (context_.settings.sweep.refine > 0) {
    std::vector<double> places;
    for (const auto& values : journal_.points().values) places.push_back(*number_in(values[0]));
    std::ranges::sort(places);
    narrowest_ = places.back() - places.front();
    for (std::size_t i = 1; i < places.size(); ++i)
      narrowest_ = std::min(narrowest_, places[i] - places[i - 1]);
  }
  context_.log.line("{} points, {} done before; {} of ranks", journal_.states().size(),
                    journal_.count(PointState::done), counted(groups_, "group"));
  const auto part = context_.timer.measure("points");
  bool is_complete = run_pending();
  while (is_complete && refine()) is_complete = run_pending();
  progress_.reset();
  return end(is_complete);
}

}  // namespace

std::vector<std::string> sweep_faults(const CaseSettings& settings) {
  try {
    const SweepPoints points = sweep_points(settings.sweep);
    const bool is_curve = points.keys.size() == 1 && std::ranges::all_of(points.values, [](const auto& v) {
                            return number_in(v[0]).has_value();
                          });
    if (settings.sweep.refine > 0 && !is_curve)
      return {"sweep.refine: points can be added for one parameter that is a number; leave it out"};
  } catch (const InputError& error) {
    return {error.what()};
  }
  return {};
}

std::string sweep_plan(const ResolvedCase& sweep) {
  const SweepPoints points = sweep_points(sweep.settings.sweep);
  for (std::size_t point = 0; point < points.values.size(); ++point) point_settings(sweep, points, point);
  return fmt::format("{} points of {}, from {} to {}", points.values.size(), sweep.settings.sweep.verb,
                     point_label(points, 0), point_label(points, points.values.size() - 1));
}

CaseSettings largest_sweep_case(const ResolvedCase& sweep) {
  const SweepPoints points = sweep_points(sweep.settings.sweep);
  const auto size = [](const CaseSettings& settings) {
    return static_cast<double>(settings.mesh.cells[0]) * settings.mesh.cells[1] * settings.time.harmonics;
  };
  CaseSettings largest = point_settings(sweep, points, 0);
  for (std::size_t point = 1; point < points.values.size(); ++point)
    if (CaseSettings settings = point_settings(sweep, points, point); size(settings) > size(largest))
      largest = std::move(settings);
  return largest;
}

SolveStatus run_sweep(Context& context) {
  const SweepPoints points = sweep_points(context.settings.sweep);
  on_root(context.comm, [&] { sweep_plan({context.settings, {}, context.sources}); });
  if (context.settings.sweep.groups > context.comm.size())
    throw InputError(fmt::format("{} = {}: the run has {}; give as many groups at most",
                                 context.place("sweep.groups"), context.settings.sweep.groups,
                                 counted(context.comm.size(), "rank")));
  return Sweep(context, points).run();
}

}  // namespace wingbeat
