#include "optimize/objective_statement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "optimize/output_names.hpp"

namespace wingbeat {
namespace {

using Words = std::span<const StatementWord>;
using Kind = StatementWord::Kind;

std::optional<bool> is_maximizing(const StatementWord& word) {
  if (word.is("maximize") || word.is("maximise")) return true;
  if (word.is("minimize") || word.is("minimise")) return false;
  return std::nullopt;
}

void add_term(ObjectiveTerm term, Reading<ObjectiveStatement>& reading) {
  if (find_output(term.output) == nullptr) reading.faults.push_back(unknown_output(term.output));
  if (term.weight == 0.0)
    reading.faults.push_back(fmt::format("\"{}\" has the weight 0; drop it, or weigh it", term.output));
  if (std::ranges::find(reading.value.terms, term.output, &ObjectiveTerm::output) !=
      reading.value.terms.end())
    reading.faults.push_back(
        fmt::format("\"{}\" stands twice; give it once, with the sum of its weights", term.output));
  reading.value.terms.push_back(std::move(term));
}

// [sign] [number [*]] output, then the same with a sign.
void read_sum(Words words, Reading<ObjectiveStatement>& reading) {
  if (words.empty()) {
    reading.faults.push_back("no output is named; add one, such as \"maximize flutter_speed\"");
    return;
  }
  std::size_t i = 0;
  const auto holds = [&](auto&& test) { return i < words.size() && test(words[i]); };
  const auto is_number = [](const StatementWord& word) { return word.kind == Kind::number; };
  while (i < words.size()) {
    ObjectiveTerm term;
    const bool has_sign = words[i].is("+") || words[i].is("-");
    if (has_sign) term.weight = words[i++].is("-") ? -1.0 : 1.0;
    if (holds(is_number)) {
      term.weight *= words[i++].number;
      if (holds([](const StatementWord& word) { return word.is("*"); })) ++i;
    }
    const bool is_separated = has_sign || reading.value.terms.empty();
    if (!is_separated || !holds([](const StatementWord& word) { return word.kind == Kind::name; })) {
      reading.faults.push_back(
          fmt::format("cannot be read at \"{}\"; write a sum of outputs with weights, such as \"maximize "
                      "flutter_speed - 1.1 drag\"",
                      i < words.size() ? words[i].text : "its end"));
      return;
    }
    term.output = words[i++].text;
    add_term(std::move(term), reading);
  }
}

void read_single(std::string_view text, Words words, Reading<ObjectiveStatement>& reading) {
  const auto names_output = [](const StatementWord& word) { return find_output(word.text) != nullptr; };
  if (const OutputInfo* output = find_output(text)) {
    reading.value.is_maximized = output->sense == NaturalSense::maximize;
    reading.value.terms.push_back({output->name, 1.0});
    if (output->sense == NaturalSense::none)
      reading.faults.push_back(
          fmt::format("which way {0} is better depends; write \"maximize {0}\" or \"minimize {0}\"", text));
  } else if (std::ranges::any_of(words, names_output)) {
    reading.faults.push_back("a sum must begin with \"maximize\" or \"minimize\"; put one of them in front");
  } else {
    reading.faults.push_back(unknown_output(text));
  }
}

}  // namespace

Reading<ObjectiveStatement> read_objective(const std::string& text) {
  Reading<ObjectiveStatement> reading;
  reading.value.text = text;
  const std::vector<StatementWord> words = statement_words(text);
  const auto sense = words.empty() ? std::nullopt : is_maximizing(words[0]);
  if (sense) {
    reading.value.is_maximized = *sense;
    read_sum(Words(words).subspan(1), reading);
  } else {
    read_single(trimmed(text), words, reading);
  }
  return reading;
}

}  // namespace wingbeat
