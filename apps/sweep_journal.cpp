#include "apps/sweep_journal.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/case_keys.hpp"
#include "apps/on_root.hpp"
#include "apps/run_case.hpp"
#include "apps/sweep/sweep_results.hpp"
#include "core/io/file.hpp"

namespace wingbeat {
namespace {

// What the points' results depend on, besides the parameters.
SweepLine record_head(const CaseSettings& settings, const SweepPoints& points) {
  const Verb& verb = find_verb(settings.sweep.verb);
  const auto sections = verb.sections_of ? verb.sections_of(settings) : verb.sections;
  const SweepLine all = key_values(settings, sections);
  SweepLine keys = SweepLine::object();
  for (const auto& [key, value] : all.items())
    if (std::ranges::find(points.keys, key) == points.keys.end() && !key.starts_with("partition."))
      keys[key] = value;
  return {{"verb", verb.name}, {"parameters", points.keys}, {"case", std::move(keys)}};
}

}  // namespace

SweepJournal::SweepJournal(Context& context, SweepPoints points)
    : context_(context),
      points_(std::move(points)),
      head_(record_head(context.settings, points_)),
      file_(context.output / "sweep.jsonl") {
  // A last line that was cut short is removed.
  on_root(context_.comm, [&] {
    std::filesystem::create_directories(context_.output);
    SweepLines known;
    if (std::filesystem::is_regular_file(file_)) known = read();
    std::string text = head_.dump() + "\n";
    for (const auto* lines : {&known.ended, &known.begun})
      for (const SweepLine& line : *lines) text += line.dump() + "\n";
    write_file(file_, text);
    sweep_table(points_.keys, known.ended).write(context_.output / "sweep.csv");
  });
  const SweepLines known = read_on_all();
  for (const auto* lines : {&known.ended, &known.begun})
    for (const SweepLine& line : *lines) next_number_ = std::max(next_number_, line["point"].get<int>() + 1);
  for (std::size_t point = 0; point < points_.values.size(); ++point) take_over(point, known);
}

long SweepJournal::count(PointState state) const { return std::ranges::count(states_, state); }

std::filesystem::path SweepJournal::folder(std::size_t point) const {
  return context_.output / "points" / fmt::format("{:04}", numbers_[point]);
}

SweepLines SweepJournal::read() const { return read_sweep_lines(read_file(file_), file_.string(), head_); }

SweepLines SweepJournal::read_on_all() const {
  std::string text;
  on_root(context_.comm, [&] { text = read_file(file_); });
  return read_sweep_lines(context_.comm.broadcast(text), file_.string(), head_);
}

void SweepJournal::take_over(std::size_t point, const SweepLines& lines) {
  const SweepLine parameters = parameter_values(points_.keys, points_.values[point]);
  const SweepLine* ended = line_of(lines.ended, parameters);
  const SweepLine* begun = line_of(lines.begun, parameters);
  const SweepLine* known = ended ? ended : begun;
  numbers_.push_back(known ? (*known)["point"].get<int>() : next_number_++);
  begun_.push_back(known != nullptr);
  const bool is_done = ended && (*ended)["status"] == "converged";
  const bool is_left = !ended || (!is_done && context_.retry_failed);
  states_.push_back(is_done ? PointState::done : is_left ? PointState::pending : PointState::failed);
}

void SweepJournal::add(const std::vector<std::string>& values) {
  const SweepLines known = read_on_all();
  for (const std::string& value : values) {
    points_.values.push_back({value});
    take_over(points_.values.size() - 1, known);
  }
}

void SweepJournal::record_begin(std::size_t point) const {
  append_line(file_, {{"point", numbers_[point]},
                      {"parameters", parameter_values(points_.keys, points_.values[point])},
                      {"status", "begun"}});
}

void SweepJournal::record(std::size_t point, const std::optional<std::size_t>& start,
                          const SweepOutcome& outcome) const {
  const bool is_done = outcome.status == "converged";
  append_line(file_, {{"point", numbers_[point]},
                      {"parameters", parameter_values(points_.keys, points_.values[point])},
                      {"status", outcome.status},
                      {"reason", is_done ? "" : outcome.reason},
                      {"results", is_done ? result_rows(context_.settings.sweep.verb, outcome.findings)
                                          : std::vector<SweepLine>{}},
                      {"start", outcome.from_neighbour ? fmt::format("point {}", numbers_[*start]) : "none"},
                      {"seconds", outcome.seconds}});
  sweep_table(points_.keys, lines()).write(context_.output / "sweep.csv");
}

}  // namespace wingbeat
