#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimize/statement_words.hpp"

namespace wingbeat {

// A constraint on one output, as its author wrote it.
struct Requirement {
  enum class Relation { at_most, at_least, equal };
  std::string output{};
  Relation relation = Relation::at_most;
  double factor_or_value = 0.0;   // the bound, or its ratio to the value of the undeformed shape
  bool is_of_baseline = false;    // which of both
  std::optional<double> scale{};  // > 0: a change of the output that matters
  std::string text{};

  double bound(double baseline) const {
    return is_of_baseline ? factor_or_value * baseline : factor_or_value;
  }
};

// Reads "OUTPUT RELATION BOUND" or "OUTPUT RELATION BOUND scale NUMBER": RELATION is <=, >= or =, BOUND a
// number, "baseline", "NUMBER baseline" or "NUMBER * baseline".
Reading<Requirement> read_requirement(const std::string& text);

// Whether both say the same, in whatever words; the scale aside.
bool are_alike(const Requirement& a, const Requirement& b);

// Closed interval of allowed values; infinite where there is no bound.
struct Interval {
  double lower = 0.0;
  double upper = 0.0;
};
// `baseline`: the output of the undeformed shape.
Interval interval(const Requirement& requirement, double baseline);

// What a violation is measured in: the scale given, else |bound|, else |baseline|, else 1, where less than
// 1e-6 counts as no measure.
double violation_scale(const Requirement& requirement, double baseline);

// A sentence for each pair of bounds on one output that leave no value between them. `baselines` by name of
// output; bounds relative to one that is missing are passed over, as are two equalities.
std::vector<std::string> bounds_cross(std::span<const Requirement> requirements,
                                      const std::map<std::string, double>& baselines);

}  // namespace wingbeat
