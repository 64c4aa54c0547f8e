#include "optimize/evaluation_record.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/io/changed_keys.hpp"
#include "core/io/error.hpp"
#include "core/io/file.hpp"

namespace wingbeat {
namespace {

using nlohmann::ordered_json;

std::vector<std::string> names_of(const ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

// JSON has no number for what is not finite: it was written as null.
std::vector<double> values_of(const ordered_json& object) {
  std::vector<double> values;
  for (const auto& value : object)
    values.push_back(value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN());
  return values;
}

ordered_json head_of(ordered_json case_keys, const std::vector<std::string>& analyses,
                     const std::vector<std::string>& outputs) {
  return {{"kind", "case"}, {"keys", std::move(case_keys)}, {"analyses", analyses}, {"outputs", outputs}};
}

// What failed did so whatever was asked for.
template <class Entries>
auto find(Entries& entries, std::span<const double> design, const std::vector<std::string>& names)
    -> decltype(&entries.front().found) {
  const auto held = std::ranges::find_if(entries, [&](const auto& e) {
    return std::ranges::equal(e.design, design) && (e.names.empty() || e.names == names);
  });
  return held == entries.end() ? nullptr : &held->found;
}

void add_to(std::map<std::string, double>& sums, const ordered_json& seconds) {
  for (const auto& [name, value] : seconds.items()) sums[name] += value.get<double>();
}

ordered_json line_of(const char* kind, std::span<const double> design, const std::string& message) {
  ordered_json line{{"kind", kind}, {"design", std::vector<double>(design.begin(), design.end())}};
  line["status"] = message.empty() ? "solved" : "failed";
  if (!message.empty()) line["message"] = message;
  return line;
}

}  // namespace

ordered_json named(const std::vector<std::string>& names, std::span<const double> values) {
  ordered_json object = ordered_json::object();
  for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) object[names[i]] = values[i];
  return object;
}

EvaluationRecord::EvaluationRecord(std::filesystem::path file, ordered_json case_keys,
                                   std::vector<std::string> analyses, std::vector<std::string> outputs)
    : file_(std::move(file)),
      head_(head_of(std::move(case_keys), analyses, outputs)),
      analyses_(std::move(analyses)),
      outputs_(std::move(outputs)) {
  write_file(file_, head_.dump() + "\n");
}

void EvaluationRecord::resume(std::span<const std::string> lines, const std::string& path) {
  const auto parsed = [&](std::size_t i) { return ordered_json::parse(lines[i], nullptr, false); };
  const ordered_json head = lines.empty() ? ordered_json() : parsed(0);
  if (!head.is_object() || head.value("kind", "") != "case")
    throw InputError(fmt::format(
        "{}: is no record of an optimisation; give the evaluations.jsonl of an earlier run", path));
  std::vector<std::string> changed = changed_keys(head["keys"], head_["keys"]);
  if (head["outputs"] != head_["outputs"] || head["analyses"] != head_["analyses"])
    changed.push_back("optimize.objective or optimize.constraints (other outputs)");
  if (!changed.empty())
    throw InputError(fmt::format(
        "{}: is of a case with other values of {}; give these the values they had, or begin anew without "
        "--restart",
        path, fmt::join(changed, ", ")));
  std::string text = head_.dump() + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const ordered_json line = parsed(i);
    if (line.is_discarded() && i + 1 == lines.size()) break;
    if (line.is_discarded())
      throw InputError(fmt::format("{}:{}: is not a line of JSON; remove it and what follows", path, i + 1));
    if (take(line)) text += lines[i] + "\n";
  }
  resumed_ = evaluations();
  write_file(file_, text);
}

void EvaluationRecord::expect(std::vector<std::string> analyses, std::vector<std::string> outputs) {
  analyses_ = std::move(analyses);
  outputs_ = std::move(outputs);
}

// Iterations are told anew as the optimisation is.
bool EvaluationRecord::take(const ordered_json& line) {
  const auto kind = line.at("kind").get<std::string>();
  auto design = line.value("design", std::vector<double>());
  const std::string message = line.value("message", "");
  if (kind == "values") {
    const ordered_json outputs = line.value("outputs", ordered_json::object());
    add_to(value_seconds_, line.at("seconds"));
    values_.push_back({std::move(design),
                       names_of(outputs),
                       {message.empty(), message, values_of(outputs), values_of(line.at("seconds")),
                        line.at("solves").get<int>()}});
    return true;
  }
  if (kind == "gradients") {
    const ordered_json gradients = line.value("gradients", ordered_json::object());
    GradientEvaluation evaluation{message.empty(), message, {}, values_of(line.at("seconds"))};
    for (const auto& row : gradients) evaluation.derivatives.push_back(row.get<std::vector<double>>());
    add_to(gradient_seconds_, line.at("seconds"));
    gradients_.push_back({std::move(design), names_of(gradients), std::move(evaluation)});
    return true;
  }
  if (kind == "roots") {
    std::vector<FlutterRoot> roots;
    for (const auto& entry : line.at("roots")) {
      FlutterRoot& root = roots.emplace_back();
      root.reduced_velocity = entry.at("reduced_velocity");
      root.frequency = entry.at("frequency_ratio");
      root.reduced_frequency = entry.at("reduced_frequency");
      root.growth_slope = entry.at("growth_slope");
    }
    roots_.push_back({std::move(design), {}, std::move(roots)});
    return true;
  }
  return false;
}

void EvaluationRecord::add(std::span<const double> design, const Evaluation& evaluation) {
  ordered_json line = line_of("values", design, evaluation.message);
  if (evaluation.is_solved) line["outputs"] = named(outputs_, evaluation.values);
  line["solves"] = evaluation.solves;
  line["seconds"] = named(analyses_, evaluation.seconds);
  append(line);
  take(line);
}

void EvaluationRecord::add(std::span<const double> design, const GradientEvaluation& evaluation) {
  ordered_json line = line_of("gradients", design, evaluation.message);
  if (evaluation.is_solved)
    for (std::size_t o = 0; o < outputs_.size(); ++o)
      line["gradients"][outputs_[o]] = evaluation.derivatives[o];
  line["seconds"] = named(analyses_, evaluation.seconds);
  append(line);
  take(line);
}

void EvaluationRecord::add(std::span<const double> design, const std::vector<FlutterRoot>& roots) {
  ordered_json line = line_of("roots", design, "");
  line["roots"] = ordered_json::array();
  for (const FlutterRoot& root : roots)
    line["roots"].push_back({{"reduced_velocity", root.reduced_velocity},
                             {"frequency_ratio", root.frequency},
                             {"reduced_frequency", root.reduced_frequency},
                             {"growth_slope", root.growth_slope}});
  append(line);
  take(line);
}

void EvaluationRecord::add_iteration(ordered_json iteration) {
  ordered_json line{{"kind", "iteration"}};
  line.update(iteration);
  append(line);
}

const Evaluation* EvaluationRecord::values(std::span<const double> design) const {
  return find(values_, design, outputs_);
}

const GradientEvaluation* EvaluationRecord::gradients(std::span<const double> design) const {
  return find(gradients_, design, outputs_);
}

const std::vector<FlutterRoot>* EvaluationRecord::roots(std::span<const double> design) const {
  return find(roots_, design, outputs_);
}

void EvaluationRecord::append(const ordered_json& line) const {
  std::ofstream stream(file_, std::ios::app);
  stream << line.dump() << '\n' << std::flush;
  if (!stream)
    throw InputError(fmt::format("{}: cannot be written: {}; make room, then continue with --restart {}",
                                 file_.string(), std::strerror(errno), file_.string()));
}

}  // namespace wingbeat
