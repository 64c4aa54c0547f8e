#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "core/io/settings.hpp"

namespace wingbeat {

// Stores the value in the setting's target. Returns what is wrong with it (its type, its range,
// not finite, not in the set of allowed texts) and leaves the target alone, or nothing.
std::optional<std::string> read_toml_value(const toml::node& node, const Setting& setting);

// The value as its author would write it, shortened to one line.
std::string toml_node_text(const toml::node& node);

}  // namespace wingbeat
