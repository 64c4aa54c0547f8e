#include "flow/loads.hpp"

#include <array>

#include "flow/boundary.hpp"

namespace wingbeat {

template <int Dim>
WallLoads<Dim>::WallLoads(const FlowDomain<Dim>& domain, const FlowModel<Dim, double>& model)
    : domain_(domain), model_(model) {
  for (std::size_t b = 0; b < domain.blocks().size(); ++b) {
    const FlowBlock<Dim>& block = domain.blocks()[b];
    for (const BoundaryFace& face : block.boundary)
      if (face.type == BoundaryType::slip_wall)
        faces_.push_back({b, face, block.number[static_cast<std::size_t>(face.first)],
                          block.number[static_cast<std::size_t>(face.second)]});
  }
}

template <int Dim>
State<Dim, double> WallLoads<Dim>::cell_state(int number, std::span<const double> w,
                                              std::span<const double> ghosts) const {
  constexpr int n = state_size<Dim>;
  const int owned = domain_.owned_count();
  const double* from = number < owned ? w.data() + static_cast<std::size_t>(number) * n
                                      : ghosts.data() + static_cast<std::size_t>(number - owned) * n;
  State<Dim, double> cell;
  for (int v = 0; v < n; ++v) cell[v] = from[v];
  return cell;
}

template <int Dim>
double WallLoads<Dim>::wall_pressure_at(const WallFace& face, std::span<const double> w,
                                        std::span<const double> ghosts) const {
  const double gamma = model_.freestream.gamma;
  return wall_pressure(pressure<Dim, double>(cell_state(face.first, w, ghosts), gamma),
                       pressure<Dim, double>(cell_state(face.second, w, ghosts), gamma));
}

template <int Dim>
template <class S>
Loads<S> WallLoads<Dim>::evaluate(std::span<const double> w, std::span<const double> ghosts,
                                  const RigidMotion<S>& motion) const {
  const double scale = 1.0 / model_.freestream.dynamic_pressure();
  Loads<S> loads;
  for (const WallFace& wall : faces_) {
    const auto& geometry = domain_.blocks()[wall.block].geometry;
    const double push = wall.face.outward * scale * (wall_pressure_at(wall, w, ghosts) - 1.0);
    add_wall_load<Dim, S>(resting_face<Dim, S>(geometry, wall.face.direction, wall.face.face), motion,
                          S(push), loads);
  }
  const Comm& comm = domain_.comm();
  if constexpr (std::is_same_v<S, double>) {
    std::array<double, 3> sums{loads.force_x, loads.force_y, loads.moment};
    comm.sum(sums);
    return {sums[0], sums[1], sums[2]};
  } else {
    for (S* load : {&loads.force_x, &loads.force_y, &loads.moment}) {
      load->value = comm.sum(load->value);
      comm.sum(std::span<double>(load->gradient.components));
    }
    return loads;
  }
}

template <int Dim>
LoadGradients WallLoads<Dim>::gradients(std::span<const double> w, std::span<const double> ghosts,
                                        const RigidMotion<double>& motion) const {
  constexpr int n = state_size<Dim>;
  using D = Dual<double, n>;
  const double scale = 1.0 / model_.freestream.dynamic_pressure();
  const std::size_t owned = domain_.state_count();
  const std::size_t ghost = static_cast<std::size_t>(domain_.ghost_count()) * n;
  std::array<std::vector<double>, 3> rows, ghost_rows;
  for (auto& row : rows) row.assign(owned, 0.0);
  for (auto& row : ghost_rows) row.assign(ghost, 0.0);

  for (const WallFace& wall : faces_) {
    const auto& geometry = domain_.blocks()[wall.block].geometry;
    const auto moved = moved_face<Dim, double>(geometry, motion, wall.face.direction, wall.face.face);
    const double moment = geometry.moment[wall.face.direction][static_cast<std::size_t>(wall.face.face)];
    const auto by_pressure = wall_pressure(Dual<double, 2>::seed(0.0, 0), Dual<double, 2>::seed(0.0, 1));
    const std::array<double, 3> arms{moved.normal[0], moved.normal[1], -moment};
    for (int which : {0, 1}) {
      const int number = which == 0 ? wall.first : wall.second;
      const auto cell = cell_state(number, w, ghosts);
      State<Dim, D> seeded;
      for (int v = 0; v < n; ++v) seeded[v] = D::seed(cell[v], v);
      const D p = pressure<Dim, D>(seeded, model_.freestream.gamma);
      const bool is_owned = number < domain_.owned_count();
      const auto at = static_cast<std::size_t>(is_owned ? number : number - domain_.owned_count()) * n;
      for (std::size_t k = 0; k < 3; ++k) {
        auto& row = is_owned ? rows[k] : ghost_rows[k];
        for (int v = 0; v < n; ++v)
          row[at + static_cast<std::size_t>(v)] +=
              wall.face.outward * scale * arms[k] * by_pressure.gradient[which] * p.gradient[v];
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    domain_.exchange().template scatter_add<double>(ghost_rows[k], rows[k], 1, n);
  return {std::move(rows[0]), std::move(rows[1]), std::move(rows[2])};
}

template class WallLoads<2>;
template class WallLoads<3>;
template Loads<double> WallLoads<2>::evaluate(std::span<const double>, std::span<const double>,
                                              const RigidMotion<double>&) const;
template Loads<double> WallLoads<3>::evaluate(std::span<const double>, std::span<const double>,
                                              const RigidMotion<double>&) const;
template Loads<Dual<double, 3>> WallLoads<2>::evaluate(std::span<const double>, std::span<const double>,
                                                       const RigidMotion<Dual<double, 3>>&) const;
template Loads<Dual<double, 3>> WallLoads<3>::evaluate(std::span<const double>, std::span<const double>,
                                                       const RigidMotion<Dual<double, 3>>&) const;

}  // namespace wingbeat
