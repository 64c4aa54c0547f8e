#include "core/io/changed_keys.hpp"

namespace wingbeat {

std::vector<std::string> changed_keys(const nlohmann::ordered_json& earlier,
                                      const nlohmann::ordered_json& now) {
  std::vector<std::string> changed;
  for (const auto& [key, value] : now.items())
    if (!earlier.contains(key) || earlier[key] != value) changed.push_back(key);
  return changed;
}

}  // namespace wingbeat
