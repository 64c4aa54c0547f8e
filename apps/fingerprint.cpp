#include "apps/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string_view>

namespace wingbeat {
namespace {

constexpr const char* unset = "unset";

std::map<std::string, std::string> parsed(const std::string& lines) {
  constexpr std::string_view equals = " = ";
  std::map<std::string, std::string> values;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);)
    if (const auto at = line.find(equals); at != std::string::npos)
      values[line.substr(0, at)] = line.substr(at + equals.size());
  return values;
}

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& list, const std::string& text) {
  return std::ranges::find(list, text) != list.end();
}

// What a march is asked to find out, and for how long.
constexpr std::array<std::string_view, 5> questions{"march.periods", "march.until", "march.snapshots",
                                                    "march.small_energy", "march.velocity_tolerance"};

}  // namespace

std::string fingerprint(CaseSettings settings, const KeySources& sources) {
  SettingRegistry registry;
  settings.describe(registry);
  std::string lines;
  for (const SettingSection& section : registry.sections())
    for (const Setting& key : section.keys()) {
      const std::string name = section.name() + "." + key.name, value = key.value_text();
      if (value.empty() || (key.info.required && !sources.contains(name))) continue;
      lines += fmt::format("{} = {}\n", name, value);
    }
  return lines;
}

std::vector<KeyChange> key_changes(const std::string& before, CaseSettings settings,
                                   const KeySources& sources) {
  const auto old = parsed(before);
  const auto now = parsed(fingerprint(settings, sources));
  SettingRegistry registry;
  settings.describe(registry);
  std::vector<KeyChange> changes;
  for (const SettingSection& section : registry.sections())
    for (const Setting& key : section.keys()) {
      const std::string name = section.name() + "." + key.name;
      const auto a = old.find(name), b = now.find(name);
      const bool is_in_both = a != old.end() && b != now.end();
      if (is_in_both ? a->second == b->second : (a == old.end() && b == now.end()) || key.info.required)
        continue;
      changes.push_back({name, a == old.end() ? unset : a->second, b == now.end() ? unset : b->second});
    }
  return changes;
}

std::string listed(const std::vector<KeyChange>& changes) {
  std::string list;
  for (const KeyChange& change : changes)
    list +=
        fmt::format("{}{} = {} (was {})", list.empty() ? "" : ", ", change.key, change.now, change.before);
  return list;
}

bool keeps_iteration(const KeyChange& change) {
  constexpr std::array<std::string_view, 8> elsewhere{"mesh",   "partition", "checkpoint", "pk",
                                                      "design", "gradient",  "optimize",   "sweep"};
  return is_among(elsewhere, change.section()) || is_among(questions, change.key) ||
         change.name().starts_with("max_") || change.name().ends_with("tolerance");
}

bool is_of_the_problem(const KeyChange& change, const std::string& verb) {
  constexpr std::array<std::string_view, 5> physics{"flow", "pitch", "time", "structure", "modal"};
  if (is_among(physics, change.section())) return true;
  if (change.section() != verb || keeps_iteration(change)) return false;
  return verb == "flutter" || verb == "march";
}

}  // namespace wingbeat
