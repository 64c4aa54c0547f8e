#pragma once

#include <Eigen/Dense>
#include <complex>
#include <vector>

#include "structure/time_marching.hpp"

namespace wingbeat::testing {

// The typical section with quasi-steady loads of He, Jonsson & Martins (Nonlinear Dynamics 2022): lift and
// moment follow the effective incidence alpha + h'/V. Its Hopf point is V = omega = 3/sqrt(13).
struct QuasiSteadySection {
  double cubic = 0.0;
  double mass_ratio = 10.0;

  static constexpr double gyration_radius_squared = 0.09;
  static Eigen::VectorXd force_direction() { return Eigen::VectorXd{{-1.0, 0.2}}; }

  StructureModel model() const {
    StructureModel model;
    model.modes = {"plunge", "pitch"};
    model.mass.resize(2, 2);
    model.mass << 1.0, 0.2, 0.2, gyration_radius_squared;
    model.damping = Eigen::MatrixXd::Zero(2, 2);
    model.stiffness = Eigen::Vector2d(0.25, gyration_radius_squared).asDiagonal();
    model.load_factor = 2.0 / mass_ratio;
    model.phase_mode = 1;
    if (cubic != 0.0) model.restoring = {polynomial_spring(1, gyration_radius_squared * cubic, 0.0)};
    return model;
  }

  // B of the linear section, y' = B y.
  Eigen::MatrixXd system(double velocity) const {
    const StructureModel section = model();
    Eigen::MatrixXd b = -first_order_matrix(section);
    const Eigen::VectorXd push = section.load(velocity) * section.mass.llt().solve(force_direction());
    b.col(1).tail(2) += push;
    b.col(2).tail(2) += push / velocity;
    return b;
  }

  // The exponent of y' = B y with the largest real part.
  std::complex<double> leading_exponent(double velocity) const {
    std::complex<double> found = -1e9;
    for (const std::complex<double>& p : Eigen::VectorXcd(system(velocity).eigenvalues()))
      if (p.imag() >= 0.0 && p.real() > found.real()) found = p;
    return found;
  }
};

// Its loads, found again at every visit. Counts the visits.
class QuasiSteadyLoads final : public UnsteadyLoads {
 public:
  explicit QuasiSteadyLoads(double velocity) : velocity_(velocity) {}
  void begin(double) override {}
  SolveStatus forces(std::span<const double> y, std::span<double> f) override {
    ++visits;
    const Eigen::VectorXd force = QuasiSteadySection::force_direction() * (y[1] + y[2] / velocity_);
    f[0] = force[0];
    f[1] = force[1];
    return SolveStatus::converged;
  }
  void accept() override {}
  int visits = 0;

 private:
  double velocity_;
};

}  // namespace wingbeat::testing
