#include "core/io/error.hpp"

#include <fmt/format.h>

namespace wingbeat {

void ensure(bool condition, const std::string& message, std::source_location where) {
  if (!condition)
    throw InternalError(
        fmt::format("{}:{}: in {}: {}", where.file_name(), where.line(), where.function_name(), message));
}

}  // namespace wingbeat
