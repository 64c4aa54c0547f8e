// Marching a section in time with loads that are known in closed form.
#include "structure/time_marching.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "structure/cycle_estimate.hpp"
#include "structure/growth_bracket.hpp"
#include "structure/harmonic_motion.hpp"
#include "test/structure/quasi_steady_section.hpp"

namespace wingbeat {
namespace {

using testing::QuasiSteadyLoads;
using testing::QuasiSteadySection;
using Values = std::vector<double>;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double pitch_period = 2.0 * std::numbers::pi;

Values values(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

// e^{Bt} y_0 of the linear section.
Values exact_state(const QuasiSteadySection& section, double velocity, const Values& y0, double t) {
  const Eigen::EigenSolver<Eigen::Matrix4d> modes(section.system(velocity));
  const Eigen::Vector4cd amplitudes =
      modes.eigenvectors().partialPivLu().solve(Eigen::Vector4d(y0.data()).cast<std::complex<double>>());
  const Eigen::Vector4cd grown = (modes.eigenvalues() * t).array().exp() * amplitudes.array();
  return values((modes.eigenvectors() * grown).real());
}

// Levels at 0, -dtau, ... newest first.
std::vector<Values> exact_history(const QuasiSteadySection& section, double velocity, const Values& y0,
                                  double dtau, int levels) {
  std::vector<Values> history;
  for (int k = 0; k < levels; ++k) history.push_back(exact_state(section, velocity, y0, -k * dtau));
  return history;
}

double distance(std::span<const double> a, const Values& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

constexpr double tight = 1e-12;
const Values start{0.02, 0.05, -0.01, 0.03};

double error_after(double time, int steps, int order, int levels) {
  const QuasiSteadySection section;
  const double velocity = 0.7, dtau = time / steps;
  QuasiSteadyLoads loads(velocity);
  TimeMarching march(section.model(), section.model().load(velocity), dtau, loads,
                     {.order = order, .tolerance = tight});
  march.start(exact_history(section, velocity, start, dtau, levels));
  for (int n = 0; n < steps; ++n) EXPECT_EQ(march.step().status, SolveStatus::converged);
  return distance(march.y(), exact_state(section, velocity, start, time));
}

// The error of order p falls by 2^p (1 + O(omega dt)) as the step is halved, omega dt being .013 here.
TEST(TimeMarching, HasTheOrderOfItsFormula) {
  for (int order = 1; order <= 3; ++order) {
    const double coarse = error_after(10.0, 800, order, order), fine = error_after(10.0, 1600, order, order);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.05) << "order " << order;
  }
}

// One first-order step among them errs by O(dt^2), no more than the second-order march does itself.
TEST(TimeMarching, OfSecondOrderMayStartFromASingleLevel) {
  const double coarse = error_after(10.0, 400, 2, 1), fine = error_after(10.0, 800, 2, 1);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05);
}

// Loads that answer the motion within the step amplify its error eightfold when flow and structure just
// take turns.
TEST(TimeMarching, ConvergesForALightSection) {
  const QuasiSteadySection section{.mass_ratio = 0.01};
  const double velocity = 0.8, dtau = pitch_period / 96;
  QuasiSteadyLoads loads(velocity);
  TimeMarching march(section.model(), section.model().load(velocity), dtau, loads,
                     {.order = 1, .tolerance = 1e-10});
  march.start({start});
  const Eigen::Matrix4d implicit = Eigen::Matrix4d::Identity() - dtau * section.system(velocity);
  Eigen::Vector4d expected(start.data());
  for (int n = 0; n < 20; ++n) {
    const TimeStepResult result = march.step();
    ASSERT_EQ(result.status, SolveStatus::converged);
    EXPECT_LE(result.iterations, n == 0 ? 8 : 5) << "step " << n;
    expected = implicit.partialPivLu().solve(expected);
    EXPECT_LE(distance(march.y(), values(expected)), 1e-8 * expected.norm());
  }
}

// Visits to the flow in the last of 4 periods.
int visits_in_a_period(int steps, double tolerance) {
  const QuasiSteadySection section;
  QuasiSteadyLoads loads(0.8);
  TimeMarching march(section.model(), section.model().load(0.8), pitch_period / steps, loads,
                     {.order = 2, .tolerance = tolerance});
  march.start({start});
  for (int n = 0; n < 3 * steps; ++n) march.step();
  loads.visits = 0;
  for (int n = 0; n < steps; ++n) march.step();
  return loads.visits;
}

// Forces extrapolated from three steps err by (omega dt)^3 of themselves, and y by the same of its change in
// the step times c V^2 |M^-1 f|/|u'|, which is about one here: within a tolerance of 4 (omega dt)^3 the first
// visit does, and within a hundredth of it none does without a second.
TEST(TimeMarching, VisitsTheFlowOnceAStepWhereThePredictionIsWithinTheTolerance) {
  for (const int steps : {48, 96}) {
    const double error = std::pow(pitch_period / steps, 3);
    EXPECT_EQ(visits_in_a_period(steps, 4.0 * error), steps);
    EXPECT_GT(visits_in_a_period(steps, 0.01 * error), 3 * steps / 2);
  }
}

class FailingLoads final : public UnsteadyLoads {
 public:
  void begin(double) override { ++step_; }
  SolveStatus forces(std::span<const double>, std::span<double> f) override {
    f[0] = f[1] = 0.0;
    return step_ > 1 ? SolveStatus::diverged : SolveStatus::converged;
  }
  void accept() override {}

