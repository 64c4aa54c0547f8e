#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/io/settings.hpp"

namespace wingbeat {

// [mesh]: a section and the built-in O-mesh around it, or a mesh file.
struct MeshSettings {
  std::optional<std::string> airfoil;  // a name, or the path of a file of ordinates
  std::optional<std::string> file;     // CGNS or Plot3D
  std::array<int, 2> cells{250, 50};   // around the section, normal to it
  double farfield_chords = 60.0;
  std::optional<double> stretching;  // of steps in log(radius); square cells at the wall when empty
  int blocks = 1;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
