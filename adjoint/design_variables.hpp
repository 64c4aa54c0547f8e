#pragma once

#include <string>
#include <vector>

#include "adjoint/parameters.hpp"
#include "adjoint/shape_variables.hpp"

namespace wingbeat {

// A list of variables that a gradient is taken with respect to: amplitudes of bumps and single numbers.
class DesignVariables {
 public:
  // `parameters`: of those that gradient.parameters allows, taken in its order. `shape` is kept by reference;
  // `bound`: the scale of a bump, chords.
  DesignVariables(const std::vector<std::string>& parameters, const ShapeVariables& shape, double bound);

  std::size_t size() const { return names_.size(); }
  std::size_t bump_count() const { return bump_count_; }  // they come first
  const std::string& name(std::size_t i) const { return names_[i]; }
  // What counts as a change of one variable that is neither small nor large.
  double scale(std::size_t i) const { return scales_[i]; }

  // The change of all parameters that changes of the variables make.
  Parameters<2> change(std::span<const double> variables) const;
  // The transpose: derivatives with respect to the variables. `wall`: ShapeVariables::wall_sensitivity of the
  // same sensitivities.
  std::vector<double> derivatives(std::span<const Vec<double, 2>> wall,
                                  const Parameters<2>& sensitivity) const;

 private:
  const ShapeVariables& shape_;
  std::size_t bump_count_ = 0;
  std::vector<Scalar> scalars_;  // after the bumps
  std::vector<std::string> names_;
  std::vector<double> scales_;
};

}  // namespace wingbeat
