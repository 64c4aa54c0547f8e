#pragma once

#include <string>
#include <vector>

#include "core/io/settings.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

// [modal]: a structure of any number m of modes by its matrices, m x m, row by row.
struct ModalSettings {
  std::vector<std::string> modes;
  std::vector<double> mass, damping, stiffness;
  double load_factor = 0.0;

  bool is_given() const { return !modes.empty(); }
  void describe(SettingSection& keys);
};

// M, C, K and c of (eq:structure); without damping C = 0. Throws InputError where they make no structure.
StructureModel structure_model(const ModalSettings& settings);

}  // namespace wingbeat
