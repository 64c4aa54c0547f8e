#include <gtest/gtest.h>

#include "test/flow/every_scheme.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;

const std::vector<MotionState> motions{{0.03, 0.02, -0.01}, {-0.05, 0.04, 0.03}, {0.02, -0.06, 0.02}};

template <int Dim>
void expect_uniform_flow_stays_uniform(MultiblockMesh<Dim> mesh) {
  FlowCase<Dim> c(with_all_boundaries(std::move(mesh), BoundaryType::farfield), 0.8, 3.0);
  for (const auto& [name, scheme] : every_scheme()) {
    c.model.scheme = scheme;
    FlowEquations<Dim> flow(c.domain, c.model, TimeSpectral(1));
    std::vector<double> r(flow.state_count());
    flow.residual(flow.uniform_state(), motions, 0.21, r);
    double largest = 0.0;
    for (double value : r) largest = std::max(largest, std::abs(value));
    EXPECT_LE(c.comm.max(largest), 1e-12) << name;
  }
}

TEST(FlowEquations, UniformFlowStaysUniformOnAPitchingAndPlungingMesh) {
  expect_uniform_flow_stays_uniform<2>(section_mesh("naca0012", 48, 16));
  expect_uniform_flow_stays_uniform<2>(section_mesh("naca2412", 48, 16, 5));
  expect_uniform_flow_stays_uniform<2>(bent_box<2>({13, 9}));
  expect_uniform_flow_stays_uniform<3>(bent_box<3>({9, 7, 6}));
  expect_uniform_flow_stays_uniform<3>(cut_blocks<3>(bent_box<3>({8, 7, 6}), 3));
}

// The fluxes are taken in excess of the free stream's, so that the free stream itself would stay
// uniform even on faces that do not close: any other uniform flow shows whether they do.
template <int Dim>
void expect_any_uniform_flow_stays_uniform_inside(MultiblockMesh<Dim> mesh) {
  FlowCase<Dim> c(with_all_boundaries(std::move(mesh), BoundaryType::farfield), 0.8, 3.0);
  FlowModel<Dim, double> other = c.model;
  other.freestream.mach = 0.3;
  other.freestream.angle_cosine = 0.0;
  other.freestream.angle_sine = 1.0;
  const auto uniform = FlowEquations<Dim>(c.domain, other, TimeSpectral(1)).uniform_state();
  for (const auto& [name, scheme] : every_scheme()) {
    c.model.scheme = scheme;
    FlowEquations<Dim> flow(c.domain, c.model, TimeSpectral(1));
    std::vector<double> r(flow.state_count());
    flow.residual(uniform, motions, 0.21, r);
    double largest = 0.0;
    for (const auto& block : c.domain.blocks())
      for_each(box_of<Dim>(block.geometry.layout.extents), [&](const Index<Dim>& cell) {
        const auto& layout = block.geometry.layout;
        const auto o = layout.offset(cell);
        for (const BoundaryFace& face : block.boundary)
          if (face.first == o) return;
        const auto at = static_cast<std::size_t>(block.number[static_cast<std::size_t>(o)]) * state_size<Dim>;
        for (std::size_t v = 0; v < state_size<Dim>; ++v) largest = std::max(largest, std::abs(r[at + v]));
      });
    EXPECT_LE(c.comm.max(largest), 1e-12) << name;
  }
}

TEST(FlowEquations, AnyUniformFlowStaysUniformAwayFromTheFarField) {
  expect_any_uniform_flow_stays_uniform_inside<2>(section_mesh("naca2412", 48, 16, 5));
  expect_any_uniform_flow_stays_uniform_inside<3>(cut_blocks<3>(bent_box<3>({8, 7, 6}), 3));
}

