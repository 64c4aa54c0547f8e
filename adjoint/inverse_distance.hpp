#pragma once

#include <span>
#include <vector>

#include "adjoint/boundary_nodes.hpp"

namespace wingbeat {

// Displacement of a node: the mean of those of the boundary's nodes, weighted by their areas and inverse
// powers of their distance (eq:inverse-distance). E. Luke, E. Collins, E. Blades, J. Comput. Phys. 231
// (2012), doi 10.1016/j.jcp.2011.09.021, without its rotations. Weights are computed when they are needed: a
// product takes (nodes) x (boundary nodes) of them.
template <int Dim>
class InverseDistance {
 public:
  // `positions`: of all nodes, [number]; `length`: L of the weights, up to which the higher power prevails.
  InverseDistance(std::vector<Vec<double, Dim>> positions, BoundaryNodes<Dim> boundary, double length);

  // Displacement of `nodes`, from that of the boundary's moving nodes.
  std::vector<Vec<double, Dim>> displacement(std::span<const Vec<double, Dim>> moving,
                                             std::span<const int> nodes) const;
  // Adds to `moving` the transpose applied to sensitivities of `nodes`.
  void add_transpose(std::span<const Vec<double, Dim>> sensitivities, std::span<const int> nodes,
                     std::span<Vec<double, Dim>> moving) const;

 private:
  std::vector<std::size_t> free_entries(std::span<const int> nodes) const;
  template <class T>
  T weight(const Vec<T, Dim>& x, std::size_t k) const;

  std::vector<Vec<double, Dim>> positions_;
  BoundaryNodes<Dim> boundary_;
  std::vector<int> boundary_entry_;  // [number]: which node of the boundary it is, or -1
  double length_squared_;
};

}  // namespace wingbeat
