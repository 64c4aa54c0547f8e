#include "apps/sweep/sweep_record.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>

#include "apps/sweep/sweep_branches.hpp"
#include "apps/sweep/sweep_points.hpp"
#include "core/io/changed_keys.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// Columns that come first, and those that come last, where they are there.
const std::vector<std::string> leading{"reduced_velocity", "frequency_ratio", "status"};
const std::vector<std::string> trailing{"reason", "point", "start", "seconds"};

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

CsvTable::Cell cell(const SweepLine& row, const std::string& name) {
  if (!row.contains(name) || row[name].is_null()) return std::string();
  const SweepLine& value = row[name];
  if (value.is_boolean()) return value.get<bool>() ? 1L : 0L;
  if (value.is_number_integer()) return value.get<long>();
  if (value.is_number()) return value.get<double>();
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void check_head(const SweepLine& found, const std::string& path, const SweepLine& head) {
  const std::string remedy = "choose another --output, or remove the file to begin anew";
  const bool is_head =
      found.is_object() && found.contains("case") && found.contains("verb") && found.contains("parameters");
  if (!is_head) throw InputError(fmt::format("{}:1: is not the record of a sweep; {}", path, remedy));
  for (const char* name : {"verb", "parameters"})
    if (found[name] != head[name])
      throw InputError(fmt::format("{}: is of a sweep of {} {}, this is one of {} {}; {}", path,
                                   found["verb"].dump(), found["parameters"].dump(), head["verb"].dump(),
                                   head["parameters"].dump(), remedy));
  if (const auto changed = changed_keys(found["case"], head["case"]); !changed.empty())
    throw InputError(
        fmt::format("{}: its points are of a case with other values of {}; give these the values "
                    "they had, {}",
                    path, fmt::join(changed, ", "), remedy));
}

bool comes_before(const SweepLine& a, const SweepLine& b) {
  for (const auto& [key, value] : a["parameters"].items()) {
    const SweepLine& other = b["parameters"][key];
    if (value == other) continue;
    return value < other;
  }
  return false;
}

std::vector<SweptRoot> roots_of(const SweepLine& line) {
  std::vector<SweptRoot> roots;
  for (const SweepLine& row : line["results"])
    if (row.contains("reduced_velocity") && row.contains("frequency_ratio"))
      roots.push_back({row["reduced_velocity"].get<double>(), row["frequency_ratio"].get<double>()});
  return roots;
}

void number_branches(const std::vector<std::string>& keys, std::vector<SweepLine>& lines) {
  if (keys.size() != 1) return;
  std::vector<double> places;
  std::vector<std::vector<SweptRoot>> roots;
  for (const SweepLine& line : lines) {
    const SweepLine& value = line["parameters"][keys[0]];
    if (!value.is_number()) return;
    places.push_back(value.get<double>());
    roots.push_back(roots_of(line));
    if (roots.back().size() != line["results"].size()) return;
  }
  const auto numbers = linked_branches(places, roots);
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t r = 0; r < numbers[i].size(); ++r) lines[i]["results"][r]["branch"] = numbers[i][r];
}

}  // namespace

SweepLine parameter_values(const std::vector<std::string>& keys, const std::vector<std::string>& values) {
  SweepLine parameters = SweepLine::object();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto number = number_in(values[i]);
    parameters[keys[i]] = number ? SweepLine(*number) : SweepLine(values[i]);
  }
  return parameters;
}

const SweepLine* line_of(const std::vector<SweepLine>& lines, const SweepLine& parameters) {
  const auto found =
      std::ranges::find_if(lines, [&](const SweepLine& line) { return line["parameters"] == parameters; });
  return found == lines.end() ? nullptr : &*found;
}

SweepLines read_sweep_lines(const std::string& text, const std::string& path, const SweepLine& head) {
  SweepLines lines;
  std::istringstream stream(text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    const SweepLine read = SweepLine::parse(line, nullptr, false);
    const bool is_cut_short = read.is_discarded() && stream.eof() && number > 0;
    if (is_cut_short) break;
    if (read.is_discarded())
      throw InputError(fmt::format(
          "{}:{}: is not a line of JSON; remove this line, or the file to begin anew", path, number + 1));
    if (++number == 1) {
      check_head(read, path, head);
      continue;
    }
    std::vector<SweepLine>& same = read["status"] == "begun" ? lines.begun : lines.ended;
    std::erase_if(same, [&](const SweepLine& held) { return held["parameters"] == read["parameters"]; });
    same.push_back(read);
  }
  std::erase_if(lines.begun, [&](const SweepLine& line) { return line_of(lines.ended, line["parameters"]); });

  if (number == 0) throw InputError(fmt::format("{}: is empty; remove the file to begin anew", path));
  return lines;
}

void append_line(const std::filesystem::path& path, const SweepLine& line) {
  const std::string text = line.dump(-1, ' ', false, SweepLine::error_handler_t::replace) + "\n";
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  const bool is_written = file >= 0 &&
                          ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                          ::fsync(file) == 0;
  const int reason = errno;
  if (file >= 0) ::close(file);
  if (!is_written)
    throw InputError(fmt::format("{}: cannot write the file: {}", path.string(), std::strerror(reason)));
}

CsvTable sweep_table(const std::vector<std::string>& keys, std::vector<SweepLine> lines) {
  std::ranges::stable_sort(lines, comes_before);
  number_branches(keys, lines);
  std::vector<SweepLine> rows;
  std::vector<std::string> others;
  for (const SweepLine& line : lines) {
    std::vector<SweepLine> results = line["results"];
    if (results.empty()) results.push_back(SweepLine::object());
    for (SweepLine& row : results) {
      for (const auto& [name, value] : row.items())
        if (!holds(leading, name) && !holds(trailing, name) && !holds(others, name)) others.push_back(name);
      row.update(line["parameters"]);
      for (const char* name : {"status", "reason", "point", "start", "seconds"}) row[name] = line[name];
      rows.push_back(std::move(row));
    }
  }
  std::vector<std::string> columns = keys;
  const auto is_used = [&](const std::string& name) {
    return std::ranges::any_of(rows, [&](const SweepLine& row) { return row.contains(name); });
  };
  for (const std::string& name : leading)
    if (is_used(name)) columns.push_back(name);
  columns.insert(columns.end(), others.begin(), others.end());
  columns.insert(columns.end(), trailing.begin(), trailing.end());
  CsvTable table(columns);
  for (const SweepLine& row : rows) {
    std::vector<CsvTable::Cell> cells;
    for (const std::string& name : columns) cells.push_back(cell(row, name));
    table.add(std::move(cells));
  }
  return table;
}

}  // namespace wingbeat