// Directional derivative of the whole residual by dual numbers.
template <int Dim>
std::vector<double> dual_tangent(const FlowCase<Dim>& c, const TimeSpectral& time, std::span<const double> w,
                                 std::span<const double> dw, double kappa) {
  using D = Dual<double, 1>;
  constexpr int n = state_size<Dim>;
  const auto& f = c.model.freestream;
  FluxBalance<Dim, D> balance(c.domain, {{f.gamma, f.mach, f.angle_cosine, f.angle_sine}, c.model.scheme});
  const std::size_t count = c.domain.state_count(),
                    ghost_count = static_cast<std::size_t>(c.domain.ghost_count()) * n;
  std::vector<double> ghosts(ghost_count * time.instances()), ghost_tangents(ghosts.size());
  c.domain.exchange().template gather<double>(w, ghosts, time.instances(), n);
  c.domain.exchange().template gather<double>(dw, ghost_tangents, time.instances(), n);
  const auto lift = [](double value, double tangent) {
    D x(value);
    x.gradient[0] = tangent;
    return x;
  };
  std::vector<double> result(w.size());
  for (std::size_t i = 0; i < static_cast<std::size_t>(time.instances()); ++i) {
    std::vector<D> state(count), ghost(ghost_count), out(count);
    for (std::size_t j = 0; j < count; ++j) state[j] = lift(w[i * count + j], dw[i * count + j]);
    for (std::size_t j = 0; j < ghost_count; ++j)
      ghost[j] = lift(ghosts[i * ghost_count + j], ghost_tangents[i * ghost_count + j]);
    const auto m = rigid_motion(motions[i]);
    balance.evaluate(state, ghost, {m.cosine, m.sine, m.pitch_rate, m.plunge_rate}, out);
    for (std::size_t j = 0; j < count; ++j) result[i * count + j] = out[j].gradient[0];
  }
  FlowEquations<Dim>(c.domain, c.model, time).add_time_derivative(kappa, dw, result);
  return result;
}

template <int Dim>
void expect_exact_jacobian(MultiblockMesh<Dim> mesh, const Scheme& scheme, bool is_smooth = true) {
  FlowCase<Dim> c(std::move(mesh), 0.75, 1.5);
  c.model.scheme = scheme;
  const TimeSpectral time(1);
  FlowEquations<Dim> flow(c.domain, c.model, time);
  const auto w = disturbed_state(c, flow, 0.05, 1);
  const auto dw = noise_field(c, 3, 77);
  const double kappa = 0.3;
  flow.linearize(w, motions, kappa);
  std::vector<double> product(w.size());
  flow.apply(dw, product);
  auto tangent = dual_tangent(c, time, w, dw, kappa);
  const double size = global_norm(c.comm, tangent);
  std::vector<double> difference(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) difference[i] = product[i] - tangent[i];
  EXPECT_LE(global_norm(c.comm, difference), 1e-12 * size);

  // Central differences of the double-precision residual see the same matrix.
  const double h = 1e-6;
  std::vector<double> plus(w.size()), minus(w.size()), r_plus(w.size()), r_minus(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) plus[i] = w[i] + h * dw[i], minus[i] = w[i] - h * dw[i];
  flow.residual(plus, motions, kappa, r_plus);
  flow.residual(minus, motions, kappa, r_minus);
  if (is_smooth) {
    for (std::size_t i = 0; i < w.size(); ++i)
      difference[i] = (r_plus[i] - r_minus[i]) / (2 * h) - tangent[i];
    EXPECT_LE(global_norm(c.comm, difference), 1e-6 * size);
  }

  const auto lambda = noise_field(c, 3, 5);
  std::vector<double> transposed(w.size());
  flow.apply_transpose(lambda, transposed);
  const double forward = global_dot(c.comm, lambda, product), backward = global_dot(c.comm, transposed, dw);
  EXPECT_LE(std::abs(forward - backward), 1e-12 * global_norm(c.comm, lambda) * global_norm(c.comm, product));
}

TEST(FlowEquations, JacobianIsThatOfTheWholeResidual) {
  for (const auto& [name, scheme] : every_scheme()) {
    SCOPED_TRACE(name);
    expect_exact_jacobian<2>(section_mesh("naca0012", 32, 8), scheme);
    expect_exact_jacobian<2>(section_mesh("naca0012", 32, 8, 6), scheme);
    expect_exact_jacobian<2>(bent_box<2>({5, 1}), scheme);
    expect_exact_jacobian<3>(cut_blocks<3>(bent_box<3>({5, 4, 6}), 2), scheme);
  }
}

