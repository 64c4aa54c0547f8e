#include "core/algebra/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// A node nearer to its neighbour than this part of the newest step adds nothing but its errors.
constexpr double crowded = 0.1;
// Solutions nearer to each other than this, in the scales of the plane, are one: no direction is left in
// them.
constexpr double coincident = 1e-7;
// A target this little beyond a step is reached in the same step.
constexpr double stretch = 1.3;

// How steeply, in the scales of the plane, the amplitude must change along the way for it to make a good
// row: less, and the solution lies near a fold.
constexpr double least_slope = 0.1;

// The row that holds the target itself, from its prediction.
BranchRow row_at(const BranchTarget& target, const BranchPoint& point) {
  if (target.kind == BranchTarget::Kind::amplitude) return {target.value, point.speed, 1.0, 0.0};
  return {point.amplitude, target.value, 0.0, 1.0};
}

}  // namespace

BranchFollower::BranchFollower(BranchPoint behind, BranchPoint first, const BranchOptions& options,
                               Corrector corrector)
    : options_(options), corrector_(std::move(corrector)), step_(options.step) {
  ensure(behind.u.size() == first.u.size(), "continuation: solutions of different layouts");
  nodes_.push_back({std::move(behind), 0.0});
  accept(std::move(first));
  ensure(nodes_.back().length > 0.0, "continuation: two equal solutions give no direction");
}

// Lagrange's weights of the nodes at a length.
std::vector<double> BranchFollower::weights(double length) const {
  std::vector<double> result(nodes_.size(), 1.0);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (std::size_t j = 0; j < nodes_.size(); ++j)
      if (j != i) result[i] *= (length - nodes_[j].length) / (nodes_[i].length - nodes_[j].length);
  return result;
}

std::array<double, 2> BranchFollower::place(double length) const {
  const std::vector<double> weight = weights(length);
  std::array<double, 2> at{};
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    at[0] += weight[i] * nodes_[i].point.amplitude;
    at[1] += weight[i] * nodes_[i].point.speed;
  }
  return at;
}

BranchPoint BranchFollower::predicted(double length) const {
  const std::vector<double> weight = weights(length);
  const auto [amplitude, speed] = place(length);
  BranchPoint point{std::vector<double>(last().u.size(), 0.0), amplitude, speed};
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (std::size_t k = 0; k < point.u.size(); ++k) point.u[k] += weight[i] * nodes_[i].point.u[k];
  return point;
}

bool BranchFollower::grows() const {
  const double here = nodes_.back().length;
  return place(here + 0.1 * direction_ * step_)[0] > last().amplitude;
}

