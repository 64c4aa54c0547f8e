#pragma once

#include <cstdlib>
#include <string_view>

namespace wingbeat::testing {

// Tests of minutes run at night: with WINGBEAT_NIGHTLY=1 in the environment.
inline bool is_nightly() {
  const char* value = std::getenv("WINGBEAT_NIGHTLY");
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace wingbeat::testing
