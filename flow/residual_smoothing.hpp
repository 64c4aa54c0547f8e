#pragma once

#include <array>
#include <span>
#include <vector>

#include "flow/flow_domain.hpp"
#include "flow/line_smoother.hpp"
#include "flow/mesh_lines.hpp"

namespace wingbeat {

// Coefficients of a cell in each direction from its spectral radii (eq:smoothing-coefficient):
//   eps_d = max(0, ((ratio Lambda_d / sum lambda)^2 - 1) / 4),
// with the radii Lambda_d scaled for cells of high aspect ratio (eq:jst-radius). In a cell of equal
// radii that is (ratio^2 - 1) / 4 in every direction; in a long one the direction of the large
// radius is smoothed that much and the others less or not at all.
template <int Dim>
Vec<double, Dim> smoothing_coefficients(const Vec<double, Dim>& lambda, double ratio);

// Implicit smoothing of residuals along the lines of the mesh (eq:residual-smoothing), one
// direction after the other, so that a Runge-Kutta scheme may take steps larger by about `ratio`.
// Lines go on across blocks and ranks, up to the part of a spike that crosses a whole block
// (eq:smoothing-spike), and end with zero gradient at physical boundaries and where a neighbour
// calls the direction by another index. Constants are preserved in every case.
template <int Dim>
class ResidualSmoothing {
 public:
  // Collective. The domain must outlive this object.
  explicit ResidualSmoothing(const FlowDomain<Dim>& domain);

  // lambda: [instance][owned cell][Dim], spectral radii (eq:spectral-radius); all instances are
  // smoothed alike, by the means of their radii. ratio: Courant number over that of the scheme
  // without smoothing; at 1 nothing is smoothed. Collective.
  void set_coefficients(std::span<const double> lambda, int instances, double ratio);
  // The same with a ratio of its own in each owned cell.
  void set_coefficients(std::span<const double> lambda, int instances, std::span<const double> ratios);

  // r: [instance][owned cell][variable], smoothed in place. Collective.
  void apply(std::span<double> r, int instances) const;

 private:
  static constexpr int n = state_size<Dim>;

  void set_weights(int direction);
  void smooth(int direction, std::span<double> r, int instances) const;

  const FlowDomain<Dim>& domain_;
  std::array<LineEnds, Dim> ends_;
  std::array<std::vector<LineSmoother>, Dim> lines_;  // [direction][block]
  std::array<std::vector<double>, Dim> weights_;      // [direction][end of a line]: jump over difference
  mutable std::vector<double> at_ends_;               // [instance][end of a line][variable]
  mutable std::vector<double> opposite_;
};

}  // namespace wingbeat
