#include "optimize/requirement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimize/output_names.hpp"

namespace wingbeat {
namespace {

using Words = std::span<const StatementWord>;
using Kind = StatementWord::Kind;
using Relation = Requirement::Relation;

constexpr const char* bound_forms =
    "a bound is a number, \"baseline\", or a multiple of it such as \"0.98 baseline\"";

std::optional<Relation> relation_of(const std::string& text) {
  if (text == "<=") return Relation::at_most;
  if (text == ">=") return Relation::at_least;
  if (text == "=") return Relation::equal;
  return std::nullopt;
}

bool read_bound(Words words, Requirement& requirement) {
  double sign = 1.0;
  if (!words.empty() && (words[0].is("-") || words[0].is("+"))) {
    sign = words[0].is("-") ? -1.0 : 1.0;
    words = words.subspan(1);
    if (words.empty() || words[0].kind != Kind::number) return false;
  }
  requirement.factor_or_value = 1.0;
  const bool has_number = !words.empty() && words[0].kind == Kind::number;
  if (has_number) {
    requirement.factor_or_value = sign * words[0].number;
    words = words.subspan(1);
    if (words.empty()) return true;
    if (words[0].is("*")) words = words.subspan(1);
  }
  requirement.is_of_baseline = true;
  return words.size() == 1 && words[0].is("baseline");
}

std::string joined(Words words) {
  std::string text;
  for (const StatementWord& word : words) text += (text.empty() ? "" : " ") + word.text;
  return text;
}

// Takes "scale NUMBER" off the end, where it is.
Words read_scale(Words words, Reading<Requirement>& reading) {
  const auto at = std::ranges::find_if(words, [](const StatementWord& word) { return word.is("scale"); });
  if (at == words.end()) return words;
  const auto before = static_cast<std::size_t>(at - words.begin());
  const Words number = words.subspan(before + 1);
  if (number.size() == 1 && number[0].kind == Kind::number && number[0].number > 0.0)
    reading.value.scale = number[0].number;
  else
    reading.faults.push_back(
        fmt::format("scale \"{}\" is not a positive number; end with \"scale\" and one, or leave both out",
                    joined(number)));
  return words.first(before);
}

}  // namespace

Reading<Requirement> read_requirement(const std::string& text) {
  Reading<Requirement> reading;
  reading.value.text = text;
  const std::vector<StatementWord> all = statement_words(text);
  const auto is_relation = [](const StatementWord& word) { return word.kind == Kind::relation; };
  const auto relations = std::ranges::count_if(all, is_relation);
  if (relations != 1) {
    reading.faults.push_back(
        fmt::format("{}; write OUTPUT <=, >= or = BOUND, such as \"drag <= baseline\"",
                    relations == 0 ? "no relation"
                                   : fmt::format("{} relations, one a constraint is allowed", relations)));
    return reading;
  }
  const auto at = std::ranges::find_if(all, is_relation);
  if (const auto relation = relation_of(at->text))
    reading.value.relation = *relation;
  else
    reading.faults.push_back(fmt::format("no relation \"{}\"; allowed: \"<=\", \">=\", \"=\"", at->text));

  reading.value.output = trimmed(std::string_view(text).substr(0, text.find_first_of("<>=")));
  if (find_output(reading.value.output) == nullptr)
    reading.faults.push_back(unknown_output(reading.value.output));

  const Words bound = read_scale(Words(at + 1, all.end()), reading);
  if (!read_bound(bound, reading.value))
    reading.faults.push_back(fmt::format("bound \"{}\" cannot be read; {}", joined(bound), bound_forms));
  return reading;
}

bool are_alike(const Requirement& a, const Requirement& b) {
  return a.output == b.output && a.relation == b.relation && a.factor_or_value == b.factor_or_value &&
         a.is_of_baseline == b.is_of_baseline;
}

Interval interval(const Requirement& requirement, double baseline) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double bound = requirement.bound(baseline);
  return {requirement.relation == Relation::at_most ? -infinity : bound,
          requirement.relation == Relation::at_least ? infinity : bound};
}

double violation_scale(const Requirement& requirement, double baseline) {
  constexpr double negligible = 1e-6;  // a lift of zero is known to the residual only
  if (requirement.scale) return *requirement.scale;
  for (const double measure : {std::abs(requirement.bound(baseline)), std::abs(baseline)})
    if (measure >= negligible) return measure;
  return 1.0;
}

std::vector<std::string> bounds_cross(std::span<const Requirement> requirements,
                                      const std::map<std::string, double>& baselines) {
  const auto limits = [&](const Requirement& requirement) -> std::optional<Interval> {
    const auto baseline = baselines.find(requirement.output);
    if (baseline != baselines.end()) return interval(requirement, baseline->second);
    if (requirement.is_of_baseline) return std::nullopt;
    return interval(requirement, 0.0);
  };
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < requirements.size(); ++i)
    for (std::size_t j = i + 1; j < requirements.size(); ++j) {
      const Requirement &a = requirements[i], &b = requirements[j];
      if (a.output != b.output) continue;
      if (a.relation == Relation::equal && b.relation == Relation::equal) continue;
      const auto first = limits(a), second = limits(b);
      if (!first || !second) continue;
      const double lower = std::max(first->lower, second->lower);
      const double upper = std::min(first->upper, second->upper);
      if (lower > upper)
        faults.push_back(
            fmt::format("\"{}\" and \"{}\": no {} is both >= {:g} and <= {:g}; change or drop one of them",
                        a.text, b.text, a.output, lower, upper));
    }
  return faults;
}

}  // namespace wingbeat
