#pragma once

#include "adjoint/parameters.hpp"
#include "structure/structural_equation.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat {

// Change of a structure: of M, C, K, of the load factor c, and of g(u).
struct ModelChange {
  Eigen::MatrixXd mass, damping, stiffness;
  double load_factor = 0.0;
  std::vector<RestoringForce> restoring;
};

// d structure_model / d parameter, `index` counting from first_section_scalar; damping ratios and springs
// are kept. Vacuum frequencies must differ where there is damping.
ModelChange section_derivative(const TypicalSection& section, std::size_t index);

// dS at given states and forces (eq:structure-inputs); arguments as in StructuralEquation::residual.
std::vector<double> structure_tangent(const StructuralEquation& structure, std::span<const double> y,
                                      double reduced_velocity, std::span<const double> f,
                                      const ModelChange& change);

// d E_fl at given states.
double fluctuating_energy_change(const ModelChange& change, std::span<const double> y);

}  // namespace wingbeat
