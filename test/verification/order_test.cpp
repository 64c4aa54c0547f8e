#include <gtest/gtest.h>

#include "core/mesh/metrics.hpp"
#include "flow/pseudo_transient.hpp"
#include "test/flow/every_scheme.hpp"
#include "test/verification/exact_flow.hpp"

namespace wingbeat {
namespace {

using namespace testing;

const JstScheme no_dissipation{0.0, 0.0, 0.0};

std::vector<NamedScheme> with_and_without_dissipation() {
  auto schemes = every_scheme();
  schemes.push_back({"none", no_dissipation});
  return schemes;
}

// exp with its derivatives: the code itself needs none.
template <int N>
Dual<double, N> exponential(const Dual<double, N>& x) {
  const double y = std::exp(x.value);
  return chain(x, y, y);
}

// In space the box leans: the stream, which has no third component, crosses all its sides. Where it
// runs along a far field, the upwind side is anyone's, and Newton's method may cycle.
constexpr double lean = 0.35;

template <int Dim>
MultiblockMesh<Dim> leaning_box(const Index<Dim>& cells) {
  auto mesh = bent_box<Dim>(cells);
  auto& nodes = mesh.zones[0].nodes;
  if constexpr (Dim == 3)
    for_each(nodes.interior(), [&](const Index<3>& node) { nodes(node)[2] += lean * nodes(node)[0]; });
  return mesh;
}

// A bump that is 1 in the middle of the box and negligible on its sides beside the errors measured.
template <int Dim, class T>
T bump(const Vec<T, Dim>& x, double width) {
  T distance(0.0);
  for (int d = 0; d < Dim; ++d) {
    const T from_middle = d == 2 ? x[d] - lean * x[0] - 0.5 : x[d] - 0.5;
    distance += from_middle * from_middle;
  }
  return exponential(distance / (-width * width));
}

// Free stream at Mach 0.5 with a bump in every variable: steady under the source that its flux
// divergence is.
template <int Dim>
struct ManufacturedFlow {
  Freestream<Dim, double> freestream;

  template <class T>
  Primitive<Dim, T> operator()(const Vec<T, Dim>& x) const {
    const T b = bump<Dim, T>(x, Dim == 2 ? 0.15 : 0.18);
    Primitive<Dim, T> q;
    q[0] = 1.0 + 0.2 * b;
    q[1] = freestream.speed() * freestream.angle_cosine + 0.1 * b;
    q[2] = freestream.speed() * freestream.angle_sine - 0.15 * b;
    if constexpr (Dim == 3) q[3] = 0.12 * b;
    q[Dim + 1] = 1.0 + 0.1 * b;
    return q;
  }
};

// Isentropic vortex in a stream along y: steady in the frame that moves with the stream
// (Shu 1998, doi:10.1007/BFb0096355, centred in the box and scaled to its size).
struct IsentropicVortex {
  double speed = 0.0;
  double gamma = 1.4;

  template <class T>
  Primitive<2, T> operator()(const Vec<T, 2>& x) const {
    constexpr double strength = 0.5, radius = 0.08;
    const T x0 = (x[0] - 0.5) / radius, y0 = (x[1] - 0.5) / radius;
    const T swirl = strength * exponential(0.5 * (1.0 - (x0 * x0 + y0 * y0)));
    // T = T_inf - (gamma - 1)/(2 gamma) swirl^2, p = rho^gamma.
    const T temperature = 1.0 - (0.5 * (gamma - 1.0) / gamma) * swirl * swirl;
    const T density = power(temperature, 1.0 / (gamma - 1.0));
    Primitive<2, T> q;
    q[0] = density;
    q[1] = -swirl * y0;
    q[2] = speed + swirl * x0;
    q[3] = density * temperature;
    return q;
  }
};

// Slopes of log(error) between successive meshes of so many cells along a side.
template <class Error>
void expect_order(const std::vector<int>& cells, double order, const Error& error_on) {
  std::vector<double> errors;
  for (int count : cells) errors.push_back(error_on(count));
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const double observed =
        std::log(errors[i - 1] / errors[i]) / std::log(static_cast<double>(cells[i]) / cells[i - 1]);
    EXPECT_GE(observed, order) << "from error " << errors[i - 1] << " to " << errors[i];
  }
}

double vortex_truncation_error(int cells, const Scheme& scheme) {
  FlowCase<2> c(bent_box<2>({cells, cells}), 0.4, 90.0);
  c.model.scheme = scheme;
  FlowEquations<2> flow(c.domain, c.model, TimeSpectral(0));
  const double speed = c.model.freestream.speed();
  const auto exact = integrate<2>(c.mesh, IsentropicVortex{speed, 1.4}, 1.4);
  const MotionState with_the_stream{0.0, 0.0, -speed};
  std::vector<double> r(exact.average.size());
  flow.residual(exact.average, {&with_the_stream, 1}, 0.0, r);
  const auto volumes = c.domain.volumes();
  for (std::size_t i = 0; i < r.size(); ++i) r[i] /= volumes[i / 4];
  return l2_norm(r, volumes);
}

TEST(OrderOfAccuracy, IsentropicVortexOnAMeshThatMovesWithIt) {
  for (const auto& [name, scheme] : with_and_without_dissipation()) {
    SCOPED_TRACE(name);
    expect_order({48, 96, 192}, 1.9, [&](int cells) { return vortex_truncation_error(cells, scheme); });
  }
}

template <int Dim>
double manufactured_solution_error(const Index<Dim>& cells, const Scheme& scheme) {
  FlowCase<Dim> c(leaning_box<Dim>(cells), 0.5, 25.0);
  c.model.scheme = scheme;
  FlowEquations<Dim> flow(c.domain, c.model, TimeSpectral(0));
  const auto exact = integrate<Dim>(c.mesh, ManufacturedFlow<Dim>{c.model.freestream}, 1.4);
  const auto subdomain = std::make_shared<const Subdomain>(c.comm, c.domain.exchange(), c.domain.pattern(),
                                                           SubdomainOptions{.overlap = 0});
  SchwarzSolver<double> solver(c.comm, subdomain, state_size<Dim>);
  std::vector<double> w = exact.average;
  // From the exact averages Newton's method needs no pseudo-time.
  PseudoTransientOptions options;
  options.tolerance = 1e-9;
  options.cfl_initial = 1e8;
  options.cfl_growth = 0.0;
  options.step_limit = 1.0;
  const auto result = pseudo_transient<Dim>(flow, {}, solver, w, options, {}, exact.source);
  EXPECT_EQ(result.status, SolveStatus::converged) << "residual " << result.residual;
  for (std::size_t i = 0; i < w.size(); ++i) w[i] -= exact.average[i];
  return l2_norm(w, c.domain.volumes());
}

TEST(OrderOfAccuracy, ManufacturedFlowInThePlane) {
  for (const auto& [name, scheme] : with_and_without_dissipation()) {
    SCOPED_TRACE(name);
    expect_order({16, 32, 64}, 1.9, [&](int cells) {
      return manufactured_solution_error<2>({cells, cells}, scheme);
    });
  }
}

TEST(OrderOfAccuracy, ManufacturedFlowInSpace) {
  expect_order({8, 10, 14}, 1.9, [&](int cells) {
    return manufactured_solution_error<3>({cells, cells, cells}, no_dissipation);
  });
}

}  // namespace
}  // namespace wingbeat
