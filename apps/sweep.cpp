#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <sstream>
#include <thread>

#include "apps/case_keys.hpp"
#include "apps/on_root.hpp"
#include "apps/run_case.hpp"
#include "apps/sweep/sweep_record.hpp"
#include "apps/sweep/sweep_refine.hpp"
#include "apps/sweep/sweep_results.hpp"
#include "apps/sweep_cases.hpp"
#include "apps/sweep_point.hpp"
#include "apps/sweep_queue.hpp"
#include "apps/verbs.hpp"
#include "core/io/file.hpp"
#include "core/io/progress.hpp"

namespace wingbeat {
namespace {

constexpr auto poll_interval = std::chrono::milliseconds(50);
// The narrowest interval that refinement leaves, as a part of the narrowest asked for.
constexpr double refinement_depth = 1.0 / 16.0;

// What the points' results depend on, besides the parameters.
SweepLine record_head(const ResolvedCase& sweep, const SweepPoints& points) {
  const Verb& verb = find_verb(sweep.settings.sweep.verb);
  const auto sections = verb.sections_of ? verb.sections_of(sweep.settings) : verb.sections;
  const SweepLine all = key_values(sweep.settings, sections);
  SweepLine keys = SweepLine::object();
  for (const auto& [key, value] : all.items())
    if (std::ranges::find(points.keys, key) == points.keys.end() && !key.starts_with("partition."))
      keys[key] = value;
  return {{"verb", verb.name}, {"parameters", points.keys}, {"case", std::move(keys)}};
}

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
        points_(asked),
        head_(record_head(case_, asked)),
        record_(context.output / "sweep.jsonl"),
        groups_(std::min(context.settings.sweep.groups, context.comm.size())),
        group_(context.comm, context.comm.rank() * groups_ / context.comm.size()),
        agreement_(group_.get()) {}

  SolveStatus run();

 private:
  void resume();
  void take_over(std::size_t point, const std::vector<SweepLine>& lines);
  bool run_pending();
  void work(SweepQueue& queue);
  SweepOutcome solve(const SweepQueue::Task& task);
  void record(std::size_t point, const std::optional<std::size_t>& start, const SweepOutcome& outcome);
  void wait(SweepQueue& queue);
  bool refine();
  std::vector<std::string> refined_values();
  void show_news(const SweepQueue::Count& count);
  SolveStatus end(bool is_complete);

  std::vector<SweepLine> recorded() const;
  std::filesystem::path folder(std::size_t point) const {
    return context_.output / "points" / fmt::format("{:04}", numbers_[point]);
  }