// The first length between two at which the prediction meets the target.
std::optional<double> BranchFollower::length_to(const BranchTarget& target, double from, double to) const {
  const auto miss = [&](double length) {
    return place(length)[target.kind == BranchTarget::Kind::amplitude ? 0 : 1] - target.value;
  };
  constexpr int samples = 16;
  for (int k = 0; k < samples; ++k) {
    double low = from + (to - from) * k / samples, high = from + (to - from) * (k + 1) / samples;
    const double at_low = miss(low), at_high = miss(high);
    if (at_high == 0.0) return high;
    if (at_low * at_high >= 0.0) continue;
    for (int bisection = 0; bisection < 60; ++bisection) {
      const double middle = 0.5 * (low + high);
      (miss(middle) * at_low > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  return std::nullopt;
}

std::optional<BranchStep> BranchFollower::look_back(const BranchTarget& target) {
  const double here = nodes_.back().length, before = nodes_[nodes_.size() - 2].length;
  auto searched = std::ranges::find(searched_, target, &std::pair<BranchTarget, double>::first);
  if (searched == searched_.end()) searched = searched_.insert(searched, {target, before});
  if (searched->second == here) return std::nullopt;
  const auto length = length_to(target, searched->second, here);
  searched->second = length ? *length + 1e-3 * (here - before) : here;
  if (!length) return std::nullopt;
  found_ = predicted(*length);
  const Correction correction = corrector_(found_, row_at(target, found_));
  if (correction.status == SolveStatus::interrupted) return BranchStep::interrupted;
  if (correction.status == SolveStatus::converged) return BranchStep::reached;
  why_ = fmt::format("the solution at the target did not converge ({})", to_string(correction.status));
  return BranchStep::failed;
}

// Where the way meets an amplitude within a step, unless near a fold of it: there a step goes over it, and
// it is met between. So are speeds, whose folds are what branches are followed for.
std::optional<double> BranchFollower::length_onto(const BranchTarget& target) const {
  if (target.kind == BranchTarget::Kind::speed) return std::nullopt;
  const double here = nodes_.back().length, step = direction_ * step_;
  const auto hit = length_to(target, here, here + stretch * step);
  if (!hit) return std::nullopt;
  const double probe = 0.05 * step;
  const double change = (place(*hit + probe)[0] - place(*hit - probe)[0]) / options_.amplitude_scale;
  if (std::abs(change) < least_slope * std::abs(2.0 * probe)) return std::nullopt;
  return hit;
}

// A line across the predicted way.
BranchRow BranchFollower::row_across(const BranchPoint& point) const {
  const double a = options_.amplitude_scale, v = options_.speed_scale;
  const double by_amplitude = (point.amplitude - last().amplitude) / a * point.amplitude / a;
  const double by_speed = (point.speed - last().speed) / v * point.speed / v;
  const double norm = std::abs(by_amplitude) + std::abs(by_speed);
  return {point.amplitude, point.speed, by_amplitude / norm, by_speed / norm};
}

// Nothing where no solution came of it.
std::optional<BranchStep> BranchFollower::try_step(const BranchTarget& target) {
  const double here = nodes_.back().length;
  const auto onto = length_onto(target);
  const double length = onto.value_or(here + direction_ * step_);
  BranchPoint point = predicted(length);
  if (!(point.amplitude > 0.0) || !(point.speed > 0.0)) {
    why_ = "the branch ends at rest";
    return std::nullopt;
  }
  const Correction correction = corrector_(point, onto ? row_at(target, point) : row_across(point));
  if (correction.status == SolveStatus::interrupted) return BranchStep::interrupted;
  if (correction.status != SolveStatus::converged) {
    why_ = fmt::format("the next solution did not converge ({})", to_string(correction.status));
    return std::nullopt;
  }
  const double taken = std::abs(length - here);
  if (taken > 0.7 * step_) {
    const double pace = static_cast<double>(options_.wanted_iterations) / std::max(correction.iterations, 1);
    step_ = std::min(taken * std::clamp(pace, 0.5, 1.5), options_.largest_step);
  }
  accept(std::move(point));
  if (!onto) return BranchStep::advanced;
  found_ = last();
  searched_.emplace_back(target, nodes_.back().length);
  return BranchStep::reached;
}

BranchStep BranchFollower::advance(const BranchTarget& target) {
  if (const auto outcome = look_back(target)) return *outcome;
  while (step_ >= options_.least_step) {
    if (const auto outcome = try_step(target)) return *outcome;
    step_ *= 0.5;
  }
  why_ += fmt::format(", even with a step of {:.1e}", 2.0 * step_);
  return BranchStep::failed;
}

void BranchFollower::accept(BranchPoint point) {
  const double step = std::hypot((point.amplitude - last().amplitude) / options_.amplitude_scale,
                                 (point.speed - last().speed) / options_.speed_scale);
  if (nodes_.size() > 1 && step < coincident) {
    nodes_.back().point = std::move(point);
    return;
  }
  const double length = nodes_.back().length + direction_ * step;
  for (std::size_t i = nodes_.size(); i-- > 1;)
    if (std::abs(nodes_[i].length - nodes_[i - 1].length) < crowded * step)
      nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(i - 1));
  std::erase_if(nodes_, [&](const Node& node) { return std::abs(node.length - length) < crowded * step; });
  nodes_.push_back({std::move(point), length});
  if (nodes_.size() > static_cast<std::size_t>(options_.order) + 1) nodes_.erase(nodes_.begin());
  searched_.clear();
}

void BranchFollower::convert(const std::function<std::vector<double>(const std::vector<double>&)>& layout) {
  for (Node& node : nodes_) node.point.u = layout(node.point.u);
}

}  // namespace wingbeat
