#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace wingbeat {

// Keys of `now` whose value in `earlier` is another, or that it lacks: what tells two cases apart.
std::vector<std::string> changed_keys(const nlohmann::ordered_json& earlier,
                                      const nlohmann::ordered_json& now);

}  // namespace wingbeat
