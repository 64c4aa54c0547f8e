#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/case_settings.hpp"

namespace wingbeat {

// Values of the keys of some sections as texts, "section.key" -> value: what results depend on.
nlohmann::ordered_json key_values(const CaseSettings& settings, const std::vector<std::string>& sections);

}  // namespace wingbeat
