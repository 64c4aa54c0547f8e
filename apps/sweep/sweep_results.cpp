#include "apps/sweep/sweep_results.hpp"

#include <fmt/format.h>

namespace wingbeat {
namespace {

using nlohmann::ordered_json;

// Numbers and texts of an object; those of an object within it under "outer_inner".
void flatten(const ordered_json& object, const std::string& prefix, ordered_json& row) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object())
      flatten(value, prefix + key + "_", row);
    else if (!value.is_array())
      row[prefix + key] = value;
  }
}

ordered_json flat(const ordered_json& object) {
  ordered_json row = ordered_json::object();
  flatten(object, "", row);
  return row;
}

std::vector<ordered_json> flat_rows(const ordered_json& list) {
  std::vector<ordered_json> rows;
  for (const ordered_json& entry : list) rows.push_back(flat(entry));
  return rows;
}

ordered_json pitch_row(const ordered_json& pitch) {
  ordered_json row;
  row["reduced_frequency"] = pitch["reduced_frequency"];
  for (const ordered_json& harmonic : pitch["harmonics"])
    for (const char* load : {"cl", "cd", "cm"}) {
      const std::string name = fmt::format("{}_{}", load, harmonic["n"].get<int>());
      row[name + "_re"] = harmonic[load][0];
      row[name + "_im"] = harmonic[load][1];
    }
  row.update(flat(pitch));
  return row;
}

ordered_json gradient_row(const ordered_json& gradient) {
  ordered_json row = flat(gradient);
  for (const ordered_json& entry : gradient["design"])
    row["d_" + entry["name"].get<std::string>()] = entry["derivative"];
  return row;
}

}  // namespace

std::vector<ordered_json> result_rows(const std::string& verb, const ordered_json& findings) {
  if (verb == "flutter" && findings.contains("flutter_points")) return flat_rows(findings["flutter_points"]);
  if (verb == "pk") {
    if (findings.contains("pk")) return flat_rows(findings["pk"]["crossings"]);
    return {};
  }
  if (!findings.contains(verb) || findings[verb].empty()) return {};
  if (verb == "lco") return flat_rows(findings["lco"]);
  if (verb == "pitch") return {pitch_row(findings["pitch"])};
  if (verb == "gradient") return {gradient_row(findings["gradient"])};
  return {flat(findings[verb])};
}

std::vector<double> curve_values(const std::string& verb, const ordered_json& rows) {
  std::vector<std::string> names{"reduced_velocity", "frequency_ratio"};
  if (verb == "steady") names = {"cl", "cd", "cm"};
  if (verb == "pitch") names = {"cl_1_re", "cl_1_im", "cm_1_re", "cm_1_im"};
  if (verb == "gradient") names = {"value"};
  std::vector<double> values;
  if (rows.empty()) return values;
  for (const std::string& name : names)
    if (rows[0].contains(name) && rows[0][name].is_number()) values.push_back(rows[0][name].get<double>());
  return values;
}

}  // namespace wingbeat
