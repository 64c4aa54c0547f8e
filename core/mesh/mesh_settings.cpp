#include "core/mesh/mesh_settings.hpp"

#include "core/mesh/airfoil.hpp"

namespace wingbeat {

void MeshSettings::describe(SettingSection& keys) {
  keys.add("airfoil", &airfoil,
           {.help = "section of the built-in O-mesh: naca64a010, nacaDDDD, or a file of ordinates",
            .path = PathRule::file_or_name,
            .is_name = is_airfoil_name});
  keys.add(
      "file", &file,
      {.help = "mesh to read instead: CGNS (structured, ADF or HDF5) or Plot3D", .path = PathRule::file});
  keys.add("cells", &cells,
           {.help = "cells [around, normal] of the built-in mesh", .range = between(4, 16384)});
  keys.add("farfield_chords", &farfield_chords,
           {.help = "distance of the far field", .unit = "chords", .range = between(2, 10000)});
  keys.add(
      "stretching", &stretching,
      {.help = "ratio of successive steps in the logarithm of the radius; unset: square cells at the wall",
       .range = open_interval(0, 10)});
  keys.add("blocks", &blocks, {.help = "blocks to cut the mesh into", .range = between(1, 65536)});
  keys.add_rule(
      "cells", [this] { return cells[0] >= 16; }, "at least 16 cells around the section are needed");
  keys.add_rule(
      "airfoil", [this] { return !(airfoil && file); }, "set together with mesh.file; give one of the two");
  keys.add_rule(
      "airfoil", [this] { return airfoil || file; }, "give mesh.airfoil or mesh.file");
}

}  // namespace wingbeat
