#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wingbeat {

// A word of an objective or a constraint: a name, a number without sign, a run of '<', '>' and '=', or any
// other single character.
struct StatementWord {
  enum class Kind { name, number, relation, symbol };
  Kind kind = Kind::symbol;
  std::string text;
  double number = 0.0;  // finite

  bool is(std::string_view word) const { return text == word; }
};

// Blanks separate words and are otherwise ignored.
std::vector<StatementWord> statement_words(std::string_view text);

// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

// What was read of a text, and the sentences that say what is wrong with it; of use only without them.
template <class T>
struct Reading {
  T value;
  std::vector<std::string> faults;
};

}  // namespace wingbeat
