// Tangents and sensitivities of the flow equations with respect to geometry, free stream, motion and
// frequency.
#include <gtest/gtest.h>

#include "flow/flow_sensitivity.hpp"
#include "flow/flow_tangent.hpp"
#include "test/flow/every_scheme.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat::testing {
namespace {

// A disturbed periodic flow on a moving mesh.
template <int Dim>
struct MovingCase {
  FlowCase<Dim> c;
  FlowEquations<Dim> flow;
  std::vector<double> w;
  std::vector<MotionState> motions;
  static constexpr double kappa = 0.3;

  MovingCase(MultiblockMesh<Dim> mesh, const Scheme& scheme)
      : c(std::move(mesh), 0.7, 3.0), flow(c.domain, {c.model.freestream, scheme}, TimeSpectral(1)) {
    w = disturbed_state(c, flow, 0.03, 5);
    for (int n = 0; n < 3; ++n) motions.push_back({0.05 * n - 0.03, 0.2 - 0.07 * n, 0.1 * n - 0.05});
    flow.linearize(w, motions, kappa);
  }
  FlowPoint point() const { return {w, motions, kappa}; }
  const Comm& comm() const { return c.comm; }

  // Nodes of each block moved by a smooth field: the same node moves alike wherever it is kept.
  std::vector<LocalBlock<Dim>> moved_blocks(double by) const {
    std::vector<LocalBlock<Dim>> blocks = c.local.blocks;
    for (auto& block : blocks)
      for (std::size_t i = 0; i < block.nodes.size(); ++i) {
        Vec<double, Dim>& x = block.nodes.data()[i];
        const Vec<double, Dim> at = x;
        for (int d = 0; d < Dim; ++d) {
          double wave = 0.02 * by;
          for (int e = 0; e < Dim; ++e) wave *= std::sin(3.0 * at[e] + 0.7 * d + e);
          x[d] += wave;
        }
      }
    return blocks;
  }
  // The domain and its equations with nodes, axis, Mach number and angle moved by that much.
  struct Moved {
    LocalMesh<Dim> local;
    std::unique_ptr<FlowDomain<Dim>> domain;
    std::unique_ptr<FlowEquations<Dim>> flow;
  };
  Moved at(double step) const {
    Moved moved;
    moved.local = c.local;
    moved.local.blocks = moved_blocks(step);
    moved.domain =
        std::make_unique<FlowDomain<Dim>>(c.comm, moved.local, Vec<double, 2>{{{0.2 + 0.1 * step, 0.0}}});
    FlowModel<Dim, double> model = flow.model();
    const double angle = 3.0 * std::numbers::pi / 180 + 0.3 * step;
    model.freestream = {1.4, 0.7 + 0.5 * step, std::cos(angle), std::sin(angle)};
    moved.flow = std::make_unique<FlowEquations<Dim>>(*moved.domain, model, flow.time());
    return moved;
  }
  // The change that `at` makes, by differences of the geometry that are exact to round-off: it is at most
  // cubic in the step.
  FlowInputs<Dim> change() const {
    FlowInputs<Dim> result(flow);
    const double h = 1e-3;
    const auto p1 = at(h), m1 = at(-h), p2 = at(2 * h), m2 = at(-2 * h);
    const auto slope = [h](double a, double b, double c2, double d2) {
      return (8.0 * (a - b) - (c2 - d2)) / (12.0 * h);
    };
    for (std::size_t b = 0; b < result.geometry.size(); ++b) {
      const auto of = [b](const Moved& m) -> const BlockGeometry<Dim>& {
        return m.domain->blocks()[b].geometry;
      };
      for (std::size_t i = 0; i < result.geometry[b].moment[0].size(); ++i)
        for (std::size_t d = 0; d < Dim; ++d) {
          for (std::size_t k = 0; k < Dim; ++k)
            result.geometry[b].normal[d][k][i] = slope(of(p1).normal[d][k][i], of(m1).normal[d][k][i],
                                                       of(p2).normal[d][k][i], of(m2).normal[d][k][i]);
          result.geometry[b].moment[d][i] =
              slope(of(p1).moment[d][i], of(m1).moment[d][i], of(p2).moment[d][i], of(m2).moment[d][i]);
        }
      for (std::size_t i = 0; i < result.geometry[b].volume.size(); ++i)
        result.geometry[b].volume[i] =
            slope(of(p1).volume[i], of(m1).volume[i], of(p2).volume[i], of(m2).volume[i]);
    }
    result.mach = 0.5;
    result.angle = 0.3;
    result.kappa = 0.4;
    result.motions = motion_change();
    return result;
  }
  static std::vector<MotionState> motion_change() {
    return {{0.4, -0.3, 0.2}, {-0.1, 0.5, 0.3}, {0.2, 0.1, -0.6}};
  }
  FlowTangent differences(double h) const {
    const auto evaluate = [&](double step) {
      const Moved moved = at(step);
      std::vector<MotionState> m = motions;
      for (std::size_t n = 0; n < m.size(); ++n) {
        m[n].pitch += step * motion_change()[n].pitch;
        m[n].pitch_rate += step * motion_change()[n].pitch_rate;
        m[n].plunge_rate += step * motion_change()[n].plunge_rate;
      }
      FlowTangent values;
      values.residual.resize(w.size());
      moved.flow->residual(w, m, kappa + 0.4 * step, values.residual);
      values.loads = moved.flow->loads(w, m);
      return values;
    };
    FlowTangent above = evaluate(h), below = evaluate(-h);
    for (std::size_t i = 0; i < w.size(); ++i)
      above.residual[i] = (above.residual[i] - below.residual[i]) / (2.0 * h);
    for (std::size_t n = 0; n < above.loads.size(); ++n) {
      above.loads[n].force_x = (above.loads[n].force_x - below.loads[n].force_x) / (2.0 * h);
      above.loads[n].force_y = (above.loads[n].force_y - below.loads[n].force_y) / (2.0 * h);
      above.loads[n].moment = (above.loads[n].moment - below.loads[n].moment) / (2.0 * h);
    }
    return above;
  }
};

template <int Dim>
double geometry_dot(const FlowInputs<Dim>& a, const FlowInputs<Dim>& b) {
  double sum = 0.0;
  const auto add = [&sum](const std::vector<double>& x, const std::vector<double>& y) {
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  };
  for (std::size_t k = 0; k < a.geometry.size(); ++k) {
    for (std::size_t d = 0; d < Dim; ++d) {
      for (std::size_t c = 0; c < Dim; ++c) add(a.geometry[k].normal[d][c], b.geometry[k].normal[d][c]);
      add(a.geometry[k].moment[d], b.geometry[k].moment[d]);
    }
    add(a.geometry[k].volume, b.geometry[k].volume);
  }
  return sum;
}

template <int Dim>
double total_dot(const Comm& comm, const FlowInputs<Dim>& a, const FlowInputs<Dim>& b) {
  double sum = a.mach * b.mach + a.angle * b.angle + a.kappa * b.kappa;
  for (std::size_t n = 0; n < a.motions.size(); ++n)
    sum += a.motions[n].pitch * b.motions[n].pitch + a.motions[n].pitch_rate * b.motions[n].pitch_rate +
           a.motions[n].plunge_rate * b.motions[n].plunge_rate;
  return sum + comm.sum(geometry_dot(a, b));
}

template <int Dim>
double load_dot(const std::vector<Loads<double>>& a, const std::vector<Loads<double>>& b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n)
    sum += a[n].force_x * b[n].force_x + a[n].force_y * b[n].force_y + a[n].moment * b[n].moment;
  return sum;
}

