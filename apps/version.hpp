#pragma once

#include <string_view>

namespace wingbeat {

std::string_view version();        // "0.1.0"
std::string_view git_commit();     // of the sources, when they were configured; "unknown" without git
std::string_view source_folder();  // where the sources were when the program was built

}  // namespace wingbeat
