#include "core/algebra/ilu_pattern.hpp"

#include <algorithm>
#include <limits>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// The columns of one row with their levels of fill, linked in rising order.
class LevelRow {
 public:
  explicit LevelRow(int n) : end_(n), next_(n + 1, n), level_(n, dropped) {}

  void start(std::span<const int> columns) {
    int last = end_;  // the head of the list
    for (const int column : columns) {
      next_[last] = column;
      level_[column] = 0;
      last = column;
    }
    next_[last] = end_;
  }
  int first() const { return next_[end_]; }
  int after(int column) const { return next_[column]; }
  int end() const { return end_; }
  int level(int column) const { return level_[column]; }

  // Lowers the level of a column, added where it was not; `from` is a column of the row before it.
  void offer(int column, int level, int from) {
    if (level_[column] == dropped) {
      while (next_[from] < column) from = next_[from];
      next_[column] = next_[from];
      next_[from] = column;
    }
    level_[column] = std::min(level_[column], level);
  }
  void clear() {
    for (int column = first(); column != end_; column = next_[column]) level_[column] = dropped;
  }

 private:
  static constexpr int dropped = std::numeric_limits<int>::max();
  int end_;
  std::vector<int> next_;
  std::vector<int> level_;
};

}  // namespace

IluPattern ilu_pattern(std::span<const int> row_begin, std::span<const int> columns, int fill) {
  ensure(fill >= 0, "ilu_pattern: negative level of fill");
  const int n = static_cast<int>(row_begin.size()) - 1;
  IluPattern pattern{.row_begin = {0}, .columns = {}, .diagonal = {}, .positions = {}};
  std::vector<int> levels;  // of pattern.columns
  LevelRow row(n);
  for (int i = 0; i < n; ++i) {
    const auto given = columns.subspan(row_begin[i], row_begin[i + 1] - row_begin[i]);
    ensure(std::binary_search(given.begin(), given.end(), i), "ilu_pattern: a row without its diagonal");
    row.start(given);
    for (int k = row.first(); k < i; k = row.after(k)) {
      int from = k;
      for (int p = pattern.diagonal[k] + 1; p < pattern.row_begin[k + 1]; ++p) {
        const int level = row.level(k) + levels[p] + 1;
        if (level > fill) continue;
        row.offer(pattern.columns[p], level, from);
        from = pattern.columns[p];
      }
    }
    for (int column = row.first(); column != row.end(); column = row.after(column)) {
      if (column == i) pattern.diagonal.push_back(static_cast<int>(pattern.columns.size()));
      pattern.columns.push_back(column);
      levels.push_back(row.level(column));
    }
    auto at = pattern.columns.begin() + pattern.row_begin[i];
    for (const int column : given) {
      at = std::lower_bound(at, pattern.columns.end(), column);
      pattern.positions.push_back(static_cast<int>(at - pattern.columns.begin()));
    }
    row.clear();
    pattern.row_begin.push_back(static_cast<int>(pattern.columns.size()));
  }
  return pattern;
}

}  // namespace wingbeat
