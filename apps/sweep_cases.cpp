#include "apps/sweep_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/run_case.hpp"
#include "apps/sub_run.hpp"
#include "core/io/error.hpp"

namespace wingbeat {

CaseSettings point_settings(const ResolvedCase& sweep, const SweepPoints& points, std::size_t point) {
  const std::string& verb = sweep.settings.sweep.verb;
  std::vector<std::string> overrides;
  // The lowest root alone may be another one from point to point.
  if (verb == "flutter" && !sweep.sources.contains("flutter.roots")) overrides.push_back("flutter.roots=all");
  for (std::size_t key = 0; key < points.keys.size(); ++key)
    overrides.push_back(fmt::format("{}={}", points.keys[key], points.values[point][key]));
  try {
    return resolve_for_verb(find_verb(verb), case_text(sweep.settings, sweep.sources), "case of the sweep",
                            overrides, "sweep")
        .settings;
  } catch (const InputError& error) {
    throw InputError(fmt::format("the point {}: {}", point_label(points, point), error.what()));
  }
}

PointPlaces places_of(const SweepPoints& points) {
  PointPlaces result{point_places(points), {}};
  std::vector<std::string> known;
  for (const auto& values : points.values) {
    std::string text;
    for (std::size_t key = 0; key < points.keys.size(); ++key)
      if (points.keys[key].starts_with("mesh.") || points.keys[key] == "time.harmonics")
        text += values[key] + "\n";
    auto found = std::ranges::find(known, text);
    result.classes.push_back(static_cast<int>(found - known.begin()));
    if (found == known.end()) known.push_back(text);
  }
  return result;
}

std::string point_label(const SweepPoints& points, std::size_t point) {
  std::vector<std::string> parts;
  for (std::size_t key = 0; key < points.keys.size(); ++key)
    parts.push_back(fmt::format("{} = {}", points.keys[key], points.values[point][key]));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace wingbeat
