#include "apps/sweep/sweep_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "core/io/error.hpp"
#include "core/io/file.hpp"
#include "core/io/settings.hpp"

namespace wingbeat {
namespace {

constexpr int max_points = 1000000;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// A number without the round-off of the sum that made it, "0.83" and not "0.8300000000000001".
std::string value_text(double number, bool is_whole) {
  if (is_whole) return fmt::format("{}", std::lround(number));
  const std::string text = fmt::format("{:.12g}", number);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::vector<std::string> listed_values(const std::string& text) {
  toml::table table;
  try {
    table = toml::parse("values = " + text);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("its list is not valid TOML: {}", error.description()));
  }
  const toml::array* array = table["values"].as_array();
  if (!array || array->empty()) throw InputError("its list is empty; give values, such as [0.7, 0.8]");
  std::vector<std::string> values;
  for (const toml::node& node : *array) {
    if (const auto* number = node.as_floating_point()) {
      values.push_back(toml_text(number->get()));
      continue;
    }
    std::ostringstream value;
    node.visit([&](const auto& held) { value << held; });
    values.push_back(value.str());
  }
  return values;
}

std::vector<std::string> ranged_values(const std::string& text) {
  static const std::regex form(R"(^(\S+)\s+to\s+(\S+)\s+(step|in)\s+(\S+)$)");
  std::smatch parts;
  if (!std::regex_match(text, parts, form))
    throw InputError("expected a list, [0.7, 0.8], or a range, 0.7 to 0.9 step 0.01 or 0.7 to 0.9 in 21");
  const bool by_step = parts[3] == "step";
  const auto first = number_in(parts[1]), last = number_in(parts[2]), third = number_in(parts[4]);
  for (const int part : {1, 2, 4})
    if (!number_in(parts[part])) throw InputError(fmt::format("{} is not a number", parts[part].str()));
  const double span = *last - *first;
  double count = *third;
  if (by_step) {
    if (*third == 0.0 || span / *third < 0.0)
      throw InputError(
          fmt::format("step {} does not lead from {} to {}", parts[4].str(), parts[1].str(), parts[2].str()));
    count = std::floor(span / *third * (1.0 + 1e-9) + 1e-9) + 1.0;
  } else if (count != std::floor(count) || count < 2.0) {
    throw InputError(fmt::format("in {}: give a whole number of values, 2 or more", parts[4].str()));
  }
  if (count > max_points) throw InputError(fmt::format("{} values are too many", count));
  const auto is_whole_text = [](const std::string& value) {
    return value.find_first_of(".eE") == std::string::npos;
  };
  const double step = by_step ? *third : span / (count - 1.0);
  const bool is_whole = is_whole_text(parts[1]) && is_whole_text(parts[2]) && step == std::floor(step);
  std::vector<std::string> values;
  for (int i = 0; i < static_cast<int>(count); ++i) values.push_back(value_text(*first + i * step, is_whole));
  return values;
}

void check_key(const std::string& key) {
  static const std::regex form(R"(^\w+\.\w+$)");
  if (!std::regex_match(key, form))
    throw InputError(fmt::format("\"{}\" is not a section.key, such as flow.mach", key));
  if (key.starts_with("sweep.") || key.starts_with("partition."))
    throw InputError(fmt::format("{} cannot change from point to point", key));
}

void check_keys(const std::vector<std::string>& keys) {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (std::find(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(i), keys[i]) !=
        keys.begin() + static_cast<std::ptrdiff_t>(i))
      throw InputError(fmt::format("{} is given twice", keys[i]));
}

std::vector<std::string> keys_of(std::span<const SweepParameter> parameters) {
  std::vector<std::string> keys;
  for (const SweepParameter& parameter : parameters) keys.push_back(parameter.key);
  check_keys(keys);
  return keys;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(trimmed(cell));
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

}  // namespace

std::optional<double> number_in(const std::string& value) {
  std::size_t used = 0;
  try {
    const double number = std::stod(value, &used);
    if (used == value.size() && std::isfinite(number)) return number;
  } catch (const std::exception&) {
  }
  return std::nullopt;
}

SweepParameter sweep_parameter(const std::string& statement) {
  const auto equals = statement.find('=');
  if (equals == std::string::npos)
    throw InputError("expected \"KEY = VALUES\", such as \"flow.mach = 0.7 to 0.9 step 0.01\"");
  SweepParameter parameter{trimmed(statement.substr(0, equals)), {}};
  check_key(parameter.key);
  const std::string values = trimmed(statement.substr(equals + 1));
  parameter.values = values.starts_with('[') ? listed_values(values) : ranged_values(values);
  return parameter;
}

SweepPoints grid_points(std::span<const SweepParameter> parameters) {
  SweepPoints points{keys_of(parameters), {{}}};
  for (const SweepParameter& parameter : parameters) {
    std::vector<std::vector<std::string>> extended;
    if (points.values.size() * parameter.values.size() > max_points)
      throw InputError(fmt::format("more than {} points", max_points));
    for (const auto& point : points.values)
      for (const std::string& value : parameter.values) {
        extended.push_back(point);
        extended.back().push_back(value);
      }
    points.values = std::move(extended);
  }
  return points;
}

SweepPoints zipped_points(std::span<const SweepParameter> parameters) {
  SweepPoints points{keys_of(parameters), {}};
  for (const SweepParameter& parameter : parameters)
    if (parameter.values.size() != parameters[0].values.size())
      throw InputError(fmt::format("to zip, all lists must be of one length: {} has {} values, {} has {}",
                                   parameters[0].key, parameters[0].values.size(), parameter.key,
                                   parameter.values.size()));
  for (std::size_t i = 0; i < parameters[0].values.size(); ++i) {
    auto& point = points.values.emplace_back();
    for (const SweepParameter& parameter : parameters) point.push_back(parameter.values[i]);
  }
  return points;
}

SweepPoints tabled_points(const std::string& text, const std::string& path) {
  SweepPoints points;
  std::istringstream stream(text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    line = trimmed(line);
    if (line.empty() || line.starts_with('#')) continue;
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}:{}: {}", path, number, what));
    };
    std::vector<std::string> cells = cells_of(line);
    if (points.keys.empty()) {
      try {
        for (const std::string& key : cells) check_key(key);
        check_keys(cells);
      } catch (const InputError& error) {
        fail(error.what());
      }
      points.keys = std::move(cells);
      continue;
    }
    if (cells.size() != points.keys.size())
      fail(fmt::format("{} values for {} keys ({})", cells.size(), points.keys.size(),
                       fmt::join(points.keys, ", ")));
    points.values.push_back(std::move(cells));
  }
  if (points.values.empty())
    throw InputError(
        fmt::format("{}: no points; the first line names the keys, each other line is a point", path));
  return points;
}

