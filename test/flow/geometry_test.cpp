#include <gtest/gtest.h>

#include "core/mesh/metrics.hpp"
#include "flow/moved_face.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;

// One motion with all three components: turned by 0.3, pitching and plunging.
const RigidMotion<double> moving = rigid_motion({0.3, 0.7, -0.4});

// Largest |sum over the faces of a cell| of area vectors and of sweeps, relative to the largest
// single face of that cell.
struct Defects {
  double closure = 0.0;
  double sweep = 0.0;
};

template <int Dim>
Defects largest_defects(const FlowCase<Dim>& c, const RigidMotion<double>& motion) {
  Defects result;
  for (const auto& block : c.domain.blocks())
    for_each(box_of<Dim>(block.geometry.layout.extents), [&](const Index<Dim>& cell) {
      const auto o = block.geometry.layout.offset(cell);
      Vec<double, Dim> closure{};
      double sweep = 0.0, area = 0.0, swept = 0.0;
      for (int d = 0; d < Dim; ++d) {
        const auto low = moved_face<Dim, double>(block.geometry, motion, d, o);
        const auto high =
            moved_face<Dim, double>(block.geometry, motion, d, o + block.geometry.layout.strides[d]);
        closure += high.normal - low.normal;
        sweep += high.sweep - low.sweep;
        area = std::max(area, std::sqrt(dot(high.normal, high.normal)));
        swept = std::max(swept, std::abs(high.sweep));
      }
      result.closure = std::max(result.closure, std::sqrt(dot(closure, closure)) / area);
      result.sweep = std::max(result.sweep, std::abs(sweep) / std::max(swept, 1e-300));
    });
  return result;
}

template <int Dim>
void expect_closed_cells(MultiblockMesh<Dim> mesh, double tolerance) {
  const FlowCase<Dim> c(std::move(mesh), 0.5, 0.0);
  for (const auto& motion : {moving, rigid_motion({})}) {
    const Defects defects = largest_defects(c, motion);
    EXPECT_LE(defects.closure, tolerance);
    EXPECT_LE(defects.sweep, tolerance);
  }
}

TEST(BlockGeometry, CellsAreClosedAndSweepNoVolumeInRigidMotion) {
  // Coordinates of size x on faces of size s round off at eps x/s.
  expect_closed_cells<2>(bent_box<2>({12, 9}), 1e-13);
  expect_closed_cells<2>(section_mesh("naca2412", 64, 16, 3), 1e-12);
  expect_closed_cells<3>(bent_box<3>({9, 7, 6}), 1e-13);
  expect_closed_cells<3>(cut_blocks<3>(bent_box<3>({8, 8, 6}, 0.06), 4), 1e-13);
}

// Why the moment of a bilinear face is integrated: at the mean of its nodes the sweeps of a warped
// cell do not add up to zero.
TEST(BlockGeometry, NodeMeansLeaveADefectThatExactMomentsDoNot) {
  const auto mesh = bent_box<3>({9, 7, 6}, 0.06);
  const auto& nodes = mesh.zones[0].nodes;
  double largest = 0.0, exact = 0.0, size = 0.0;
  for_each(box_of<3>(mesh.zones[0].cells), [&](const Index<3>& cell) {
    double by_means = 0.0, by_integral = 0.0;
    for (int d = 0; d < 3; ++d)
      for (int end : {0, 1}) {
        Index<3> f = cell;
        f[static_cast<std::size_t>(d)] += end;
        Index<3> f10 = f, f01 = f, f11 = f;
        const auto s = static_cast<std::size_t>((d + 1) % 3), t = static_cast<std::size_t>((d + 2) % 3);
        ++f10[s], ++f01[t], ++f11[s], ++f11[t];
        const auto face = face_metrics(nodes(f), nodes(f10), nodes(f01), nodes(f11));
        const auto mean = 0.25 * (nodes(f) + nodes(f10) + nodes(f01) + nodes(f11));
        const double outward = end == 1 ? 1.0 : -1.0;
        by_means += outward * (mean[0] * face.normal[1] - mean[1] * face.normal[0]);
        by_integral += outward * face.moment_z;
        size = std::max(size, std::abs(face.moment_z));
      }
    largest = std::max(largest, std::abs(by_means));
    exact = std::max(exact, std::abs(by_integral));
  });
  EXPECT_LE(exact, 1e-14 * size);
  EXPECT_GE(largest, 1e-4 * size);
}

