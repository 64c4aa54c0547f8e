#pragma once

#include <optional>
#include <vector>

#include "adjoint/design_variables.hpp"
#include "adjoint/gradient_check.hpp"
#include "apps/context.hpp"

namespace wingbeat {

// A gradient and what is known of it.
struct GradientReport {
  double value = 0.0;
  std::vector<double> derivatives;   // [variable]
  std::vector<double> errors;        // of derivatives that are differences of cycles; else empty
  std::vector<Vec<double, 2>> wall;  // [wall node], the mesh following the wall
  AdjointSolutions adjoints;
  std::optional<GradientCheck> check;
};

// Prints the gradient, puts it into result.json and writes gradient.csv, wall.csv, bumps.csv and
// step_study.csv. Rank 0 writes.
void report_gradient(Context& context, const DesignVariables& variables, const ShapeVariables& shape,
                     const GradientReport& report);

// Writes nodes.csv: the derivative with respect to every node of the mesh. `sensitivities`: [local node],
// parts that add up over the ranks. Collective.
void write_node_sensitivities(Context& context, const MultiblockMesh<2>& mesh, const ShapeVariables& shape,
                              std::span<const Vec<double, 2>> sensitivities);

}  // namespace wingbeat
