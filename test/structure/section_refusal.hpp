#pragma once

#include <string>

#include "core/io/error.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat::testing {

// What structure_model says of a section that it refuses.
inline std::string message_of(const TypicalSection& section) {
  try {
    structure_model(section);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace wingbeat::testing
