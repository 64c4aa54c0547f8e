#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace wingbeat {

// The findings of a verb as flat rows of numbers and texts: a row for each flutter root, limit cycle or
// crossing, one for any other verb. Empty where the verb found nothing.
std::vector<nlohmann::ordered_json> result_rows(const std::string& verb,
                                                const nlohmann::ordered_json& findings);

// The numbers of the first row that tell how the curve of a sweep runs: speed and frequency, or loads.
std::vector<double> curve_values(const std::string& verb, const nlohmann::ordered_json& rows);

}  // namespace wingbeat
