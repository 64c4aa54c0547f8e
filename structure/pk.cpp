#include "structure/pk.hpp"

#include "core/io/error.hpp"
#include "structure/mode_following.hpp"

namespace wingbeat {

std::string_view to_string(PkStatus status) {
  switch (status) {
    case PkStatus::converged:
      return "converged";
    case PkStatus::outside_table:
      return "outside-table";
    case PkStatus::iteration_limit:
      return "iteration-limit";
  }
  ensure(false, "unknown p-k status");
  return {};
}

PkResult pk(const StructureModel& model, const AerodynamicMatrix& q, double k_min, double k_max,
            std::span<const double> reduced_velocities, const PkOptions& options) {
  check(model);
  const Eigen::MatrixXd inverse_mass =
      model.mass.llt().solve(Eigen::MatrixXd::Identity(model.size(), model.size()));
  const SpectrumAt spectrum = [&](double velocity, double k) {
    return motion_spectrum(inverse_mass, model.damping.cast<std::complex<double>>(),
                           model.stiffness - model.load(velocity) * held(q, k, k_min, k_max));
  };
  return follow_modes(model, spectrum, k_min, k_max, reduced_velocities, options);
}

PkResult pk(const StructureModel& model, const AerodynamicTable& table,
            std::span<const double> reduced_velocities, const PkOptions& options) {
  return pk(
      model, [&table](double k) { return table(k); }, table.k_min(), table.k_max(), reduced_velocities,
      options);
}

}  // namespace wingbeat