  Context& context_;
  ResolvedCase case_;
  SweepPoints points_;
  SweepLine head_;
  std::filesystem::path record_;
  int groups_;
  SplitComm group_;
  FailureAgreement agreement_;
  std::vector<int> numbers_;  // of each point: its folder
  std::vector<PointState> states_;
  int next_number_ = 1;
  int refined_ = 0;                       // points added so far
  double narrowest_ = 0.0;                // interval asked for
  std::size_t shown_ = 0;                 // lines of the record already shown
  std::unique_ptr<Progress> progress_{};  // rank 0
};

std::vector<SweepLine> Sweep::recorded() const {
  return read_sweep_lines(read_file(record_), record_.string(), head_);
}

// What an earlier run found is not computed again. A last line that was cut short is removed.
void Sweep::resume() {
  std::string text;
  on_root(context_.comm, [&] {
    std::filesystem::create_directories(context_.output);
    std::vector<SweepLine> lines;
    if (std::filesystem::is_regular_file(record_)) lines = recorded();
    text = head_.dump() + "\n";
    for (const SweepLine& line : lines) text += line.dump() + "\n";
    write_file(record_, text);
    sweep_table(points_.keys, lines).write(context_.output / "sweep.csv");
    shown_ = lines.size();
  });
  text = context_.comm.broadcast(text);
  const std::vector<SweepLine> lines = read_sweep_lines(text, record_.string(), head_);
  for (const SweepLine& line : lines) next_number_ = std::max(next_number_, line["point"].get<int>() + 1);
  for (std::size_t point = 0; point < points_.values.size(); ++point) take_over(point, lines);
}

void Sweep::take_over(std::size_t point, const std::vector<SweepLine>& lines) {
  const SweepLine parameters = parameter_values(points_.keys, points_.values[point]);
  const auto found =
      std::ranges::find_if(lines, [&](const SweepLine& line) { return line["parameters"] == parameters; });
  if (found == lines.end()) {
    numbers_.push_back(next_number_++);
    states_.push_back(PointState::pending);
    return;
  }
  numbers_.push_back((*found)["point"].get<int>());
  const bool is_done = (*found)["status"] == "converged";
  states_.push_back(is_done                 ? PointState::done
                    : context_.retry_failed ? PointState::pending
                                            : PointState::failed);
}

SweepOutcome Sweep::solve(const SweepQueue::Task& task) {
  const CaseSettings settings = point_settings(case_, points_, task.point);
  std::optional<Neighbour> neighbour;
  if (task.start && context_.settings.sweep.continuation) {
    neighbour = Neighbour{.folder = folder(*task.start)};
    if (task.before) {
      neighbour->before = folder(task.before->point);
      neighbour->ahead = task.before->ahead;
    }
  }
  return run_sweep_point(context_, group_.get(), agreement_,
                         {context_.settings.sweep.verb, settings, folder(task.point), neighbour});
}

void Sweep::record(std::size_t point, const std::optional<std::size_t>& start, const SweepOutcome& outcome) {
  const std::string from =
      outcome.from_neighbour ? fmt::format("point {}", numbers_[*start]) : std::string("none");
  append_line(record_, {{"point", numbers_[point]},
                        {"parameters", parameter_values(points_.keys, points_.values[point])},
                        {"status", outcome.status},
                        {"reason", outcome.status == "converged" ? "" : outcome.reason},
                        {"results", outcome.status == "converged"
                                        ? result_rows(context_.settings.sweep.verb, outcome.findings)
                                        : std::vector<SweepLine>{}},
                        {"start", from},
                        {"seconds", outcome.seconds}});
  sweep_table(points_.keys, recorded()).write(context_.output / "sweep.csv");
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
      task = queue.take(last);
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
        if (!is_interrupted) record(task->point, task->start, outcome);
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
  if (std::ranges::find(states_, PointState::pending) == states_.end()) return true;
  SweepQueue queue(context_.comm, places_of(points_), states_);
  work(queue);
  if (group_.get().is_root()) queue.leave();
  wait(queue);
  std::string text;
  on_root(context_.comm, [&] { text = read_file(record_); });
  const auto lines = read_sweep_lines(context_.comm.broadcast(text), record_.string(), head_);
  bool is_complete = true;
  for (std::size_t point = 0; point < states_.size(); ++point) {
    if (states_[point] != PointState::pending) continue;
    const auto found =
        std::ranges::find_if(lines, [&](const SweepLine& line) { return line["point"] == numbers_[point]; });
    if (found == lines.end()) {
      is_complete = false;
      continue;
    }
    states_[point] = (*found)["status"] == "converged" ? PointState::done : PointState::failed;
  }
  return is_complete;
}

void Sweep::show_news(const SweepQueue::Count& count) {
  const std::vector<SweepLine> lines = recorded();
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
std::vector<std::string> Sweep::refined_values() {
  const std::vector<SweepLine> lines = recorded();
  std::map<double, std::vector<double>> curve;
  for (std::size_t point = 0; point < points_.values.size(); ++point) {
    auto& values = curve[*number_in(points_.values[point][0])];
    for (const SweepLine& line : lines)
      if (line["point"] == numbers_[point])
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
  std::string record;
  on_root(context_.comm, [&] { record = read_file(record_); });
  const auto lines = read_sweep_lines(context_.comm.broadcast(record), record_.string(), head_);
  std::istringstream values(text);
  for (std::string value; std::getline(values, value);) {
    points_.values.push_back({value});
    take_over(points_.values.size() - 1, lines);
    ++refined_;
  }
  context_.log.line("{} points more where the curve bends", std::ranges::count(text, '\n') + 1);
  return true;
}

SolveStatus Sweep::end(bool is_complete) {
  const auto done = std::ranges::count(states_, PointState::done);
  const auto failed = std::ranges::count(states_, PointState::failed);
  context_.result.findings["sweep"] = {{"points", states_.size()},
                                       {"done", done},
                                       {"failed", failed},
                                       {"left", static_cast<long>(states_.size()) - done - failed}};
  std::string& message = context_.result.message;
  message = fmt::format("{} of {} points done", done, states_.size());
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
  if (context_.settings.sweep.groups > context_.comm.size())
    throw InputError(fmt::format("{} = {}: there are {} ranks; give as many groups at most",
                                 context_.place("sweep.groups"), context_.settings.sweep.groups,
                                 context_.comm.size()));
  resume();
  if (context_.settings.sweep.refine > 0) {
    std::vector<double> places;
    for (const auto& values : points_.values) places.push_back(*number_in(values[0]));
    std::ranges::sort(places);
    narrowest_ = places.back() - places.front();
    for (std::size_t i = 1; i < places.size(); ++i)
      narrowest_ = std::min(narrowest_, places[i] - places[i - 1]);
  }
  const auto held = std::ranges::count(states_, PointState::done);
  context_.log.line("{} points, {} done before; {} group{} of ranks", states_.size(), held, groups_,
                    groups_ == 1 ? "" : "s");
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

SolveStatus run_sweep(Context& context) {
  const SweepPoints points = sweep_points(context.settings.sweep);
  sweep_plan({context.settings, {}, context.sources});
  return Sweep(context, points).run();
}

}  // namespace wingbeat
