#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/context.hpp"
#include "apps/sweep/sweep_order.hpp"
#include "apps/sweep/sweep_points.hpp"
#include "apps/sweep/sweep_record.hpp"
#include "apps/sweep_point.hpp"

namespace wingbeat {

// The points of a sweep, which of them are done, and sweep.jsonl and sweep.csv that say so.
class SweepJournal {
 public:
  // Takes over what the folder's sweep.jsonl knows of the points. Throws InputError where that is of another
  // case. Collective.
  SweepJournal(Context& context, SweepPoints points);

  const SweepPoints& points() const { return points_; }
  const std::vector<PointState>& states() const { return states_; }
  long count(PointState state) const;
  int number(std::size_t point) const { return numbers_[point]; }
  std::filesystem::path folder(std::size_t point) const;

  // One more value of the only key each. Collective.
  void add(const std::vector<std::string>& values);
  // What has become of the points.
  void settle(std::vector<PointState> states) { states_ = std::move(states); }

  // Whether an earlier run began this one and did not end it.
  bool is_begun(std::size_t point) const { return begun_[point]; }

  // On one rank, while no other records.
  void record_begin(std::size_t point) const;
  void record(std::size_t point, const std::optional<std::size_t>& start, const SweepOutcome& outcome) const;
  // The points that have ended, by one rank; see read_sweep_lines.
  std::vector<SweepLine> lines() const { return read().ended; }

 private:
  SweepLines read() const;
  SweepLines read_on_all() const;
  void take_over(std::size_t point, const SweepLines& lines);

  Context& context_;
  SweepPoints points_;
  SweepLine head_;
  std::filesystem::path file_;
  std::vector<int> numbers_;  // of each point: its folder
  std::vector<PointState> states_;
  std::vector<bool> begun_;
  int next_number_ = 1;
};

}  // namespace wingbeat