template <int Dim>
BlockGeometry<Dim> geometry_of(const Index<Dim>& cells,
                               const std::function<Vec<double, Dim>(const Vec<double, Dim>&)>& place) {
  auto mesh = bent_box<Dim>(cells, 0.0);
  for_each(mesh.zones[0].nodes.interior(),
           [&](const Index<Dim>& node) { mesh.zones[0].nodes(node) = place(mesh.zones[0].nodes(node)); });
  const FlowCase<Dim> c(std::move(mesh), 0.5, 0.0, 1.0, Comm(MPI_COMM_SELF));
  return c.domain.blocks()[0].geometry;
}

TEST(BlockGeometry, VolumesOfKnownCellsAreExact) {
  // Trapezium: sides 1 and 1.5, height 2.
  const auto trapezium = geometry_of<2>({1, 1}, [](const Vec<double, 2>& x) {
    return Vec<double, 2>{{{x[0] * (1.0 + 0.5 * x[1]), 2.0 * x[1]}}};
  });
  EXPECT_NEAR(trapezium.volume[0], 2.5, 1e-15);
  // z = u (1 + s t) over the unit square: the integral of 1 + s t, four warped faces around it.
  const auto tent = geometry_of<3>({1, 1, 1}, [](const Vec<double, 3>& x) {
    return Vec<double, 3>{{{x[0], x[1], x[2] * (1.0 + x[0] * x[1])}}};
  });
  EXPECT_NEAR(tent.volume[0], 1.25, 1e-15);
  // A prism twisted linearly: sections at height z are the unit square under [1 z; -z 1].
  const auto twisted = geometry_of<3>({1, 1, 1}, [](const Vec<double, 3>& x) {
    return Vec<double, 3>{{{x[0] + x[2] * x[1], x[1] - x[2] * x[0], x[2]}}};
  });
  EXPECT_NEAR(twisted.volume[0], 1.0 + 1.0 / 3.0, 1e-15);
}

template <int Dim>
double total_volume(MultiblockMesh<Dim> mesh) {
  const FlowCase<Dim> c(std::move(mesh), 0.5, 0.0);
  double sum = 0.0;
  for (double volume : c.domain.volumes()) sum += volume;
  return c.comm.sum(sum);
}

TEST(BlockGeometry, VolumesFillTheDomain) {
  EXPECT_NEAR(total_volume<2>(bent_box<2>({7, 5})), 1.0, 1e-14);
  EXPECT_NEAR(total_volume<3>(cut_blocks<3>(bent_box<3>({8, 6, 5}), 3)), 1.0, 1e-14);
}

// Nose up turns what lies aft of the axis down; positive plunge moves the mesh down.
Vec<double, 2> moved_point(const Vec<double, 2>& x, const Vec<double, 2>& axis, double pitch, double plunge) {
  const double rx = x[0] - axis[0], ry = x[1] - axis[1];
  return {{{axis[0] + std::cos(pitch) * rx + std::sin(pitch) * ry,
            axis[1] - std::sin(pitch) * rx + std::cos(pitch) * ry - plunge}}};
}

TEST(RigidMotion, NormalsAndSweepsAreThoseOfTheMovedNodes) {
  const FlowCase<2> c(bent_box<2>({5, 4}), 0.5, 0.0, 1.0, Comm(MPI_COMM_SELF));
  const auto& geometry = c.domain.blocks()[0].geometry;
  const auto& nodes = c.mesh.zones[0].nodes;
  const MotionState state{0.3, 0.7, -0.4};
  const double h = 1e-6;
  for_each(Box<2>{{0, 0}, {6, 4}}, [&](const Index<2>& f) {
    const auto at = [&](const Index<2>& node, double time) {
      return moved_point(nodes(node), c.domain.axis(), state.pitch + time * state.pitch_rate,
                         time * state.plunge_rate);
    };
    const Index<2> top{f[0], f[1] + 1};
    const auto face = moved_face<2, double>(geometry, rigid_motion(state), 0, geometry.layout.offset(f));
    const auto expected = face_metrics(at(f, 0.0), at(top, 0.0)).normal;
    const auto velocity = (0.25 / h) * (at(f, h) - at(f, -h) + at(top, h) - at(top, -h));
    for (int d = 0; d < 2; ++d) EXPECT_NEAR(face.normal[d], expected[d], 1e-15);
    EXPECT_NEAR(face.sweep, dot(velocity, expected), 1e-10);
  });
}