TEST(FlowEquations, JacobianIsThatOfTheWholeResidualWithClassicalSwitches) {
  const JstScheme classical{0.25, 1.0 / 64.0, 0.0};
  expect_exact_jacobian<2>(section_mesh("naca0012", 32, 8, 6), classical, false);
  expect_exact_jacobian<3>(cut_blocks<3>(bent_box<3>({5, 4, 6}), 2), classical, false);
}

TEST(FlowEquations, MotionGradientsMatchDifferences) {
  FlowCase<2> c(section_mesh("naca64a010", 40, 10), 0.8, 0.5);
  FlowEquations<2> flow(c.domain, c.model, TimeSpectral(1));
  const auto w = disturbed_state(c, flow, 0.02, 3);
  flow.linearize(w, motions, 0.2);
  const double h = 1e-6;
  const std::size_t count = c.domain.state_count();
  for (int k = 0; k < 3; ++k) {
    auto plus = motions, minus = motions;
    for (auto* shifted : {&plus, &minus}) {
      MotionState& m = (*shifted)[1];
      (k == 0 ? m.pitch : k == 1 ? m.pitch_rate : m.plunge_rate) += shifted == &plus ? h : -h;
    }
    std::vector<double> r_plus(w.size()), r_minus(w.size());
    flow.residual(w, plus, 0.2, r_plus);
    flow.residual(w, minus, 0.2, r_minus);
    std::vector<double> difference(count);
    const auto& column = flow.motion_gradients(1)[static_cast<std::size_t>(k)];
    for (std::size_t j = 0; j < count; ++j)
      difference[j] = (r_plus[count + j] - r_minus[count + j]) / (2 * h) - column[j];
    EXPECT_LE(global_norm(c.comm, difference), 1e-6 * global_norm(c.comm, column)) << "column " << k;
    const auto loads_plus = flow.loads(w, plus)[1], loads_minus = flow.loads(w, minus)[1];
    const auto& loads = flow.linearized_loads(1);
    EXPECT_NEAR((loads_plus.force_y - loads_minus.force_y) / (2 * h), loads.force_y.gradient[k], 1e-7);
    EXPECT_NEAR((loads_plus.force_x - loads_minus.force_x) / (2 * h), loads.force_x.gradient[k], 1e-7);
    EXPECT_NEAR((loads_plus.moment - loads_minus.moment) / (2 * h), loads.moment.gradient[k], 1e-7);
  }
}

TEST(FlowEquations, LoadGradientsMatchDifferences) {
  FlowCase<2> c(section_mesh("naca64a010", 40, 10, 4), 0.8, 0.5);
  FlowEquations<2> flow(c.domain, c.model, TimeSpectral(0));
  const std::vector<MotionState> motion{{0.02, 0.01, 0.03}};
  const auto w = disturbed_state(c, flow, 0.02, 3);
  const auto dw = noise_field(c, 1, 8);
  flow.linearize(w, motion, 0.0);
  const double h = 1e-6;
  std::vector<double> plus(w.size()), minus(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) plus[i] = w[i] + h * dw[i], minus[i] = w[i] - h * dw[i];
  const auto up = flow.loads(plus, motion)[0], down = flow.loads(minus, motion)[0];
  const auto& gradients = flow.load_gradients(0);
  EXPECT_NEAR((up.force_x - down.force_x) / (2 * h), global_dot(c.comm, gradients.force_x, dw), 1e-8);
  EXPECT_NEAR((up.force_y - down.force_y) / (2 * h), global_dot(c.comm, gradients.force_y, dw), 1e-8);
  EXPECT_NEAR((up.moment - down.moment) / (2 * h), global_dot(c.comm, gradients.moment, dw), 1e-8);
}

}  // namespace
}  // namespace wingbeat
