#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/io/error.hpp"

namespace wingbeat::example {

// What the InputError thrown by f says; empty where f throws none.
template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Fails naming both where `text` lacks `part`.
inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\"\nlacks \"" << part << "\"";
}

}  // namespace wingbeat::example
