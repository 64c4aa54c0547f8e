#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "optimize/nonlinear_program.hpp"

namespace wingbeat {

// A programme with its answers checked and kept: each point is evaluated once, however often and in whatever
// order it is asked for. Numbers that are not finite count as none. Throws InternalError for a wrong number
// of them and for crossed bounds.
class ProgramEvaluations {
 public:
  explicit ProgramEvaluations(NonlinearProgram& program);

  const ProgramBounds& bounds() const { return bounds_; }
  const std::vector<double>& start() const { return start_; }
  // Null where the point cannot be evaluated. Gradients follow the values of their point.
  const ProgramValues* values(std::span<const double> x);
  const ProgramGradients* gradients(std::span<const double> x);

  // Null also where they were never asked for: does not call the programme.
  const ProgramValues* known_values(std::span<const double> x) const;

  // Points whose values were asked for, whether there were any or not.
  std::size_t point_count() const { return values_.size(); }
  bool is_new(std::span<const double> x) const { return !values_.contains(Point(x.begin(), x.end())); }
  // Whether the programme's last answer was none.
  bool has_just_failed() const { return has_just_failed_; }

 private:
  using Point = std::vector<double>;

  std::optional<ProgramValues> finite_values(std::span<const double> x);
  std::optional<ProgramGradients> finite_gradients(std::span<const double> x);

  NonlinearProgram& program_;
  ProgramBounds bounds_;
  std::vector<double> start_;
  std::map<Point, std::optional<ProgramValues>> values_;
  std::map<Point, std::optional<ProgramGradients>> gradients_;
  bool has_just_failed_ = false;
};

}  // namespace wingbeat