SweepPoints sweep_points(const SweepSettings& settings) {
  if (settings.table) {
    if (!settings.parameters.empty())
      throw InputError("sweep.table: sweep.parameters is given too; leave one out");
    return tabled_points(read_file(*settings.table), *settings.table);
  }
  if (settings.parameters.empty())
    throw InputError(
        "sweep.parameters: missing; give what changes from point to point, such as [\"flow.mach = 0.7 to 0.9 "
        "step 0.01\"]");
  std::vector<SweepParameter> parameters;
  for (const std::string& statement : settings.parameters) {
    try {
      parameters.push_back(sweep_parameter(statement));
    } catch (const InputError& error) {
      throw InputError(fmt::format("sweep.parameters: \"{}\": {}", statement, error.what()));
    }
  }
  try {
    return settings.combine == "zip" ? zipped_points(parameters) : grid_points(parameters);
  } catch (const InputError& error) {
    throw InputError(fmt::format("sweep.parameters: {}", error.what()));
  }
}

std::vector<std::vector<double>> point_places(const SweepPoints& points) {
  std::vector<std::vector<double>> places(points.values.size());
  for (std::size_t key = 0; key < points.keys.size(); ++key) {
    std::vector<double> numbers;
    for (const auto& point : points.values)
      if (const auto number = number_in(point[key])) numbers.push_back(*number);
    if (numbers.size() == places.size()) {
      const auto [least, greatest] = std::ranges::minmax(numbers);
      const double span = greatest > least ? greatest - least : 1.0;
      for (std::size_t i = 0; i < places.size(); ++i) places[i].push_back((numbers[i] - least) / span);
      continue;
    }
    std::vector<std::string> texts;
    for (const auto& point : points.values)
      if (std::ranges::find(texts, point[key]) == texts.end()) texts.push_back(point[key]);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const std::string& text : texts) places[i].push_back(points.values[i][key] == text ? 1.0 : 0.0);
  }
  return places;
}

}  // namespace wingbeat
