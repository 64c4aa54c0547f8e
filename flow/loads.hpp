#pragma once

#include <span>
#include <vector>

#include "flow/flux_balance.hpp"
#include "flow/moved_face.hpp"

namespace wingbeat {

// Force and moment coefficients of the walls of one instance, on q_inf and the chord: force along
// x and y in inertial axes, moment nose up about the axis of rotation, which moves with the mesh.
template <class S>
struct Loads {
  S force_x{};
  S force_y{};
  S moment{};
};

// Adds what a wall face contributes: `push` is the pressure, less p_inf and over q_inf, with the sign of
// the face's outward direction.
template <int Dim, class S>
void add_wall_load(const RestingFace<Dim, S>& face, const RigidMotion<S>& motion, const S& push,
                   Loads<S>& loads) {
  const Vec<S, Dim> normal = motion.turned(face.normal);
  loads.force_x += push * normal[0];
  loads.force_y += push * normal[1];
  loads.moment -= push * face.moment;
}

// Gradients of the three coefficients with respect to the state of the instance, over the owned
// cells of this rank: [owned cell][variable].
struct LoadGradients {
  std::vector<double> force_x;
  std::vector<double> force_y;
  std::vector<double> moment;
};

// One wall face, as loads and surface output need it.
struct WallFace {
  std::size_t block = 0;
  BoundaryFace face;
  int first = 0;  // local numbers of the two cells the wall pressure is extrapolated from
  int second = 0;
};

// Integrates wall pressure (less p_inf) over the walls of a rank's blocks, with the same wall
// pressure as the wall flux (eq:loads).
template <int Dim>
class WallLoads {
 public:
  explicit WallLoads(const FlowDomain<Dim>& domain, const FlowModel<Dim, double>& model);

  // w, ghosts as in FluxBalance::evaluate. Summed over ranks: collective.
  template <class S>
  Loads<S> evaluate(std::span<const double> w, std::span<const double> ghosts,
                    const RigidMotion<S>& motion) const;
  // Collective.
  LoadGradients gradients(std::span<const double> w, std::span<const double> ghosts,
                          const RigidMotion<double>& motion) const;

  std::span<const WallFace> faces() const { return faces_; }
  double wall_pressure_at(const WallFace& face, std::span<const double> w,
                          std::span<const double> ghosts) const;

 private:
  State<Dim, double> cell_state(int number, std::span<const double> w, std::span<const double> ghosts) const;

  const FlowDomain<Dim>& domain_;
  FlowModel<Dim, double> model_;
  std::vector<WallFace> faces_;
};

}  // namespace wingbeat
