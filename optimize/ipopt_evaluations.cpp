#include "optimize/ipopt_evaluations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

template <class Number>
const Number* address(const std::optional<Number>& value) {
  return value ? &*value : nullptr;
}

bool are_finite(std::span<const double> numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

void ensure_count(std::size_t count, std::size_t expected, const char* what) {
  ensure(count == expected, fmt::format("the programme gave {} {}, not {}", count, what, expected));
}

void ensure_ordered(std::span<const double> lower, std::span<const double> upper, const char* what) {
  ensure_count(upper.size(), lower.size(), what);
  for (std::size_t i = 0; i < lower.size(); ++i)
    ensure(lower[i] <= upper[i], fmt::format("{} cross at {}: {} > {}", what, i, lower[i], upper[i]));
}

}  // namespace

ProgramEvaluations::ProgramEvaluations(NonlinearProgram& program)
    : program_(program), bounds_(program.bounds()), start_(program.start()) {
  ensure(!start_.empty(), "a programme without variables");
  ensure_count(bounds_.x_lower.size(), start_.size(), "bounds of variables");
  ensure_ordered(bounds_.x_lower, bounds_.x_upper, "bounds of variables");
  ensure_ordered(bounds_.g_lower, bounds_.g_upper, "bounds of constraints");
}

const ProgramValues* ProgramEvaluations::values(std::span<const double> x) {
  Point point(x.begin(), x.end());
  if (const auto found = values_.find(point); found != values_.end()) return address(found->second);
  auto fresh = finite_values(x);
  has_just_failed_ = !fresh;
  return address(values_.emplace(std::move(point), std::move(fresh)).first->second);
}

const ProgramGradients* ProgramEvaluations::gradients(std::span<const double> x) {
  if (!values(x)) return nullptr;
  Point point(x.begin(), x.end());
  if (const auto found = gradients_.find(point); found != gradients_.end()) return address(found->second);
  auto fresh = finite_gradients(x);
  has_just_failed_ = !fresh;
  return address(gradients_.emplace(std::move(point), std::move(fresh)).first->second);
}

const ProgramValues* ProgramEvaluations::known_values(std::span<const double> x) const {
  const auto found = values_.find(Point(x.begin(), x.end()));
  return found == values_.end() ? nullptr : address(found->second);
}

std::optional<ProgramValues> ProgramEvaluations::finite_values(std::span<const double> x) {
  auto values = program_.values(x);
  if (!values) return std::nullopt;
  ensure_count(values->constraints.size(), bounds_.g_lower.size(), "constraints");
  if (!std::isfinite(values->objective) || !are_finite(values->constraints)) return std::nullopt;
  return values;
}

std::optional<ProgramGradients> ProgramEvaluations::finite_gradients(std::span<const double> x) {
  auto gradients = program_.gradients(x);
  if (!gradients) return std::nullopt;
  ensure_count(gradients->objective.size(), x.size(), "derivatives of the objective");
  ensure_count(gradients->constraints.size(), x.size() * bounds_.g_lower.size(),
               "derivatives of constraints");
  if (!are_finite(gradients->objective) || !are_finite(gradients->constraints)) return std::nullopt;
  return gradients;
}

}  // namespace wingbeat
