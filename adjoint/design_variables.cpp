#include "adjoint/design_variables.hpp"

#include <algorithm>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// A hundredth to a tenth of what the parameter may be.
double scale_of(Scalar scalar) {
  switch (scalar) {
    case Scalar::mach:
      return 0.01;
    case Scalar::angle_of_attack:
      return 0.2;
    case Scalar::mass_ratio:
      return 10.0;
    default:
      return 0.1;
  }
}

}  // namespace

DesignVariables::DesignVariables(const std::vector<std::string>& parameters, const ShapeVariables& shape,
                                 double bound)
    : shape_(shape) {
  const auto has = [&](const char* name) { return std::ranges::find(parameters, name) != parameters.end(); };
  if (has("bumps")) {
    bump_count_ = static_cast<std::size_t>(shape.bumps().variables());
    for (std::size_t i = 0; i < bump_count_; ++i) {
      names_.push_back("bump " + std::to_string(i + 1));
      scales_.push_back(bound);
    }
  }
  if (has("mach")) scalars_.push_back(Scalar::mach);
  if (has("angle_of_attack")) scalars_.push_back(Scalar::angle_of_attack);
  if (has("structure"))
    scalars_.insert(scalars_.end(),
                    {Scalar::elastic_axis, Scalar::static_unbalance, Scalar::gyration_radius_squared,
                     Scalar::frequency_ratio, Scalar::mass_ratio});
  for (const Scalar scalar : scalars_) {
    names_.push_back(scalar_names[static_cast<std::size_t>(scalar)]);
    scales_.push_back(scale_of(scalar));
  }
}

Parameters<2> DesignVariables::change(std::span<const double> variables) const {
  ensure(variables.size() == size(), "design variables of a wrong number");
  Parameters<2> change;
  if (bump_count_ > 0)
    change.nodes = shape_.node_change(variables.first(bump_count_));
  else
    change.nodes.resize(shape_.nodes().numbers.size());
  for (std::size_t k = 0; k < scalars_.size(); ++k) change[scalars_[k]] = variables[bump_count_ + k];
  return change;
}

std::vector<double> DesignVariables::derivatives(std::span<const Vec<double, 2>> wall,
                                                 const Parameters<2>& sensitivity) const {
  std::vector<double> result;
  if (bump_count_ > 0) result = shape_.amplitude_gradient(wall);
  for (const Scalar scalar : scalars_) result.push_back(sensitivity[scalar]);
  return result;
}

}  // namespace wingbeat
