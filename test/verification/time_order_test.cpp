#include <gtest/gtest.h>

#include <cmath>

#include "flow/dual_time.hpp"
#include "test/verification/exact_flow.hpp"

namespace wingbeat {
namespace {

using namespace testing;

// exp with its derivatives.
template <int N>
Dual<double, N> exponential(const Dual<double, N>& x) {
  const double y = std::exp(x.value);
  return chain(x, y, y);
}

// Isentropic vortex (Shu 1998, doi:10.1007/BFb0096355) at its start, in a stream that carries it across
// the box. The stream crosses all sides: where it runs along a far field the upwind side is anyone's.
struct IsentropicVortex {
  Vec<double, 2> stream;

  template <class T>
  Primitive<2, T> operator()(const Vec<T, 2>& x) const {
    constexpr double strength = 0.4, radius = 0.12, gamma = 1.4;
    const T x0 = (x[0] - 0.45) / radius, y0 = (x[1] - 0.4) / radius;
    const T swirl = strength * exponential(0.5 * (1.0 - (x0 * x0 + y0 * y0)));
    const T temperature = 1.0 - (0.5 * (gamma - 1.0) / gamma) * swirl * swirl;
    const T density = power(temperature, 1.0 / (gamma - 1.0));
    Primitive<2, T> q;
    q[0] = density;
    q[1] = stream[0] - swirl * y0;
    q[2] = stream[1] + swirl * x0;
    q[3] = density * temperature;
    return q;
  }
};

constexpr double start_time = 0.06, end_time = 0.3;
constexpr int finest_steps = 320;  // up to end_time

// The mesh at rest, or pitching and plunging through the flow.
using Motion = MotionState (*)(double time);
MotionState at_rest(double) { return {}; }
MotionState moving(double time) {
  constexpr double pitch = 0.2, plunge = 0.05, frequency = 9.0;
  return {pitch * std::sin(frequency * time), pitch * frequency * std::cos(frequency * time),
          -plunge * frequency * std::sin(frequency * time)};
}

struct Vortex {
  FlowLevel<2> level;
  std::vector<std::vector<double>> finest;  // at the multiples of end_time / finest_steps
  Motion motion;

  // No limiter, which would have kinks: time errors are those of a smooth system.
  explicit Vortex(Motion of_mesh)
      : level(Comm(), bent_box<2>({24, 24}), {{1.4, 0.4, 0.28, 0.96}, JstScheme{0.0, 1.0 / 32.0, 0.0}},
              {{{0.5, 0.5}}}, {}),
        motion(of_mesh) {
    const auto& stream = level.steady.model().freestream;
    const IsentropicVortex vortex{
        {{stream.speed() * stream.angle_cosine, stream.speed() * stream.angle_sine}}};
    finest.push_back(integrate<2>(level.mesh, vortex, 1.4).average);
    march({finest.front()}, 3, finest_steps, 0,
          [&](std::span<const double> w) { finest.emplace_back(w.begin(), w.end()); });
  }

  template <class Visit>
  void march(std::vector<std::vector<double>> history, int order, int steps, int first, const Visit& visit) {
    DualTime<2> flow(level, {.order = order, .tolerance = 1e-8});
    flow.start(std::move(history));
    const double dt = end_time / steps;
    for (int step = first + 1; step <= steps; ++step) {
      const MotionState at = motion(step * dt);
      flow.begin(dt);
      EXPECT_EQ(flow.solve(at).status, SolveStatus::converged);
      flow.accept();
      visit(flow.w());
    }
  }

  // Difference from the finest steps at end_time, of so many steps from start_time with levels of the
  // finest before it: on the same mesh all of it is error in time.
  double error(int order, int steps) {
    const int stride = finest_steps / steps;
    const int first = static_cast<int>(std::lround(start_time / end_time * steps));
    std::vector<std::vector<double>> history;
    for (int k = 0; k < order; ++k) history.push_back(finest[static_cast<std::size_t>((first - k) * stride)]);
    std::vector<double> w;
    march(history, order, steps, first, [&](std::span<const double> at) { w.assign(at.begin(), at.end()); });
    for (std::size_t i = 0; i < w.size(); ++i) w[i] -= finest.back()[i];
    return l2_norm(w, level.domain.volumes());
  }
};

void expect_orders(Motion motion) {
  Vortex vortex(motion);
  for (int order : {2, 3}) {
    const double coarse = vortex.error(order, 20), middle = vortex.error(order, 40),
                 fine = vortex.error(order, 80);
    EXPECT_NEAR(std::log2(coarse / middle), order, 0.35) << "order " << order << ", from " << coarse;
    EXPECT_NEAR(std::log2(middle / fine), order, 0.2) << "order " << order << ", from " << middle;
  }
}

TEST(OrderInTime, VortexCarriedThroughAMeshAtRest) { expect_orders(at_rest); }
TEST(OrderInTime, VortexCarriedThroughAMeshThatPitchesAndPlunges) { expect_orders(moving); }

}  // namespace
}  // namespace wingbeat
