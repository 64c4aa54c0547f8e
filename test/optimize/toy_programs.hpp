#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "optimize/ipopt_adapter.hpp"

namespace wingbeat {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A programme made of functions; it records what an optimiser asks of it.
class ToyProgram final : public NonlinearProgram {
 public:
  using Point = std::vector<double>;

  ProgramBounds limits;
  Point first;
  std::function<std::optional<ProgramValues>(std::span<const double>)> give_values;
  std::function<std::optional<ProgramGradients>(std::span<const double>)> give_gradients;
  std::function<bool(const ProgramIteration&)> judge = [](const ProgramIteration&) { return true; };

  std::vector<Point> asked;  // for values, in order
  std::map<Point, int> value_calls, gradient_calls;
  int failures = 0;  // answers of none
  std::vector<ProgramIteration> iterations;

  ProgramBounds bounds() const override { return limits; }
  Point start() const override { return first; }
  std::optional<ProgramValues> values(std::span<const double> x) override {
    asked.emplace_back(x.begin(), x.end());
    ++value_calls[asked.back()];
    auto answer = give_values(x);
    failures += !answer;
    return answer;
  }
  std::optional<ProgramGradients> gradients(std::span<const double> x) override {
    ++gradient_calls[Point(x.begin(), x.end())];
    auto answer = give_gradients(x);
    failures += !answer;
    return answer;
  }
  bool observe(const ProgramIteration& iteration) override {
    iterations.push_back(iteration);
    return judge(iteration);
  }
};

// Problem 71 of Hock and Schittkowski, one inequality and one equality; f* = 17.0140173.
inline ToyProgram hock_schittkowski_71(double objective_factor = 1.0) {
  ToyProgram program;
  program.limits = {.x_lower = std::vector<double>(4, 1.0),
                    .x_upper = std::vector<double>(4, 5.0),
                    .g_lower = {25.0, 40.0},
                    .g_upper = {infinity, 40.0}};
  program.first = {1.0, 5.0, 5.0, 1.0};
  program.give_values = [=](std::span<const double> x) {
    return ProgramValues{objective_factor * (x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]),
                         {x[0] * x[1] * x[2] * x[3], x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]}};
  };
  program.give_gradients = [=](std::span<const double> x) {
    const double sum = x[0] + x[1] + x[2];
    ProgramGradients gradients{
        {x[3] * (x[0] + sum), x[0] * x[3], x[0] * x[3] + 1.0, x[0] * sum},
        {x[1] * x[2] * x[3], x[0] * x[2] * x[3], x[0] * x[1] * x[3], x[0] * x[1] * x[2],  //
         2.0 * x[0], 2.0 * x[1], 2.0 * x[2], 2.0 * x[3]}};
    for (double& derivative : gradients.objective) derivative *= objective_factor;
    return gradients;
  };
  return program;
}

// Rosenbrock's valley without constraints, x_0 <= limit: the minimum lies at (limit, limit^2) for limit <= 1.
inline ToyProgram rosenbrock(double limit) {
  ToyProgram program;
  program.limits = {.x_lower = {-1.5, -infinity}, .x_upper = {limit, HUGE_VAL}, .g_lower = {}, .g_upper = {}};
  program.first = {-1.2, 1.0};
  program.give_values = [](std::span<const double> x) {
    const double valley = x[1] - x[0] * x[0], slope = 1.0 - x[0];
    return ProgramValues{100.0 * valley * valley + slope * slope, {}};
  };
  program.give_gradients = [](std::span<const double> x) {
    const double valley = x[1] - x[0] * x[0];
    return ProgramGradients{{-400.0 * x[0] * valley - 2.0 * (1.0 - x[0]), 200.0 * valley}, {}};
  };
  return program;
}

// min x - weight log x, which exists for x > 0 alone though no bound says so; minimum at x = weight.
inline ToyProgram half_line(double weight) {
  ToyProgram program;
  program.limits = {.x_lower = {-infinity}, .x_upper = {infinity}, .g_lower = {}, .g_upper = {}};
  program.first = {2.0};
  program.give_values = [=](std::span<const double> x) -> std::optional<ProgramValues> {
    if (x[0] <= 0.0) return std::nullopt;
    return ProgramValues{x[0] - weight * std::log(x[0]), {}};
  };
  program.give_gradients = [=](std::span<const double> x) {
    return ProgramGradients{{1.0 - weight / x[0]}, {}};
  };
  return program;
}

// A circle that lies outside the square of the variables.
inline ToyProgram circle_out_of_reach() {
  ToyProgram program;
  program.limits = {.x_lower = {0.0, 0.0}, .x_upper = {1.0, 1.0}, .g_lower = {4.0}, .g_upper = {4.0}};
  program.first = {0.5, 0.2};
  program.give_values = [](std::span<const double> x) {
    return ProgramValues{x[0] - x[1], {x[0] * x[0] + x[1] * x[1]}};
  };
  program.give_gradients = [](std::span<const double> x) {
    return ProgramGradients{{1.0, -1.0}, {2.0 * x[0], 2.0 * x[1]}};
  };
  return program;
}

inline OptimizerResult minimize(ToyProgram& program, const IpoptOptions& options = {}) {
  return run_ipopt(program, options, [](std::string_view) {});
}

}  // namespace wingbeat
