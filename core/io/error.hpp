#pragma once

#include <source_location>
#include <stdexcept>
#include <string>

namespace wingbeat {

// The user's fault: says where, what, what is allowed and what to do. Exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Our fault: a broken assumption of the code, with its place. Exit status 3.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

// Throws InternalError naming the place unless `condition` holds. Stays on in release builds.
void ensure(bool condition, const std::string& message,
            std::source_location where = std::source_location::current());

}  // namespace wingbeat
