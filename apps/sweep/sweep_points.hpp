#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/sweep/sweep_settings.hpp"

namespace wingbeat {

// Values as texts that read back as TOML: a point is the case with `key = value` for each key.
struct SweepPoints {
  std::vector<std::string> keys;                 // "section.key"
  std::vector<std::vector<std::string>> values;  // [point][key]
};

// One key and its values, from "flow.mach = [0.7, 0.8]", "... = 0.7 to 0.9 step 0.1" or "... = 0.7 to 0.9 in
// 3". Throws InputError saying what is wrong, without its place.
struct SweepParameter {
  std::string key;
  std::vector<std::string> values;
};
SweepParameter sweep_parameter(const std::string& statement);

// Every value with every value of the others, the last key fastest; or the first of each, the second of each.
// Throws InputError where a key is given twice, or lists to be zipped differ in length.
SweepPoints grid_points(std::span<const SweepParameter> parameters);
SweepPoints zipped_points(std::span<const SweepParameter> parameters);

// Points from a table: keys in its first line, each other line a point. `path` is for messages: InputError
// with the line's number.
SweepPoints tabled_points(const std::string& text, const std::string& path);

// The points that the settings ask for; reads the table. Throws InputError naming the setting.
SweepPoints sweep_points(const SweepSettings& settings);

// The number that a value is, or nothing.
std::optional<double> number_in(const std::string& value);

// Points as places whose distance tells how unlike they are: a key whose values are all numbers spans one
// unit, any other is 0 or 1 for each of its texts: [point][coordinate].
std::vector<std::vector<double>> point_places(const SweepPoints& points);

}  // namespace wingbeat
