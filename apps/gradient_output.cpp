#include "apps/gradient_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "apps/on_root.hpp"
#include "core/io/csv.hpp"

namespace wingbeat {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double difference_of(const GradientReport& report, std::size_t i) {
  const bool is_known = report.check && i < report.check->differences.size();
  return is_known ? report.check->differences[i] : unknown;
}

// The bump that stands for all in figures: two thirds of the way from the nose to the upper trailing edge's.
int sample_bump(const HicksHenne& bumps) { return bumps.bumps() * 5 / 6; }

CsvTable gradient_table(const DesignVariables& variables, const GradientReport& report) {
  CsvTable table({"name", "derivative", "difference"});
  for (std::size_t i = 0; i < variables.size(); ++i)
    table.add(
        std::vector<CsvTable::Cell>{variables.name(i), report.derivatives[i], difference_of(report, i)});
  return table;
}

CsvTable wall_table(const ShapeVariables& shape, const std::vector<Vec<double, 2>>& sensitivity) {
  CsvTable table({"s", "x", "y", "normal_x", "normal_y", "area", "derivative_x", "derivative_y",
                  "derivative_normal", "sample_bump"});
  const SectionWall& wall = shape.wall();
  for (std::size_t i = 0; i < wall.size(); ++i)
    table.add(std::vector<double>{wall.s[i], wall.positions[i][0], wall.positions[i][1], wall.normals[i][0],
                                  wall.normals[i][1], wall.areas[i], sensitivity[i][0], sensitivity[i][1],
                                  dot(sensitivity[i], wall.normals[i]) / wall.areas[i],
                                  shape.bumps().bump(sample_bump(shape.bumps()), wall.s[i])});
  return table;
}

// Where the wall is at an arc parameter.
Vec<double, 2> wall_at(const SectionWall& wall, double s) {
  const auto above = std::ranges::upper_bound(wall.s, s);
  const auto i = static_cast<std::size_t>(above - wall.s.begin());
  const std::size_t low = i - 1, high = i % wall.size();
  const double s_high = high == 0 ? 1.0 : wall.s[high];
  const double share = (s - wall.s[low]) / (s_high - wall.s[low]);
  return (1.0 - share) * wall.positions[low] + share * wall.positions[high];
}

CsvTable bump_table(const ShapeVariables& shape) {
  CsvTable table({"bump", "s", "x", "y"});
  for (int i = 0; i < shape.bumps().bumps(); ++i) {
    const double s = shape.bumps().peak(i);
    const Vec<double, 2> x = wall_at(shape.wall(), s);
    table.add(std::vector<double>{static_cast<double>(i + 1), s, x[0], x[1]});
  }
  return table;
}

void print(Context& context, const DesignVariables& variables, const GradientReport& report) {
  Log& log = context.log;
  constexpr std::size_t most = 60;
  log.line("\n{} = {:.10g}", context.settings.gradient.objective, report.value);
  const bool has_differences = report.check && !report.check->differences.empty();
  log.line("{:<26}{:>20}{}{}", "parameter", "derivative", has_differences ? "          difference" : "",
           report.errors.empty() ? "" : "     error");
  for (std::size_t i = 0; i < std::min(variables.size(), most); ++i)
    log.line("{:<26}{:>20.10e}{}{}", variables.name(i), report.derivatives[i],
             has_differences ? fmt::format("{:>20.10e}", difference_of(report, i)) : "",
             report.errors.empty() ? "" : fmt::format("{:>10.1e}", report.errors[i]));
  if (variables.size() > most) log.line("... {} more in gradient.csv", variables.size() - most);
  log.line("adjoint: {} Krylov iterations, residual {:.1e}", report.adjoints.iterations(),
           report.adjoints.relative_residual());
  if (!report.check) return;
  log.line("transpose of the Jacobian        {:.1e}", report.check->transpose);
  log.line("adjoint against tangent          {:.1e}", report.check->tangent);
  log.line("adjoint against differences      {:.1e}", report.check->finite_difference);
  log.line("{:>12}{:>22}{:>14}", "step", "central difference", "error");
  for (const DifferenceStep& s : report.check->steps)
    log.line("{:>12.1e}{:>22.12e}{:>14.1e}", s.step, s.difference, s.relative_error);
}

nlohmann::ordered_json result_entry(const Context& context, const DesignVariables& variables,
                                    const GradientReport& report) {
  nlohmann::ordered_json design = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    nlohmann::ordered_json entry{{"name", variables.name(i)}, {"derivative", report.derivatives[i]}};
    if (!report.errors.empty()) entry["error"] = report.errors[i];
    if (report.check && i < report.check->differences.size())
      entry["difference"] = report.check->differences[i];
    design.push_back(std::move(entry));
  }
  nlohmann::ordered_json result{{"objective", context.settings.gradient.objective},
                                {"value", report.value},
                                {"design", std::move(design)},
                                {"adjoint",
                                 {{"status", to_string(report.adjoints.status())},
                                  {"iterations", report.adjoints.iterations()},
                                  {"residual", report.adjoints.relative_residual()},
                                  {"factorizations", report.adjoints.factorizations}}}};
  if (report.check)
    result["check"] = {{"tangent", report.check->tangent},
                       {"finite_difference", report.check->finite_difference},
                       {"transpose", report.check->transpose},
                       {"difference_seconds", report.check->difference_seconds}};
  return result;
}

}  // namespace

void report_gradient(Context& context, const DesignVariables& variables, const ShapeVariables& shape,
                     const GradientReport& report) {
  print(context, variables, report);
  context.result.findings["gradient"] = result_entry(context, variables, report);
  on_root(context.comm, [&] {
    gradient_table(variables, report).write(context.output / "gradient.csv");
    wall_table(shape, report.wall).write(context.output / "wall.csv");
    if (context.settings.gradient.has("bumps")) bump_table(shape).write(context.output / "bumps.csv");
    if (!report.check) return;
    CsvTable steps({"step", "difference", "relative_error"});
    for (const DifferenceStep& s : report.check->steps)
      steps.add(std::vector<double>{s.step, s.difference, s.relative_error});
    steps.write(context.output / "step_study.csv");
  });
}

void write_node_sensitivities(Context& context, const MultiblockMesh<2>& mesh, const ShapeVariables& shape,
                              std::span<const Vec<double, 2>> sensitivities) {
  std::vector<double> packed;
  for (std::size_t i = 0; i < sensitivities.size(); ++i)
    packed.insert(packed.end(),
                  {static_cast<double>(shape.nodes().numbers[i]), sensitivities[i][0], sensitivities[i][1]});
  const std::vector<double> all = context.comm.gather(packed);
  on_root(context.comm, [&] {
    const auto positions = unique_positions(mesh, shape.numbers());
    std::vector<Vec<double, 2>> sums(positions.size());
    for (std::size_t i = 0; i < all.size(); i += 3)
      sums[static_cast<std::size_t>(all[i])] += Vec<double, 2>{{{all[i + 1], all[i + 2]}}};
    CsvTable table({"x", "y", "derivative_x", "derivative_y"});
    for (std::size_t i = 0; i < sums.size(); ++i)
      table.add(std::vector<double>{positions[i][0], positions[i][1], sums[i][0], sums[i][1]});
    table.write(context.output / "nodes.csv");
  });
}

}  // namespace wingbeat
