#pragma once

#include <optional>
#include <string>

#include "apps/context.hpp"
#include "structure/pk.hpp"

namespace wingbeat {

// Writes the modes against speed to a file of the output folder. Collective.
void write_modes(const Context& context, const PkResult& result, const StructureModel& model,
                 const std::string& file);

// Prints where modes begin and cease to grow, and enters it in result.json under this key.
void report_crossings(Context& context, const PkResult& result, const StructureModel& model,
                      const std::string& method, const std::string& key);

// Prints the lowest speed of static divergence with the Q(0) given and enters it in result.json.
void report_divergence(Context& context, const StructureModel& model, const Eigen::MatrixXd& steady_matrix);

}  // namespace wingbeat
