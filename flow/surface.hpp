#pragma once

#include <vector>

#include "flow/flow_level.hpp"
#include "flow/motion.hpp"

namespace wingbeat {

// Where a rigid section is: pitch in radians, plunge h in chords, positive down.
struct SectionPosition {
  double pitch = 0.0;
  double plunge = 0.0;
};

// A point of the mesh at rest, carried to the section's position (eq:rigid-motion).
template <int Dim>
Vec<double, Dim> carried(const Vec<double, Dim>& at_rest, const Vec<double, 2>& axis,
                         const SectionPosition& position);

// One wall face of one instance.
struct SurfacePoint {
  long cell = 0;  // number of its cell in the whole mesh
  int zone = 0;
  Vec<double, 2> body;   // face centre on the mesh at rest, chords
  Vec<double, 2> place;  // where it is now
  double cp = 0.0;
  double mach = 0.0;  // in the first cell
};

// All wall faces of one instance on rank 0, by cell number; empty elsewhere. Collective.
template <int Dim>
std::vector<SurfacePoint> surface_points(const FlowLevel<Dim>& level, const FlowModel<Dim, double>& model,
                                         std::span<const double> w, const SectionPosition& position);

}  // namespace wingbeat
