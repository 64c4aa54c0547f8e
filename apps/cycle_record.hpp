#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/cycle_solver.hpp"

namespace wingbeat {

// The cycles of a run, written as each is found: lco.jsonl, a line each, from which a later run goes on;
// lco.csv and cycles.csv, the same as tables. All methods are collective.
class CycleRecord {
 public:
  explicit CycleRecord(Context& context);

  // The same number but for what tolerances leave open.
  static bool is_same(double a, double b);

  // Takes over the cycles that lie in lco.jsonl beside the restart file, if there are any. Throws
  // InputError where they are of another case, naming the keys that differ. What did not converge is left
  // out.
  void resume();
  // `entry`: as result.json holds it. Asked: a cycle of the case's list, not a step between. A cycle found
  // already, a restart's own, is not added again; asked for now, it counts as asked.
  void add(nlohmann::ordered_json entry, const CycleSolution& solution, bool is_asked);

  // The cycles asked for, in the order found.
  nlohmann::ordered_json asked() const;
  // A cycle of that energy, or of that speed, was asked for and found.
  bool has_energy(double energy) const { return has("energy", energy); }
  bool has_speed(double reduced_velocity) const { return has("reduced_velocity", reduced_velocity); }

 private:
  nlohmann::ordered_json* find(const CycleSolution& solution);
  bool has(const char* number, double value) const;
  void write() const;

  Context& context_;
  nlohmann::ordered_json case_;  // key -> value, of what the cycles depend on
  std::vector<nlohmann::ordered_json> lines_;
};

// cycles.csv of a single cycle.
void write_cycle(const Context& context, const CycleSolution& solution);

}  // namespace wingbeat
