#include "structure/aerodynamic_table_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <complex>
#include <sstream>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) found.push_back(trimmed(field));
  return found;
}

void check_columns(const std::vector<std::string>& found, const std::string& place, int modes) {
  const auto expected = aerodynamic_columns(modes, false);
  if (found == expected || (modes == 2 && found == aerodynamic_columns(2, true))) return;
  if (found.size() != expected.size())
    throw InputError(
        fmt::format("{}: {} columns; {} modes need {}: k, then real and imaginary part of the "
                    "entries of Q row by row, Q11_re, Q11_im, ...",
                    place, found.size(), modes, expected.size()));
  std::size_t i = 0;
  while (i < found.size() && found[i] == expected[i]) ++i;
  throw InputError(
      fmt::format("{}: column {} is named \"{}\"; expected \"{}\"", place, i + 1, found[i], expected[i]));
}

double number(const std::string& text, const std::string& place) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end)
    throw InputError(fmt::format("{}: \"{}\" is not a number", place, text));
  return value;
}

}  // namespace

std::vector<std::string> aerodynamic_columns(int modes, bool is_typical_section) {
  ensure(!is_typical_section || modes == 2, "a typical section has two modes");
  const auto entry = [&](int i, int j) -> std::string {
    if (is_typical_section) return {"ha"[i], "ha"[j]};
    return fmt::format("{}{}{}", i + 1, modes < 10 ? "" : "_", j + 1);
  };
  std::vector<std::string> names{"k"};
  for (int i = 0; i < modes; ++i)
    for (int j = 0; j < modes; ++j)
      for (const char* part : {"re", "im"}) names.push_back(fmt::format("Q{}_{}", entry(i, j), part));
  return names;
}

CsvTable aerodynamic_csv(const AerodynamicTable& table, bool is_typical_section) {
  CsvTable csv(aerodynamic_columns(table.size(), is_typical_section));
  for (std::size_t s = 0; s < table.samples().size(); ++s) {
    std::vector<double> row{table.sampled_k()[s]};
    for (int i = 0; i < table.size(); ++i)
      for (int j = 0; j < table.size(); ++j) {
        const std::complex<double> q = table.samples()[s](i, j);
        row.insert(row.end(), {q.real(), q.imag()});
      }
    csv.add(row);
  }
  return csv;
}

AerodynamicTable read_aerodynamic_table(const std::string& text, const std::string& path, int modes) {
  std::vector<double> k;
  std::vector<Eigen::MatrixXcd> samples;
  std::istringstream stream(text);
  bool has_header = false;
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    const std::string place = fmt::format("{}:{}", path, ++line_number);
    if (trimmed(line).empty() || line.front() == '#') continue;
    const std::vector<std::string> row = fields(line);
    if (!has_header) {
      check_columns(row, place, modes);
      has_header = true;
      continue;
    }
    const auto expected = static_cast<std::size_t>(1 + 2 * modes * modes);
    if (row.size() != expected)
      throw InputError(fmt::format("{}: {} values in a table of {} columns", place, row.size(), expected));
    k.push_back(number(row[0], place));
    Eigen::MatrixXcd q(modes, modes);
    std::size_t at = 1;
    for (int i = 0; i < modes; ++i)
      for (int j = 0; j < modes; ++j, at += 2) q(i, j) = {number(row[at], place), number(row[at + 1], place)};
    samples.push_back(std::move(q));
  }
  try {
    return {std::move(k), std::move(samples)};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace wingbeat
