#include "flow/mesh_lines.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

// What a cell at the end of a line tells its neighbours: who is beyond that end, and the end's number.
struct EndRecord {
  GhostSource beyond{-1, -1};
  int end = -1;
};
constexpr int record_size = 3;

// Records of all sides of all cells, [cell][direction][end], as the exchange takes them.
template <int Dim>
class EndRecords {
 public:
  static constexpr int width = 2 * Dim * record_size;

  explicit EndRecords(const FlowDomain<Dim>& domain)
      : owned_count_(domain.owned_count()),
        owned_(static_cast<std::size_t>(domain.owned_count()) * width, -1),
        ghosts_(static_cast<std::size_t>(domain.ghost_count()) * width, -1) {}

  void set(int cell, int direction, int end, const EndRecord& record) {
    int* values = owned_.data() + position(cell, direction, end);
    values[0] = record.beyond.rank, values[1] = record.beyond.index, values[2] = record.end;
  }
  EndRecord at(int cell, int direction, int end) const {
    const int* values = cell < owned_count_ ? owned_.data() + position(cell, direction, end)
                                            : ghosts_.data() + position(cell - owned_count_, direction, end);
    return {{values[0], values[1]}, values[2]};
  }
  void fetch(const GhostExchange& exchange) { exchange.gather<int>(owned_, ghosts_, 1, width); }

 private:
  static std::size_t position(int cell, int direction, int end) {
    return static_cast<std::size_t>(cell) * width +
           static_cast<std::size_t>((2 * direction + end) * record_size);
  }
  int owned_count_;
  std::vector<int> owned_;
  std::vector<int> ghosts_;
};

// A cell by the rank that owns it.
template <int Dim>
GhostSource global_name(const FlowDomain<Dim>& domain, int cell) {
  if (cell < domain.owned_count()) return {domain.comm().rank(), cell};
  return domain.exchange().sources()[static_cast<std::size_t>(cell - domain.owned_count())];
}

// Local number of the cell beyond an end of a line, -1 beyond a physical boundary.
template <int Dim>
int cell_beyond(const FlowBlock<Dim>& block, int direction, int end, const Index<Dim>& cell) {
  const auto& layout = block.geometry.layout;
  const std::ptrdiff_t step = end == 0 ? -layout.strides[direction] : layout.strides[direction];
  return block.number[static_cast<std::size_t>(layout.offset(cell) + step)];
}

// Calls f(cell, line) for the cells at one end of the block's lines of a direction.
template <int Dim, class F>
void for_each_end(const FlowBlock<Dim>& block, int direction, int end, F&& f) {
  Box<Dim> side = box_of<Dim>(block.geometry.layout.extents);
  const int position = end == 0 ? 0 : side.end[direction] - 1;
  side.begin[direction] = position;
  side.end[direction] = position + 1;
  int line = 0;
  for_each(side, [&](const Index<Dim>& cell) { f(cell, line++); });
}

// Numbers the ends of a direction and writes their records.
template <int Dim>
void number_ends(const FlowDomain<Dim>& domain, int direction, LineEnds& ends, EndRecords<Dim>& records) {
  for (const FlowBlock<Dim>& block : domain.blocks()) {
    ends.first.push_back({-1, -1});
    const MeshLines lines = mesh_lines(block, direction);
    for (const int end : {0, 1}) {
      bool goes_on = false;
      for_each_end(block, direction, end, [&](const Index<Dim>& cell, int) {
        goes_on = goes_on || cell_beyond<Dim>(block, direction, end, cell) >= 0;
      });
      if (!goes_on) continue;
      for_each_end(block, direction, end, [&](const Index<Dim>& cell, int line) {
        const int beyond = cell_beyond<Dim>(block, direction, end, cell);
        if (beyond < 0) return;
        const int number = block.first_cell + static_cast<int>(lines.cell(line, lines.end_position(end)));
        records.set(number, direction, end, {global_name(domain, beyond), ends.count + line});
      });
      ends.first.back()[static_cast<std::size_t>(end)] = ends.count;
      ends.count += lines.count();
    }
  }
}

// The end of the cell `beyond` that meets `end` of `cell`, or -1. Where both ends of a line of one
// or two cells meet the same cell, lines of one sense are assumed.
template <int Dim>
int opposite_end(const EndRecords<Dim>& records, const GhostSource& cell, int beyond, int direction,
                 int end) {
  for (const int other : {1 - end, end}) {
    const EndRecord record = records.at(beyond, direction, other);
    if (record.end >= 0 && record.beyond == cell) return record.end;
  }
  return -1;
}

template <int Dim>
std::vector<GhostSource> opposite_ends(const FlowDomain<Dim>& domain, int direction, const LineEnds& ends,
                                       const EndRecords<Dim>& records) {
  std::vector<GhostSource> sources;
  for (int own = 0; own < ends.count; ++own) sources.push_back({domain.comm().rank(), own});
  for (std::size_t b = 0; b < domain.blocks().size(); ++b) {
    const FlowBlock<Dim>& block = domain.blocks()[b];
    for (const int end : {0, 1}) {
      const int first = ends.first[b][static_cast<std::size_t>(end)];
      if (first < 0) continue;
      for_each_end(block, direction, end, [&](const Index<Dim>& cell, int line) {
        const int beyond = cell_beyond<Dim>(block, direction, end, cell);
        if (beyond < 0) return;
        const int number = block.number[static_cast<std::size_t>(block.geometry.layout.offset(cell))];
        const int opposite = opposite_end(records, global_name(domain, number), beyond, direction, end);
        if (opposite >= 0)
          sources[static_cast<std::size_t>(first + line)] = {global_name(domain, beyond).rank, opposite};
      });
    }
  }
  return sources;
}

}  // namespace

template <int Dim>
MeshLines mesh_lines(const FlowBlock<Dim>& block, int direction) {
  const auto& extents = block.geometry.layout.extents;
  MeshLines lines{block.first_cell, 1, extents[direction], 1};
  for (int d = 0; d < direction; ++d) lines.inner *= extents[d];
  for (int d = direction + 1; d < Dim; ++d) lines.outer *= extents[d];
  return lines;
}

template <int Dim>
std::array<LineEnds, Dim> connect_lines(const FlowDomain<Dim>& domain) {
  std::array<LineEnds, Dim> ends;
  EndRecords<Dim> records(domain);
  for (int d = 0; d < Dim; ++d) number_ends(domain, d, ends[static_cast<std::size_t>(d)], records);
  records.fetch(domain.exchange());
  for (int d = 0; d < Dim; ++d) {
    LineEnds& of_direction = ends[static_cast<std::size_t>(d)];
    of_direction.exchange = GhostExchange(domain.comm(), opposite_ends(domain, d, of_direction, records));
  }
  return ends;
}

template MeshLines mesh_lines<2>(const FlowBlock<2>&, int);
template MeshLines mesh_lines<3>(const FlowBlock<3>&, int);
template std::array<LineEnds, 2> connect_lines<2>(const FlowDomain<2>&);
template std::array<LineEnds, 3> connect_lines<3>(const FlowDomain<3>&);

}  // namespace wingbeat
