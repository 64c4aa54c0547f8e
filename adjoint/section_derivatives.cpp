#include "adjoint/section_derivatives.hpp"

#include <numbers>

#include "core/io/error.hpp"
#include "structure/energy.hpp"

namespace wingbeat {
namespace {

// Of C = sum_j M phi_j 2 zeta_j omega_j (M phi_j)^T, by the derivatives of the vacuum modes.
Eigen::MatrixXd damping_change(const StructureModel& model, const Eigen::VectorXd& ratios,
                               const ModelChange& change) {
  const int m = model.size();
  if (ratios.isZero()) return Eigen::MatrixXd::Zero(m, m);
  const VacuumModes modes = vacuum_modes(model);
  const Eigen::MatrixXd& phi = modes.shapes;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(m, m);
  for (int j = 0; j < m; ++j) {
    const double omega = modes.frequencies[j], lambda = omega * omega;
    const Eigen::VectorXd pushed = change.stiffness * phi.col(j) - lambda * (change.mass * phi.col(j));
    Eigen::VectorXd shape_change = -0.5 * phi.col(j).dot(change.mass * phi.col(j)) * phi.col(j);
    for (int i = 0; i < m; ++i) {
      if (i == j) continue;
      const double other = modes.frequencies[i] * modes.frequencies[i];
      ensure(std::abs(lambda - other) > 1e-8 * (lambda + other),
             "derivative of modal damping: two vacuum frequencies are equal");
      shape_change += phi.col(i) * (phi.col(i).dot(pushed) / (lambda - other));
    }
    const double omega_change = phi.col(j).dot(pushed) / (2.0 * omega);
    const Eigen::VectorXd x = model.mass * phi.col(j);
    const Eigen::VectorXd dx = change.mass * phi.col(j) + model.mass * shape_change;
    result += 2.0 * ratios[j] *
              (omega_change * x * x.transpose() + omega * (dx * x.transpose() + x * dx.transpose()));
  }
  return result;
}

// The dead zone takes away a part of the linear spring: it follows its stiffness.
void add_freeplay_change(const TypicalSection& section, const SectionSpring& spring, int mode,
                         ModelChange& change) {
  const double stiffer = change.stiffness(mode, mode);
  if (spring.freeplay > 0.0 && stiffer != 0.0)
    change.restoring.push_back(freeplay_spring(mode, stiffer, spring.freeplay, section.freeplay_smoothing));
}

}  // namespace

ModelChange section_derivative(const TypicalSection& section, std::size_t index) {
  ModelChange change;
  change.mass = change.stiffness = Eigen::Matrix2d::Zero();
  switch (static_cast<Scalar>(first_section_scalar + index)) {
    case Scalar::static_unbalance:
      change.mass(plunge_mode, pitch_mode) = change.mass(pitch_mode, plunge_mode) = 1.0;
      break;
    case Scalar::gyration_radius_squared:
      change.mass(pitch_mode, pitch_mode) = 1.0;
      change.stiffness(pitch_mode, pitch_mode) = 1.0;
      break;
    case Scalar::frequency_ratio:
      change.stiffness(plunge_mode, plunge_mode) = 2.0 * section.frequency_ratio;
      break;
    case Scalar::mass_ratio:
      change.load_factor = -4.0 / (std::numbers::pi * section.mass_ratio * section.mass_ratio);
      break;
    default:
      ensure(false, "section_derivative: not a parameter of the section");
  }
  const Eigen::Vector2d ratios(section.damping[0], section.damping[1]);
  change.damping = damping_change(structure_model(section), ratios, change);
  add_freeplay_change(section, section.plunge_spring, plunge_mode, change);
  add_freeplay_change(section, section.pitch_spring, pitch_mode, change);
  return change;
}

std::vector<double> structure_tangent(const StructuralEquation& structure, std::span<const double> y,
                                      double reduced_velocity, std::span<const double> f,
                                      const ModelChange& change) {
  const StructureModel& model = structure.model();
  const int m = model.size(), n = structure.time().instances();
  const double speed = reduced_velocity * reduced_velocity;
  const Eigen::Map<const Eigen::MatrixXd> states(y.data(), 2 * m, n), forces(f.data(), m, n);
  const Eigen::LLT<Eigen::MatrixXd> mass(model.mass);
  std::vector<double> ds(y.size(), 0.0);
  Eigen::Map<Eigen::MatrixXd> rows(ds.data(), 2 * m, n);
  for (int i = 0; i < n; ++i) {
    const Eigen::VectorXd u = states.col(i).head(m), rate = states.col(i).tail(m);
    Eigen::VectorXd force =
        model.damping * rate + model.stiffness * u - model.load_factor * speed * forces.col(i);
    for (const RestoringForce& spring : model.restoring) force[spring.mode] += spring.value(u[spring.mode]);
    Eigen::VectorXd by = change.damping * rate + change.stiffness * u -
                         change.load_factor * speed * forces.col(i) - change.mass * mass.solve(force);
    for (const RestoringForce& spring : change.restoring) by[spring.mode] += spring.value(u[spring.mode]);
    rows.col(i).tail(m) = mass.solve(by);
  }
  return ds;
}

double fluctuating_energy_change(const ModelChange& change, std::span<const double> y) {
  // The energy is linear in M and K.
  StructureModel of_change;
  of_change.modes.resize(static_cast<std::size_t>(change.mass.rows()));
  of_change.mass = change.mass;
  of_change.stiffness = change.stiffness;
  return fluctuating_energy(of_change, y);
}

}  // namespace wingbeat
