#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "adjoint/section_wall.hpp"
#include "core/mesh/airfoil.hpp"
#include "core/mesh/conformal_omesh.hpp"
#include "core/mesh/mesh_file.hpp"

namespace wingbeat {

// A mesh around a section with its numbers and its wall.
struct SectionMesh {
  MultiblockMesh<2> mesh;
  NodeNumbers<2> numbers;
  SectionWall wall;

  explicit SectionMesh(MultiblockMesh<2> any)
      : mesh(std::move(any)), numbers(number_nodes(mesh)), wall(section_wall(mesh, numbers)) {}
  SectionMesh(const std::string& section, int around, int normal, int blocks = 1)
      : SectionMesh(
            conformal_omesh(make_airfoil(section), {.around = around, .normal = normal, .blocks = blocks})) {}

  std::vector<int> all_nodes() const {
    std::vector<int> nodes;
    for (int n = 0; n < numbers.count; ++n) nodes.push_back(n);
    return nodes;
  }
};

inline MultiblockMesh<2> mesh_of_file(const std::string& name) {
  return std::get<MultiblockMesh<2>>(read_mesh(std::string(WINGBEAT_TEST_DATA) + "/" + name));
}

// Numbers in [-1, 1], the same on all machines and ranks.
class Scatter {
 public:
  double operator()() {
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 8) / double(1U << 23) - 1.0;
  }
  std::vector<double> numbers(std::size_t count) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back((*this)());
    return values;
  }
  std::vector<Vec<double, 2>> vectors(std::size_t count) {
    std::vector<Vec<double, 2>> values;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = (*this)();
      values.push_back({{{x, (*this)()}}});
    }
    return values;
  }

 private:
  unsigned state_ = 1;
};

inline double inner(const std::vector<Vec<double, 2>>& a, const std::vector<Vec<double, 2>>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}
inline double inner(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace wingbeat
