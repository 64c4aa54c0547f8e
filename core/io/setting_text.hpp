#pragma once

#include <string>

#include "core/io/settings.hpp"

namespace wingbeat {

// The settings as a case file that reads back to the same values, each line saying where its
// value came from. Optional keys that are not set, and required ones of unused sections, are left out.
std::string resolved_case(const SettingRegistry& settings);

// Every key with type, unit, default, allowed values and help: a plain table for a terminal ...
std::string reference_table(const SettingRegistry& settings);
// ... and a page in Markdown.
std::string reference_markdown(const SettingRegistry& settings);

}  // namespace wingbeat
