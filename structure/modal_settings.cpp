#include "structure/modal_settings.hpp"

namespace wingbeat {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

void ModalSettings::describe(SettingSection& keys) {
  keys.add("modes", &modes, {.help = "names of the m modes", .required = true});
  keys.add("mass", &mass, {.help = "generalised masses M, m x m, row by row", .required = true});
  keys.add("damping", &damping, {.help = "generalised damping C, m x m, row by row; empty: none"});
  keys.add("stiffness", &stiffness,
           {.help = "generalised stiffnesses K, m x m, row by row, time in 1/omega of the reference",
            .required = true});
  keys.add(
      "load_factor", &load_factor,
      {.help = "c in M u'' + C u' + K u = c V^2 Q u, V = U/(2 b omega) of the reference; 4/(pi mu) for a "
               "typical section",
       .range = at_least(0),
       .required = true});
  const auto is_square = [this](const std::vector<double>& entries) {
    return entries.size() == modes.size() * modes.size();
  };
  keys.add_rule(
      "modes", [this] { return !modes.empty(); }, "name at least one mode");
  keys.add_rule(
      "mass", [=, this] { return is_square(mass); }, "must have m x m entries for m names in modal.modes");
  keys.add_rule(
      "damping", [=, this] { return damping.empty() || is_square(damping); },
      "must have m x m entries for m names in modal.modes, or none");
  keys.add_rule(
      "stiffness", [=, this] { return is_square(stiffness); },
      "must have m x m entries for m names in modal.modes");
}

StructureModel structure_model(const ModalSettings& settings) {
  const auto m = static_cast<Eigen::Index>(settings.modes.size());
  const auto matrix = [m](const std::vector<double>& entries) -> Eigen::MatrixXd {
    return Eigen::Map<const RowMajor>(entries.data(), m, m);
  };
  StructureModel model;
  model.modes = settings.modes;
  model.mass = matrix(settings.mass);
  model.damping = settings.damping.empty() ? Eigen::MatrixXd::Zero(m, m) : matrix(settings.damping);
  model.stiffness = matrix(settings.stiffness);
  model.load_factor = settings.load_factor;
  check(model);
  return model;
}

}  // namespace wingbeat
