#include <algorithm>
#include <map>
#include <utility>

#include "core/algebra/cuthill_mckee_order.hpp"
#include "core/algebra/fill_reducing_order.hpp"
#include "core/algebra/schwarz.hpp"
#include "core/algebra/subdomain_data.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// A block of a matrix row: the cell of its column, and its position in the owner's matrix.
struct RowEntry {
  GhostSource column;
  int position = 0;
};
using Row = std::vector<RowEntry>;

// The distributed matrix graph: rows of this rank's and, on request, of other ranks' cells.
class MatrixGraph {
 public:
  MatrixGraph(const Comm& comm, std::span<const GhostSource> ghosts, const BlockPattern& pattern)
      : comm_(comm), ghosts_(ghosts), pattern_(pattern) {}

  Row own_row(int row) const {
    Row entries;
    for (int k = pattern_.row_begin[row]; k < pattern_.row_begin[row + 1]; ++k) {
      const int column = pattern_.columns[k];
      entries.push_back({column < pattern_.row_count ? GhostSource{comm_.rank(), column}
                                                     : ghosts_[column - pattern_.row_count],
                         k});
    }
    return entries;
  }

  // The rows of `cells`, sorted by rank, from their owners, in the same order. Collective.
  std::vector<Row> rows_of(const std::vector<GhostSource>& cells) const {
    std::vector<std::vector<int>> wanted(comm_.size());
    for (const GhostSource& cell : cells) wanted[cell.rank].push_back(cell.index);
    const auto requests = comm_.all_to_all(wanted);
    std::vector<std::vector<int>> answers(comm_.size());
    for (int rank = 0; rank < comm_.size(); ++rank)
      for (const int index : requests[rank]) append(answers[rank], own_row(index));
    const auto received = comm_.all_to_all(answers);

    std::vector<Row> rows;
    std::vector<std::size_t> cursor(comm_.size(), 0);
    for (const GhostSource& cell : cells) rows.push_back(extract(received[cell.rank], cursor[cell.rank]));
    return rows;
  }

 private:
  static void append(std::vector<int>& message, const Row& row) {
    message.push_back(static_cast<int>(row.size()));
    for (const RowEntry& entry : row)
      message.insert(message.end(), {entry.column.rank, entry.column.index, entry.position});
  }
  static Row extract(const std::vector<int>& message, std::size_t& at) {
    Row row(static_cast<std::size_t>(message[at++]));
    for (RowEntry& entry : row) {
      entry = {{message[at], message[at + 1]}, message[at + 2]};
      at += 3;
    }
    return row;
  }

  const Comm& comm_;
  std::span<const GhostSource> ghosts_;
  const BlockPattern& pattern_;
};

// The overlap, grown breadth-first over the matrix graph.
struct Overlap {
  std::vector<GhostSource> cells;
  std::vector<Row> rows;
  std::map<GhostSource, int> number;  // among cells
};

Overlap grow_overlap(const Comm& comm, const MatrixGraph& graph, int own_rows, int layers) {
  Overlap overlap;
  std::vector<Row> newest;
  for (int row = 0; row < own_rows; ++row) newest.push_back(graph.own_row(row));
  for (int layer = 0; layer < layers; ++layer) {
    std::vector<GhostSource> frontier;
    for (const Row& row : newest)
      for (const RowEntry& entry : row)
        if (entry.column.rank != comm.rank() && !overlap.number.contains(entry.column))
          frontier.push_back(entry.column);
    std::sort(frontier.begin(), frontier.end());
    frontier.erase(std::unique(frontier.begin(), frontier.end()), frontier.end());

    for (const GhostSource& cell : frontier) {
      overlap.number.emplace(cell, static_cast<int>(overlap.cells.size()));
      overlap.cells.push_back(cell);
    }
    newest = graph.rows_of(frontier);
    overlap.rows.insert(overlap.rows.end(), newest.begin(), newest.end());
  }
  return overlap;
}

}  // namespace

Subdomain::Subdomain(const Comm& comm, const GhostExchange& halo, std::shared_ptr<const BlockPattern> pattern,
                     const SubdomainOptions& options)
    : data_(std::make_unique<Data>()) {
  ensure(options.overlap >= 0, "Subdomain: negative overlap");
  ensure(pattern->column_count - pattern->row_count == static_cast<int>(halo.ghost_count()),
         "Subdomain: the pattern's ghost columns are not those of the halo");
  const MatrixGraph graph(comm, halo.sources(), *pattern);
  const Overlap overlap = grow_overlap(comm, graph, pattern->row_count, options.overlap);

  Data& d = *data_;
  d.owned_count = pattern->row_count;
  d.cell_count = d.owned_count + static_cast<int>(overlap.cells.size());
  d.own_block_count = pattern->block_count();
  d.overlap_cells = GhostExchange(comm, overlap.cells);

  // Each row restricted to the subdomain, by cell numbers: (column, origin).
  std::vector<std::vector<std::pair<int, int>>> rows(d.cell_count);
  std::vector<GhostSource> fetched;
  const auto restrict_row = [&](int cell, const Row& row) {
    const bool own = cell < d.owned_count;
    for (const RowEntry& entry : row) {
      int column = entry.column.index;
      if (entry.column.rank != comm.rank()) {
        const auto found = overlap.number.find(entry.column);
        if (found == overlap.number.end()) continue;
        column = d.owned_count + found->second;
      }
      rows[cell].emplace_back(column,
                              own ? entry.position : static_cast<int>(d.own_block_count + fetched.size()));
      if (!own) fetched.push_back({overlap.cells[cell - d.owned_count].rank, entry.position});
    }
  };
  for (int cell = 0; cell < d.owned_count; ++cell) restrict_row(cell, graph.own_row(cell));
  for (int cell = d.owned_count; cell < d.cell_count; ++cell)
    restrict_row(cell, overlap.rows[cell - d.owned_count]);
  d.overlap_blocks = GhostExchange(comm, fetched);

  std::vector<int> row_begin{0}, columns;
  for (const auto& row : rows) {
    for (const auto& [column, origin] : row) columns.push_back(column);
    row_begin.push_back(static_cast<int>(columns.size()));
  }
  const bool is_incomplete = options.method == SubdomainMethod::ilu;
  d.order = is_incomplete ? cuthill_mckee_order(row_begin, columns) : fill_reducing_order(row_begin, columns);

  std::vector<int> step(d.cell_count);
  for (int q = 0; q < d.cell_count; ++q) step[d.order[q]] = q;
  d.row_begin = {0};
  for (const int cell : d.order) {
    for (auto& [column, origin] : rows[cell]) column = step[column];
    std::sort(rows[cell].begin(), rows[cell].end());
    for (const auto& [column, origin] : rows[cell]) {
      d.columns.push_back(column);
      d.origins.push_back(origin);
    }
    d.row_begin.push_back(static_cast<int>(d.columns.size()));
  }
  if (is_incomplete)
    d.ilu = std::make_shared<const IluPattern>(ilu_pattern(d.row_begin, d.columns, options.fill));
}

Subdomain::~Subdomain() = default;
Subdomain::Subdomain(Subdomain&&) noexcept = default;

int Subdomain::owned_count() const { return data_->owned_count; }
int Subdomain::cell_count() const { return data_->cell_count; }

}  // namespace wingbeat
