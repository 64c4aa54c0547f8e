#include "core/algebra/newton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wingbeat {
namespace {

// Independent scalar equations f(u_i) = 0, preconditioned by the slopes of the last refactorization.
class Scalars final : public Problem {
 public:
  using Function = std::function<double(double u, double offset)>;
  Scalars(std::size_t n, Function f, Function slope, double tolerance = 1e-12)
      : f_(std::move(f)), slope_(std::move(slope)), tolerance_(tolerance), slopes_(n), factors_(n, 0.0) {}

  std::size_t local_size() const override { return slopes_.size(); }
  bool residual(std::span<const double> u, std::span<double> f) override {
    ++evaluations;
    bool sensible = true;
    for (std::size_t i = 0; i < u.size(); ++i) {
      f[i] = f_(u[i], offset(i));
      sensible = sensible && !(reject_nan && std::isnan(f[i]));
    }
    return sensible;
  }
  void linearize(std::span<const double> u) override {
    for (std::size_t i = 0; i < u.size(); ++i) slopes_[i] = slope_(u[i], offset(i));
  }
  const LinearOperator<double>& jacobian() const override { return jacobian_; }
  void refactor() override {
    factored_ = true;
    for (std::size_t i = 0; i < slopes_.size(); ++i) factors_[i] = slopes_[i] == 0.0 ? 1.0 : 1.0 / slopes_[i];
  }
  bool is_factored() const override { return factored_; }
  const LinearOperator<double>& preconditioner() const override { return preconditioner_; }
  double excess(std::span<const double> f) const override {
    double largest = 0.0;
    for (double value : f) largest = std::max(largest, std::abs(value));
    return largest / tolerance_;
  }
  static double offset(std::size_t i) { return 1.0 + static_cast<double>(i); }

  bool reject_nan = true;
  int evaluations = 0;

 private:
  class Diagonal final : public LinearOperator<double> {
   public:
    explicit Diagonal(const std::vector<double>& values) : values_(values) {}
    std::size_t local_size() const override { return values_.size(); }
    void apply(std::span<const double> x, std::span<double> y) const override {
      for (std::size_t i = 0; i < x.size(); ++i) y[i] = values_[i] * x[i];
    }
    void apply_transpose(std::span<const double> x, std::span<double> y) const override { apply(x, y); }

   private:
    const std::vector<double>& values_;
  };

  Function f_, slope_;
  double tolerance_;
  bool factored_ = false;
  std::vector<double> slopes_, factors_;
  Diagonal jacobian_{slopes_}, preconditioner_{factors_};
};

Scalars cubes(std::size_t n) {
  return Scalars(
      n, [](double u, double b) { return u * u * u - b; }, [](double u, double) { return 3 * u * u; });
}

TEST(Newton, FindsTheRootsAndReportsEveryIteration) {
  const Comm comm;
  Scalars problem = cubes(6);
  std::vector<double> u(6, 2.0);
  std::vector<double> norms;
  const auto result =
      newton(comm, problem, u, {},
             [&](const NewtonIteration& line, std::span<const double>, std::span<const double>) {
               EXPECT_EQ(line.iteration, static_cast<int>(norms.size()));
               norms.push_back(line.residual_norm);
               return true;
             });
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_EQ(result.iterations + 1, static_cast<int>(norms.size()));
  EXPECT_EQ(result.residual_norm, norms.back());
  for (std::size_t i = 1; i < norms.size(); ++i) EXPECT_LT(norms[i], norms[i - 1]);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], std::cbrt(Scalars::offset(i)), 1e-12);
}

TEST(Newton, ConvergesQuadraticallyWhenLinearSolvesAreTight) {
  const Comm comm;
  Scalars problem = cubes(1);
  std::vector<double> u(1, 1.1);  // root 1: errors 0.1, 9e-3, 7e-5, 5e-9, 1e-17
  const auto result = newton(comm, problem, u, {.forcing_max = 1e-12, .forcing_min = 1e-12});
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_EQ(result.iterations, 4);
}

TEST(Newton, KeepsItsFactorsWhileTheyServe) {
  const Comm comm;
  Scalars problem = cubes(6);
  std::vector<double> u(6, 2.0);
  const auto result = newton(comm, problem, u, {.refactor_iterations = 50});
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_GT(result.iterations, 2);
  EXPECT_EQ(result.factorizations, 1);
}

