#include "optimize/statement_words.hpp"

#include <cctype>
#include <charconv>

namespace wingbeat {
namespace {

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_relation(char c) { return c == '<' || c == '>' || c == '='; }

template <class Test>
std::size_t run_length(std::string_view text, Test&& belongs) {
  std::size_t length = 0;
  while (length < text.size() && belongs(text[length])) ++length;
  return length;
}

// The word at the beginning of a text that does not begin with a blank.
StatementWord first_word(std::string_view text) {
  using Kind = StatementWord::Kind;
  if (is_letter(text[0])) {
    const std::size_t length = run_length(text, [](char c) { return is_letter(c) || is_digit(c); });
    return {Kind::name, std::string(text.substr(0, length)), 0.0};
  }
  if (is_relation(text[0]))
    return {Kind::relation, std::string(text.substr(0, run_length(text, is_relation))), 0.0};
  if (is_digit(text[0]) || text[0] == '.') {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{})
      return {Kind::number, std::string(text.substr(0, static_cast<std::size_t>(end - text.data()))), value};
  }
  return {Kind::symbol, std::string(text.substr(0, 1)), 0.0};
}

}  // namespace

std::vector<StatementWord> statement_words(std::string_view text) {
  std::vector<StatementWord> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    words.push_back(first_word(text));
    text.remove_prefix(words.back().text.size());
  }
  return words;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace wingbeat
