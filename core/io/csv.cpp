#include "core/io/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/io/error.hpp"
#include "core/io/file.hpp"

namespace wingbeat {

namespace {

// RFC 4180: quotes around a text that holds a separator, doubled inside.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += c;
    result += c;
  }
  result += '"';
  return result;
}

std::string cell_text(const CsvTable::Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return quoted(*text);
  if (const auto* integer = std::get_if<long>(&cell)) return fmt::format("{}", *integer);
  return fmt::format("{}", std::get<double>(cell));
}

}  // namespace

CsvTable::CsvTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

void CsvTable::add(const std::vector<double>& row) { add(std::vector<Cell>(row.begin(), row.end())); }

void CsvTable::add(std::vector<Cell> row) {
  ensure(row.size() == columns_.size(), "a table row needs a cell for each column");
  rows_.push_back(std::move(row));
}

std::string CsvTable::text() const {
  std::vector<std::string> cells;
  for (const auto& column : columns_) cells.push_back(quoted(column));
  std::string text = fmt::format("{}\n", fmt::join(cells, ","));
  for (const auto& row : rows_) {
    cells.clear();
    for (const auto& cell : row) cells.push_back(cell_text(cell));
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

void CsvTable::write(const std::filesystem::path& path) const { write_file(path, text()); }

}  // namespace wingbeat
