#pragma once

#include <string>

namespace wingbeat {

// All keys of a case with type, default, allowed values, unit and meaning.
std::string reference_text();  // for a terminal
std::string reference_page();  // docs/case-reference.md, whole

}  // namespace wingbeat
