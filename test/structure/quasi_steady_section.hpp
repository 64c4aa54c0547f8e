#pragma once

#include <Eigen/Dense>
#include <complex>
#include <vector>

#include "structure/time_marching.hpp"
#include "test/structure/quasi_steady_model.hpp"

namespace wingbeat::testing {

// The quasi-steady section as it is marched in time.
struct QuasiSteadySection {
  double cubic = 0.0;
  double mass_ratio = quasi_steady::mass_ratio;

  StructureModel model() const { return quasi_steady::section({cubic, 0.0}, mass_ratio); }

  // B of the linear section, y' = B y.
  Eigen::MatrixXd system(double velocity) const {
    const StructureModel section = model();
    Eigen::MatrixXd b = -first_order_matrix(section);
    const Eigen::VectorXd push =
        section.load(velocity) * section.mass.llt().solve(quasi_steady::force_direction);
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
    for (std::size_t j = 0; j < 2; ++j)
      f[j] = quasi_steady::force_direction[static_cast<Eigen::Index>(j)] * (y[1] + y[2] / velocity_);
    return SolveStatus::converged;
  }
  void accept() override {}
  int visits = 0;

 private:
  double velocity_;
};

}  // namespace wingbeat::testing