const std::vector<Loads<double>> weights{{0.7, -0.4, 0.3}, {-0.2, 0.9, 0.5}, {0.1, 0.6, -0.8}};

template <int Dim>
void expect_transposed(const MovingCase<Dim>& m, const std::string& name) {
  const FlowInputs<Dim> change = m.change();
  const FlowTangent tangent = flow_tangent<Dim>(m.flow, m.point(), change);
  const std::vector<double> multipliers = noise_field(m.c, 3, 11);
  const FlowInputs<Dim> sensitivity = flow_sensitivity<Dim>(m.flow, m.point(), multipliers, weights);
  const double forward =
      global_dot(m.comm(), multipliers, tangent.residual) + load_dot<Dim>(weights, tangent.loads);
  const double scale = global_norm(m.comm(), multipliers) * global_norm(m.comm(), tangent.residual);
  EXPECT_NEAR(total_dot(m.comm(), sensitivity, change), forward, 1e-13 * scale) << name;
}

TEST(FlowInputs, SensitivityIsTheTransposeOfTheTangentForEveryScheme) {
  for (const auto& [name, scheme] : every_scheme())
    expect_transposed(MovingCase<2>(section_mesh("naca64a010", 48, 12, 3), scheme), name);
}

TEST(FlowInputs, TheSameIn3D) {
  const auto mesh = bent_box<3>({6, 5, 4});
  for (const auto& [name, scheme] : every_scheme()) expect_transposed(MovingCase<3>(mesh, scheme), name);
}

TEST(FlowInputs, TangentAgreesWithDifferencesForEveryScheme) {
  // Central differences of a smooth function: h^2 f'''/6 and eps/h.
  for (const auto& [name, scheme] : every_scheme()) {
    const MovingCase<2> m(section_mesh("naca64a010", 48, 12, 2), scheme);
    const FlowTangent tangent = flow_tangent<2>(m.flow, m.point(), m.change());
    const FlowTangent expected = m.differences(1e-5);
    std::vector<double> defect = tangent.residual;
    for (std::size_t i = 0; i < defect.size(); ++i) defect[i] -= expected.residual[i];
    EXPECT_LT(global_norm(m.comm(), defect), 1e-7 * global_norm(m.comm(), tangent.residual)) << name;
    for (std::size_t n = 0; n < 3; ++n) {
      EXPECT_NEAR(tangent.loads[n].force_x, expected.loads[n].force_x, 1e-8) << name;
      EXPECT_NEAR(tangent.loads[n].force_y, expected.loads[n].force_y, 1e-8) << name;
      EXPECT_NEAR(tangent.loads[n].moment, expected.loads[n].moment, 1e-8) << name;
    }
  }
}

}  // namespace
}  // namespace wingbeat::testing
