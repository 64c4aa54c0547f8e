#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace wingbeat {

// A table of named columns; numbers are written so that they read back exactly.
class CsvTable {
 public:
  using Cell = std::variant<double, long, std::string>;

  explicit CsvTable(std::vector<std::string> columns);

  // A row with a cell for each column.
  void add(const std::vector<double>& row);
  void add(std::vector<Cell> row);

  std::size_t row_count() const { return rows_.size(); }
  std::string text() const;
  // Replaces the file in one step. Throws InputError when it cannot be written.
  void write(const std::filesystem::path& path) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace wingbeat
