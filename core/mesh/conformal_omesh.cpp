#include "core/mesh/conformal_omesh.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "core/io/error.hpp"
#include "core/mesh/conformal_map.hpp"
#include "core/mesh/cut_blocks.hpp"

namespace wingbeat {

namespace {

using Point = Vec<double, 2>;

void check(const OmeshOptions& options) {
  const auto refuse = [](const std::string& what, const std::string& value, const std::string& allowed) {
    throw InputError("O-mesh: " + what + " is " + value + "; it must be " + allowed);
  };
  if (options.around < 16) refuse("number of cells around", std::to_string(options.around), "at least 16");
  if (options.normal < 4)
    refuse("number of cells normal to the wall", std::to_string(options.normal), "at least 4");
  if (!(options.farfield_chords > 1.0) || !std::isfinite(options.farfield_chords))
    refuse("far-field radius", fmt::format("{:g}", options.farfield_chords), "more than 1 chord");
  if (options.stretching && !(*options.stretching > 0.0 && std::isfinite(*options.stretching)))
    refuse("stretching", fmt::format("{:g}", *options.stretching), "positive");
  if (options.blocks < 1) refuse("number of blocks", std::to_string(options.blocks), "at least 1");
}

// 1 + q + ... + q^(n-1)
double geometric_sum(double ratio, int n) {
  double sum = 0.0;
  for (int j = 0; j < n; ++j) sum = 1.0 + ratio * sum;
  return sum;
}

// The ratio > 1 whose geometric sum of n terms takes a value above n, by bisection.
double ratio_of_sum(double value, int n) {
  double low = 1.0, high = 2.0;
  while (geometric_sum(high, n) < value) high *= 2.0;
  for (double middle = 1.5; middle > low && middle < high; middle = 0.5 * (low + high))
    (geometric_sum(middle, n) < value ? low : high) = middle;
  return 0.5 * (low + high);
}

BlockArray<Point, 2> omesh_nodes(const Airfoil& airfoil, const OmeshOptions& options) {
  const ConformalMap map(airfoil, options.around);
  const double log_farfield = std::log(options.farfield_chords / map.conformal_radius());
  const std::vector<double> log_radii = logarithmic_radii(log_farfield, options);

  BlockArray<Point, 2> nodes({options.around + 1, options.normal + 1}, 0);
  // The series ends somewhere: the wall itself is taken from the section.
  for (int i = 0; i < options.around; ++i) nodes({i, 0}) = airfoil.at(map.wall_parameters()[i]).position;
  std::vector<std::complex<double>> ring(static_cast<std::size_t>(options.around));
  for (int j = 1; j <= options.normal; ++j) {
    map.ring(std::exp(log_radii[j]), ring);
    for (int i = 0; i < options.around; ++i) nodes({i, j}) = {{ring[i].real(), ring[i].imag()}};
  }
  for (int j = 0; j <= options.normal; ++j) nodes({options.around, j}) = nodes({0, j});
  return nodes;
}

Interface<2> cut_of_the_o(const OmeshOptions& options, int end) {
  Interface<2> cut;
  const int here = end == 0 ? 0 : options.around;
  cut.name = end == 0 ? "cut-lower" : "cut-upper";
  cut.side = {0, end};
  cut.nodes = {{here, 0}, {here + 1, options.normal + 1}};
  cut.donor = 0;
  cut.donor_side = {0, 1 - end};
  cut.donor_origin = {options.around - here, 0};
  cut.axis = {0, 1};
  cut.sign = {1, 1};
  return cut;
}

}  // namespace

std::vector<double> logarithmic_radii(double log_farfield, const OmeshOptions& options) {
  const int n = options.normal;
  const double square = 2.0 * std::numbers::pi / options.around;
  const bool overshoots = square * n >= log_farfield;
  const double ratio = options.stretching ? *options.stretching
                       : overshoots       ? 1.0
                                          : ratio_of_sum(log_farfield / square, n);
  const double first = log_farfield / geometric_sum(ratio, n);
  std::vector<double> radii;
  for (int j = 0; j < n; ++j) radii.push_back(first * geometric_sum(ratio, j));
  radii.push_back(log_farfield);
  return radii;
}

MultiblockMesh<2> conformal_omesh(const Airfoil& airfoil, const OmeshOptions& options) {
  check(options);
  Zone<2> zone;
  zone.name = "block";
  zone.cells = {options.around, options.normal};
  zone.nodes = omesh_nodes(airfoil, options);
  zone.patches = {{"wall", "wall", BoundaryType::slip_wall, {1, 0}, {{0, 0}, {options.around, 1}}},
                  {"farfield",
                   "farfield",
                   BoundaryType::farfield,
                   {1, 1},
                   {{0, options.normal - 1}, {options.around, options.normal}}}};
  zone.interfaces = {cut_of_the_o(options, 0), cut_of_the_o(options, 1)};

  MultiblockMesh<2> mesh = cut_blocks(MultiblockMesh<2>{{zone}}, options.blocks);
  if (options.blocks == 1) mesh.zones.front().name = "block-1";
  return mesh;
}

}  // namespace wingbeat
