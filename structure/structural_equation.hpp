#pragma once

#include <Eigen/Dense>
#include <span>

#include "core/spectral/time_spectral.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

// The structure over a period (eq:structure-time-spectral), row block n = instance n:
//   S = omega D y + A y + (0, M^-1 g(u)) - load (0, M^-1 f),   load = c V^2.
// y and S hold 2m values an instance, y[n*2m + j]: displacements j < m, then rates; f holds m.
// One instance (N_H = 0, D = 0) is static equilibrium. All functions are pure.
class StructuralEquation {
 public:
  // Throws InputError unless the model is consistent.
  StructuralEquation(StructureModel model, TimeSpectral time);

  const StructureModel& model() const { return model_; }
  const TimeSpectral& time() const { return time_; }
  int modes() const { return model_.size(); }
  std::size_t state_size() const { return 2 * force_size(); }
  std::size_t force_size() const { return static_cast<std::size_t>(time_.instances() * modes()); }

  void residual(std::span<const double> y, double omega, double load, std::span<const double> f,
                std::span<double> s) const;

  // dS/dy at constant f, dense, 2mN x 2mN.
  Eigen::MatrixXd state_jacobian(std::span<const double> y, double omega) const;
  // ds += scale (dS/dy) dy and its transpose, without the matrix.
  void add_state_tangent(std::span<const double> y, double omega, std::span<const double> dy, double scale,
                         std::span<double> ds) const;
  void add_state_adjoint(std::span<const double> y, double omega, std::span<const double> lambda,
                         double scale, std::span<double> dy) const;
  // dS/domega = D y and dS/dload = -(0, M^-1 f), overwritten.
  void frequency_derivative(std::span<const double> y, std::span<double> ds) const;
  void load_derivative(std::span<const double> f, std::span<double> ds) const;
  // ds += scale (dS/df) df, dS/df = -load (0, M^-1) in every instance; and its transpose.
  void add_force_tangent(double load, std::span<const double> df, double scale, std::span<double> ds) const;
  void add_force_adjoint(double load, std::span<const double> lambda, double scale,
                         std::span<double> df) const;

 private:
  Eigen::MatrixXd instance_matrix(std::span<const double> y, int instance) const;

  StructureModel model_;
  TimeSpectral time_;
  Eigen::MatrixXd linear_;        // A
  Eigen::MatrixXd inverse_mass_;  // M^-1
};

}  // namespace wingbeat
