#include "adjoint/design_settings.hpp"

namespace wingbeat {

DeformationMethod DesignSettings::deformation_method() const {
  return deformation == "grid_lines" ? DeformationMethod::grid_lines : DeformationMethod::inverse_distance;
}

void DesignSettings::describe(SettingSection& keys) {
  keys.add(
      "bumps", &bumps,
      {.help = "Hicks-Henne bumps, spread evenly along the arc from the lower to the upper trailing edge",
       .range = between(1, 100000)});
  keys.add("bound", &bound,
           {.help = "largest amplitude of a bump, inward and outward", .unit = "chords", .range = above(0)});
  keys.add("symmetric", &symmetric,
           {.help = "one variable drives a bump and its mirror image on the other surface"});
  keys.add("bump_width", &bump_width,
           {.help = "exponent t of the bumps: the larger, the narrower", .range = between(1, 100)});
  keys.add(
      "deformation", &deformation,
      {.help = "how nodes follow the wall: each by the wall node where its grid line starts (O-meshes), or "
               "all by a mean of the boundary's displacements (any mesh)",
       .allowed = {"grid_lines", "inverse_distance"}});
}

}  // namespace wingbeat
