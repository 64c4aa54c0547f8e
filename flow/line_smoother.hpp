#pragma once

#include <array>
#include <span>
#include <vector>

#include "flow/mesh_lines.hpp"

namespace wingbeat {

// How the cell at an end of a line responds to unit jumps across the line's ends.
struct EndResponse {
  double own = 0.0;  // to the jump across this end
  double far = 0.0;  // to the jump across the other end
};

// The smoothing equations (eq:residual-smoothing) of a block's lines of one direction, solved with
// zero gradient at both ends. Where a line goes on beyond an end, the value there differs from that
// of the end cell by a jump, to which the line responds with a spike that decays into the block
// (eq:smoothing-spike); it is added once the jump is known.
class LineSmoother {
 public:
  explicit LineSmoother(const MeshLines& lines);

  // eps: [cell of the block], not negative. spikes[end]: whether lines go on beyond that end.
  void factorize(std::span<const double> eps, const std::array<bool, 2>& spikes);

  // values: [cell of the block][N], smoothed in place with zero gradient at the ends.
  template <int N>
  void solve(double* values) const;

  // at_end: [line][N], the values of the cells at an end.
  template <int N>
  void copy_end(int end, const double* values, double* at_end) const;

  // jumps: [line][N], smoothed value beyond the end less that of the end cell.
  template <int N>
  void add_spikes(int end, const double* jumps, double* values) const;

  EndResponse response(int line, int end) const {
    return responses_[static_cast<std::size_t>(end)][static_cast<std::size_t>(line)];
  }
  const MeshLines& lines() const { return lines_; }

 private:
  void set_spike(int end, std::span<const double> decay);

  MeshLines lines_;
  bool smooths_ = false;                               // some eps is not zero
  std::vector<double> pivot_;                          // reciprocals of the eliminated diagonal, [cell]
  std::vector<double> transfer_;                       // eps times pivot: what a cell passes on to the next
  std::array<int, 2> depth_{};                         // cells that a spike reaches
  std::array<std::vector<double>, 2> spike_;           // [end]: [outer][distance from the end][inner]
  std::array<std::vector<EndResponse>, 2> responses_;  // [end][line]
};

}  // namespace wingbeat