// The mesh of a plane flow, extruded over `span` in one layer of cells between symmetry planes.
MultiblockMesh<3> extruded(const MultiblockMesh<2>& plane, double span) {
  const Zone<2>& flat = plane.zones[0];
  Zone<3> zone;
  zone.name = flat.name;
  zone.cells = {flat.cells[0], flat.cells[1], 1};
  zone.nodes = BlockArray<Vec<double, 3>, 3>({zone.cells[0] + 1, zone.cells[1] + 1, 2}, 0);
  for_each(zone.nodes.interior(), [&](const Index<3>& node) {
    const auto& x = flat.nodes({node[0], node[1]});
    zone.nodes(node) = {{{x[0], x[1], span * node[2]}}};
  });
  for (const auto& patch : flat.patches)
    zone.patches.push_back(
        {patch.name,
         "",
         patch.type,
         patch.side,
         {{patch.cells.begin[0], patch.cells.begin[1], 0}, {patch.cells.end[0], patch.cells.end[1], 1}}});
  for (int end : {0, 1})
    zone.patches.push_back({"side", "", BoundaryType::symmetry, {2, end}, box_of<3>(zone.cells)});
  MultiblockMesh<3> mesh;
  mesh.zones.push_back(std::move(zone));
  return mesh;
}

double largest_difference_to_plane_flow(double span) {
  const Comm self(MPI_COMM_SELF);
  auto plane = bent_box<2>({9, 7});
  plane.zones[0].patches[2].type = BoundaryType::slip_wall;
  const FlowCase<3> solid(extruded(plane, span), 0.6, 2.0, 1.0, self);
  const FlowCase<2> flat(std::move(plane), 0.6, 2.0, 1.0, self);
  FlowEquations<2> flat_flow(flat.domain, flat.model, TimeSpectral(1));
  FlowEquations<3> solid_flow(solid.domain, solid.model, TimeSpectral(1));
  const auto w = disturbed_state(flat, flat_flow, 0.03, 4);
  std::vector<double> solid_w;
  for (std::size_t i = 0; i < w.size(); i += 4)
    solid_w.insert(solid_w.end(), {w[i], w[i + 1], w[i + 2], 0.0, w[i + 3]});
  const std::vector<MotionState> motions{{0.03, 0.02, -0.01}, {-0.05, 0.04, 0.03}, {0.02, -0.06, 0.02}};
  std::vector<double> r(w.size()), solid_r(solid_w.size());
  flat_flow.residual(w, motions, 0.3, r);
  solid_flow.residual(solid_w, motions, 0.3, solid_r);
  double largest = 0.0, size = 0.0;
  for (std::size_t cell = 0; cell < w.size() / 4; ++cell)
    for (std::size_t v = 0; v < 5; ++v) {
      const double expected = v == 3 ? 0.0 : r[4 * cell + (v == 4 ? 3 : v)];
      largest = std::max(largest, std::abs(solid_r[5 * cell + v] / span - expected));
      size = std::max(size, std::abs(expected));
    }
  return largest / size;
}

// The third term of the radius scaling, (lambda_3/lambda)^(2/3), fades as the span grows; a span of
// a power of two scales every number exactly.
TEST(FlowEquations, PlaneFlowInSpaceHasTheResidualOfTwoDimensions) {
  EXPECT_LE(largest_difference_to_plane_flow(std::ldexp(1.0, 100)), 1e-13);
  EXPECT_GE(largest_difference_to_plane_flow(1.0), 1e-4) << "the span no longer matters to the scaling";
}

TEST(FlowEquations, StagnantGasBetweenWallsStaysAtRest) {
  const auto expect_rest = [](auto c) {
    auto flow = FlowEquations(c.domain, c.model, TimeSpectral(0));
    const std::vector<double> w = flow.uniform_state();
    std::vector<double> r(w.size());
    const MotionState at_rest;
    flow.residual(w, {&at_rest, 1}, 0.0, r);
    EXPECT_LE(global_norm(c.comm, r), 1e-15 * std::sqrt(static_cast<double>(c.mesh.cell_count())));
  };
  expect_rest(FlowCase<2>(with_all_boundaries(bent_box<2>({9, 8}), BoundaryType::slip_wall), 0.0, 0.0));
  expect_rest(FlowCase<3>(with_all_boundaries(bent_box<3>({6, 5, 4}), BoundaryType::slip_wall), 0.0, 0.0));
}

}  // namespace
}  // namespace wingbeat
