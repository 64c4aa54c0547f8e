#pragma once

#include <string>

#include "adjoint/hicks_henne.hpp"
#include "adjoint/mesh_deformation.hpp"
#include "core/io/settings.hpp"

namespace wingbeat {

// [design]: the shape variables, and how the mesh follows the wall.
struct DesignSettings {
  int bumps = 24;
  double bound = 0.01;  // largest amplitude, chords
  bool symmetric = false;
  double bump_width = 3.0;  // exponent t
  std::string deformation = "grid_lines";

  BumpOptions bump_options() const { return {bumps, bump_width, symmetric}; }
  DeformationMethod deformation_method() const;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
