#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/settings.hpp"

namespace wingbeat {

// One option that Ipopt knows and the values it takes.
struct IpoptOptionRule {
  enum class Kind { number, integer, text };

  std::string name;
  Kind kind = Kind::number;
  Bounds range{};                      // of a number
  std::vector<std::string> allowed{};  // of a text; "*" among them: any
};

// "name = value" taken apart.
struct IpoptAssignment {
  std::string name;
  std::string value;
};

// Nothing where the text lacks the sign, the name or the value.
std::optional<IpoptAssignment> parse_assignment(std::string_view text);

// The whole text as a number; nothing where it is none, or not a finite one.
std::optional<double> parse_number(std::string_view text);
std::optional<int> parse_integer(std::string_view text);

// What the adapter sets: second derivatives by limited memory, no scaling, bounds that hold, no banner, and
// tolerances such that the conditions of optimality hold to `tolerance` with multipliers as they are.
std::vector<IpoptAssignment> own_assignments(int max_iterations, double tolerance);

// One sentence for every text that is no assignment, names no option, gives a value that the option does not
// take, repeats a name, or sets what the adapter itself sets.
std::vector<std::string> assignment_faults(std::span<const std::string> texts,
                                           std::span<const IpoptOptionRule> rules);

}  // namespace wingbeat
