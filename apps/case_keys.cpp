#include "apps/case_keys.hpp"

namespace wingbeat {

nlohmann::ordered_json key_values(const CaseSettings& settings, const std::vector<std::string>& sections) {
  CaseSettings copy = settings;
  SettingRegistry registry;
  copy.describe(registry);
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  for (const std::string& section : sections)
    for (const Setting& key : registry.find(section)->keys())
      values[section + "." + key.name] = key.value_text();
  return values;
}

}  // namespace wingbeat
