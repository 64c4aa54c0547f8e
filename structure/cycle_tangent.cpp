#include "structure/cycle_tangent.hpp"

#include "structure/energy.hpp"

namespace wingbeat {

template <int Dim>
CycleTangent cycle_tangent(const Comm& comm, AeroelasticProblem<Dim>& problem, const StructureModel& model,
                           const SectionKinematics& kinematics, std::span<const double> u,
                           const GmresOptions& options) {
  problem.linearize(u);
  if (!problem.is_factored()) problem.refactor();
  std::vector<double> rhs(u.size(), 0.0), t(u.size(), 0.0);
  if (comm.is_root()) rhs.back() = 1.0;
  const GmresResult solve =
      gmres<double>(comm, problem.jacobian(), problem.preconditioner(), rhs, t, options);
  CycleTangent tangent;
  tangent.status = solve.status;
  tangent.linear_iterations = solve.iterations;

  // The physical state is linear in u.
  const AeroelasticState at = problem.state(u);
  for (std::size_t i = 0; i < t.size(); ++i) t[i] += u[i];
  const AeroelasticState moved = problem.state(t);
  std::vector<double> gradient(at.y.size(), 0.0);
  add_fluctuating_energy_gradient(model, at.y, 1.0, gradient);
  double energy = 0.0;
  for (std::size_t i = 0; i < gradient.size(); ++i) energy += gradient[i] * (moved.y[i] - at.y[i]);
  tangent.velocity_slope = kinematics.reduced_velocity(at.r) / (2.0 * at.r) * (moved.r - at.r) / energy;
  tangent.frequency_slope = (moved.omega - at.omega) / energy;
  return tangent;
}

template CycleTangent cycle_tangent<2>(const Comm&, AeroelasticProblem<2>&, const StructureModel&,
                                       const SectionKinematics&, std::span<const double>,
                                       const GmresOptions&);
template CycleTangent cycle_tangent<3>(const Comm&, AeroelasticProblem<3>&, const StructureModel&,
                                       const SectionKinematics&, std::span<const double>,
                                       const GmresOptions&);

}  // namespace wingbeat