TEST(Newton, RefactorsWhenTheSolvesTakeTooLong) {
  const Comm comm;
  Scalars problem = cubes(6);
  std::vector<double> u(6, 2.0);
  const auto result = newton(comm, problem, u, {.refactor_iterations = 1});
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_GT(result.factorizations, 1);
  EXPECT_LE(result.factorizations, result.iterations);
}

TEST(Newton, RefactorsAndSolvesAgainWhenOldFactorsFail) {
  const Comm comm;
  Scalars problem = cubes(6);
  std::vector<double> u(6, 2.0);
  NewtonOptions options{.refactor_iterations = 1000};
  options.gmres.max_iterations = 1;  // enough for exact factors only
  const auto result = newton(comm, problem, u, options);
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_GT(result.factorizations, 1);
}

// Plain Newton on atan runs away from |u| > 1.39.
TEST(Newton, LineSearchTamesASolveThatWouldRunAway) {
  const Comm comm;
  Scalars problem(
      1, [](double u, double) { return std::atan(u); }, [](double u, double) { return 1.0 / (1.0 + u * u); });
  std::vector<double> u(1, 10.0);
  const auto result = newton(comm, problem, u, {});
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_NEAR(u[0], 0.0, 1e-12);
}

// The first full step from 5 lands at a negative argument of the logarithm.
TEST(Newton, ShortensStepsIntoStatesThatCannotBeEvaluated) {
  const Comm comm;
  Scalars problem(
      1, [](double u, double) { return std::log(u); }, [](double u, double) { return 1.0 / u; });
  std::vector<double> u(1, 5.0);
  EXPECT_EQ(newton(comm, problem, u, {}).status, SolveStatus::converged);
  EXPECT_NEAR(u[0], 1.0, 1e-12);
  problem.reject_nan = false;  // a NaN that goes unnoticed by the problem is treated alike
  u[0] = 5.0;
  EXPECT_EQ(newton(comm, problem, u, {}).status, SolveStatus::converged);
}

TEST(Newton, StallsWhereThereIsNoRootAndKeepsTheBestState) {
  const Comm comm;
  Scalars problem(
      1, [](double u, double) { return u * u + 1.0; }, [](double u, double) { return 2.0 * u; });
  std::vector<double> u(1, 1.0);
  const auto result = newton(comm, problem, u, {.forcing_max = 1e-12, .forcing_min = 1e-12});
  EXPECT_EQ(result.status, SolveStatus::stalled);
  EXPECT_NEAR(result.residual_norm, std::sqrt(comm.sum(1.0)), 1e-12);
  EXPECT_NEAR(u[0], 0.0, 1e-12);
}

TEST(Newton, SaysDivergedWhenTheStartCannotBeEvaluatedOnOneRank) {
  const Comm comm;
  Scalars problem(
      1, [](double u, double) { return std::log(u); }, [](double u, double) { return 1.0 / u; });
  std::vector<double> u(1, comm.is_root() ? -1.0 : 2.0);
  EXPECT_EQ(newton(comm, problem, u, {}).status, SolveStatus::diverged);
}

TEST(Newton, StopsAtTheIterationLimit) {
  const Comm comm;
  Scalars problem = cubes(6);
  std::vector<double> u(6, 2.0);
  const auto result = newton(comm, problem, u, {.max_iterations = 2});
  EXPECT_EQ(result.status, SolveStatus::iteration_limit);
  EXPECT_EQ(result.iterations, 2);
}

TEST(Newton, AnObserverOnOneRankInterruptsAll) {
  const Comm comm;
  Scalars problem = cubes(6);
  std::vector<double> u(6, 2.0);
  const auto result =
      newton(comm, problem, u, {},
             [&](const NewtonIteration& line, std::span<const double>, std::span<const double>) {
               return !(comm.is_root() && line.iteration == 1);
             });
  EXPECT_EQ(result.status, SolveStatus::interrupted);
  EXPECT_EQ(result.iterations, 1);
}

}  // namespace
}  // namespace wingbeat
