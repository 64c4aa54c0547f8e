#pragma once

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "optimize/evaluation.hpp"
#include "structure/flutter_roots.hpp"

namespace wingbeat {

// An object of as many numbers as have a name.
nlohmann::ordered_json named(const std::vector<std::string>& names, std::span<const double> values);

// Every design that was looked at, a JSON line for what was found of it as it was found: "case" first, then
// "values", "gradients" and "iteration". Numbers are written so that they read back exactly: an optimisation
// run again asks for the same designs, finds them here, and goes on where the record ends.
class EvaluationRecord {
 public:
  // `file` is replaced with the first line. `case_keys`: key -> value, of what the outputs depend on. Throws
  // InputError where it cannot be written, here and later.
  EvaluationRecord(std::filesystem::path file, nlohmann::ordered_json case_keys,
                   std::vector<std::string> analyses, std::vector<std::string> outputs);

  // Takes over the lines of another record, found at `path`; a last line cut short is left out. Throws
  // InputError where it is no record, or one of another case, naming the keys that differ.
  void resume(std::span<const std::string> lines, const std::string& path);

  // Analyses and outputs that are asked for from now on: what is recorded of fewer does not count as found.
  void expect(std::vector<std::string> analyses, std::vector<std::string> outputs);

  // Adds a line. Collected solutions are found by their design, bit for bit.
  void add(std::span<const double> design, const Evaluation& evaluation);
  void add(std::span<const double> design, const GradientEvaluation& evaluation);
  void add(std::span<const double> design, const std::vector<FlutterRoot>& roots);
  void add_iteration(nlohmann::ordered_json iteration);
  const Evaluation* values(std::span<const double> design) const;
  const GradientEvaluation* gradients(std::span<const double> design) const;
  const std::vector<FlutterRoot>* roots(std::span<const double> design) const;

  int evaluations() const { return static_cast<int>(values_.size()); }
  int failures() const {
    return static_cast<int>(std::ranges::count_if(values_, [](const auto& e) { return !e.found.is_solved; }));
  }
  // Of all, how many were taken over.
  int resumed() const { return resumed_; }
  // What all of it cost, in seconds of the ranks that worked the longest: [analysis], of values and
  // gradients.
  const std::map<std::string, double>& value_seconds() const { return value_seconds_; }
  const std::map<std::string, double>& gradient_seconds() const { return gradient_seconds_; }

 private:
  template <class T>
  struct Entry {
    std::vector<double> design;
    std::vector<std::string> names;  // of the outputs
    T found;
  };
  bool take(const nlohmann::ordered_json& line);
  void append(const nlohmann::ordered_json& line) const;

  std::filesystem::path file_;
  nlohmann::ordered_json head_;
  std::vector<std::string> analyses_, outputs_;
  std::deque<Entry<Evaluation>> values_;  // found entries stay where they are
  std::deque<Entry<GradientEvaluation>> gradients_;
  std::deque<Entry<std::vector<FlutterRoot>>> roots_;
  std::map<std::string, double> value_seconds_, gradient_seconds_;
  int resumed_ = 0;
};

}  // namespace wingbeat