 private:
  int step_ = 0;
};

TEST(TimeMarching, KeepsTheLastGoodStepWhereTheFlowFails) {
  FailingLoads loads;
  TimeMarching march(QuasiSteadySection().model(), 1.0, 0.1, loads, {});
  march.start({start});
  EXPECT_EQ(march.step().status, SolveStatus::converged);
  const Values good(march.y().begin(), march.y().end());
  EXPECT_EQ(march.step().status, SolveStatus::diverged);
  EXPECT_EQ(Values(march.y().begin(), march.y().end()), good);
}

// States of a march, one step after another.
Values marched(const QuasiSteadySection& section, double velocity, double dtau, int order,
               std::vector<Values> history, int steps) {
  QuasiSteadyLoads loads(velocity);
  TimeMarching march(section.model(), section.model().load(velocity), dtau, loads,
                     {.order = order, .tolerance = 1e-10});
  Values record = history.front();
  march.start(std::move(history));
  for (int n = 0; n < steps; ++n) {
    march.step();
    record.insert(record.end(), march.y().begin(), march.y().end());
  }
  return record;
}

// The exponent p of the marched motion solves lambda = sum_k c_k e^{-k p dtau}/dtau, lambda that of the
// section: without growth, p = i omega.
double speed_without_growth(const QuasiSteadySection& section, double dtau, int order) {
  const BackwardDifference formula(order);
  double low = 0.80, high = 0.86;
  for (int i = 0; i < 50; ++i) {
    const double v = 0.5 * (low + high);
    const std::complex<double> lambda = section.leading_exponent(v);
    std::complex<double> p = lambda;
    for (int k = 0; k < 50; ++k) {
      std::complex<double> value = -lambda, slope = 0.0;
      for (int j = 0; j <= order; ++j) {
        const std::complex<double> term =
            formula.c[static_cast<std::size_t>(j)] * std::exp(-static_cast<double>(j) * p * dtau) / dtau;
        value += term;
        slope -= static_cast<double>(j) * dtau * term;
      }
      p -= value / slope;
    }
    (p.real() > 0.0 ? high : low) = v;
  }
  return 0.5 * (low + high);
}

TEST(TimeMarching, FindsTheHopfPointByItsGrowthRates) {
  const QuasiSteadySection section;
  for (int order : {2, 3}) {
    const double dtau = pitch_period / 96;
    GrowthBracket search(0.80, {.tolerance = 1e-6});
    for (int i = 0; i < 10 && !search.is_found(); ++i) {
      const double v = search.next();
      const Values record = marched(section, v, dtau, order, {start}, 96 * 12);
      const auto growth =
          estimate_growth(section.model(), {std::span<const double>(record).subspan(4 * 96), dtau});
      ASSERT_TRUE(growth);
      search.add({v, growth->rate, growth->rate_error, growth->frequency, growth->frequency_error});
    }
    ASSERT_TRUE(search.is_found()) << "order " << order;
    const GrowthCrossing crossing = *search.crossing();
    EXPECT_NEAR(crossing.reduced_velocity, speed_without_growth(section, dtau, order), 2e-6);
    // Formulas of both orders change growth by omega (omega dt)^3/4, 3e-5 here, over the slope.
    const double exact = 3.0 / std::sqrt(13.0);
    EXPECT_NEAR(crossing.reduced_velocity, exact, 4e-5 / crossing.slope);
    // Frequency errs by (omega dt)^2/3 with the second order.
    EXPECT_NEAR(crossing.frequency, exact, order == 2 ? 1.2e-3 * exact : 5e-4 * exact);
  }
}

// k3 = 1.5, reference cycle of 5 degrees, from both sides of it.
TEST(TimeMarching, GoesToTheLimitCycleOfFiveDegrees) {
  const QuasiSteadySection section{.cubic = 1.5};
  const double velocity = .835610740820, omega = .835609018385, dtau = pitch_period / 256;
  const StructureModel model = section.model();
  const Eigen::EigenSolver<Eigen::Matrix4d> modes(section.system(velocity));
  Eigen::Index leading = 0;
  modes.eigenvalues().real().maxCoeff(&leading);
  for (const double first_deg : {4.8, 5.2}) {
    SCOPED_TRACE(first_deg);
    const Eigen::Vector4cd shape = modes.eigenvectors().col(leading) / modes.eigenvectors()(1, leading);
    std::vector<Values> history;
    for (int k = 0; k < 3; ++k)
      history.push_back(values(
          (first_deg * degree * std::exp(std::complex<double>(0.0, -k * omega * dtau)) * shape).real()));
    const Values record = marched(section, velocity, dtau, 3, history, 256 * 100);
    const MotionRecord last{std::span<const double>(record).last(4 * 256 * 20), dtau};
    const std::vector<MarchedPeriod> periods = periods_of(model, last);
    const auto cycle = estimate_cycle(periods);
    ASSERT_TRUE(cycle);
    const Values sampled = sampled_period(model, last, periods.back(), 31);
    const double pitch = std::abs(first_harmonic(model, TimeSpectral(15), sampled)[1]) / degree;
    // Amplitude goes with the root of the energy.
    const double limit = pitch * std::sqrt(cycle->energy_limit / cycle->energy);
    // The third-order formula adds omega (omega dt)^3/4 to the growth rate. The square of the amplitude goes
    // with the growth rate at rest.
    const double growth = section.leading_exponent(velocity).real();
    const double added = omega * std::pow(omega * dtau, 3) / 4.0;
    EXPECT_NEAR(limit, 5.0, 1.5 * 5.0 * added / (2.0 * growth));
    EXPECT_NEAR(cycle->frequency, omega, 2.0 * added);
  }
}

}  // namespace
}  // namespace wingbeat
