#pragma once

#include <memory>
#include <span>
#include <vector>

namespace wingbeat {

// Rows and columns of a block-sparse matrix of cells, compressed by rows. Rows are the cells
// a rank owns; columns are its owned cells (numbers below row_count) and, after them, its ghosts.
// Columns of a row are sorted; every row has its diagonal.
struct BlockPattern {
  int row_count = 0;
  int column_count = 0;
  std::vector<int> row_begin;  // row_count + 1
  std::vector<int> columns;

  std::size_t block_count() const { return columns.size(); }
  int find(int row, int column) const;  // position in columns, or -1
};

// Block-sparse matrix with dense B x B blocks, row-major, one pattern shared by many matrices.
template <int B>
class BlockSparse {
 public:
  explicit BlockSparse(std::shared_ptr<const BlockPattern> pattern)
      : pattern_(std::move(pattern)), values_(pattern_->block_count() * B * B) {}

  const BlockPattern& pattern() const { return *pattern_; }
  std::shared_ptr<const BlockPattern> shared_pattern() const { return pattern_; }
  std::span<double> values() { return values_; }
  std::span<const double> values() const { return values_; }
  std::span<double, B * B> block(std::size_t position) {
    return std::span<double, B * B>(values_.data() + position * B * B, B * B);
  }
  void set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

  // y += A x, with x over all columns (owned, then ghosts) and y over rows.
  void multiply_add(std::span<const double> x_owned, std::span<const double> x_ghosts,
                    std::span<double> y) const;
  // (y_owned, y_ghosts) += A^T x.
  void transpose_multiply_add(std::span<const double> x, std::span<double> y_owned,
                              std::span<double> y_ghosts) const;

 private:
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<double> values_;
};

}  // namespace wingbeat
