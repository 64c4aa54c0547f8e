#pragma once

#include <deque>
#include <span>
#include <vector>

namespace wingbeat {

// Solutions of one problem at the designs solved last, for starts nearby.
class WarmStarts {
 public:
  // `scales` of the variables, by which distances are measured; at most `capacity` >= 1 solutions are kept.
  WarmStarts(std::vector<double> scales, std::size_t capacity)
      : scales_(std::move(scales)), capacity_(capacity) {}

  void add(std::span<const double> design, std::vector<double> solution);

  struct Start {
    std::vector<double> design;
    std::vector<double> solution;
  };
  bool is_empty() const { return starts_.empty(); }
  // There is one.
  const Start& nearest(std::span<const double> design) const;

 private:
  double squared_distance(std::span<const double> a, std::span<const double> b) const;

  std::vector<double> scales_;
  std::size_t capacity_;
  std::deque<Start> starts_;  // newest last
};

}  // namespace wingbeat
