#include "core/algebra/gmres.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "test/core/algebra/model_grid.hpp"

namespace wingbeat::test {
namespace {

// A map of local entries given as functions.
template <class T>
class LambdaOperator final : public LinearOperator<T> {
 public:
  using Map = std::function<void(std::span<const T>, std::span<T>)>;
  LambdaOperator(std::size_t n, Map map) : n_(n), map_(std::move(map)) {}
  std::size_t local_size() const override { return n_; }
  void apply(std::span<const T> x, std::span<T> y) const override { map_(x, y); }
  void apply_transpose(std::span<const T> x, std::span<T> y) const override { map_(x, y); }

 private:
  std::size_t n_;
  Map map_;
};

template <class T>
void expect_solves_convection_diffusion(bool transpose) {
  const Comm comm;
  const ModelGrid<4> grid(comm, 16, 6);
  const auto a = grid.matrix();
  const ShiftedOperator<T, 4> direct(grid, a, grid.shift<T>());
  const TransposedOperator<T> transposed(direct);
  const LinearOperator<T>& op = transpose ? static_cast<const LinearOperator<T>&>(transposed) : direct;
  const auto exact = grid.field<T>(0.4);
  std::vector<T> b(exact.size()), x(exact.size()), ax(exact.size());
  op.apply(exact, b);
  const IdentityOperator<T> identity(op.local_size());
  const GmresOptions options{.relative_tolerance = 1e-11, .restart = 50, .max_iterations = 2000};
  const GmresResult result = gmres<T>(comm, op, identity, b, x, options);
  EXPECT_EQ(result.status, GmresStatus::converged);
  op.apply(x, ax);
  EXPECT_NEAR(result.relative_residual, distance(comm, ax, b) / norm(comm, b), 1e-15);
  EXPECT_LE(result.relative_residual, 1e-11);
  EXPECT_LT(distance(comm, x, exact), 1e-8 * norm(comm, exact));
}

TEST(Gmres, SolvesRealAndComplexSystemsAndTheirTransposes) {
  expect_solves_convection_diffusion<double>(false);
  expect_solves_convection_diffusion<double>(true);
  expect_solves_convection_diffusion<std::complex<double>>(false);
  expect_solves_convection_diffusion<std::complex<double>>(true);
}

// Entries g of a diagonal with four distinct values: the minimal polynomial has degree four.
struct FourEigenvalues {
  Comm comm;
  std::size_t n = 5 + comm.rank();
  LambdaOperator<double> op{n, [](std::span<const double> in, std::span<double> out) {
                              for (std::size_t i = 0; i < in.size(); ++i) out[i] = double(1 + i % 4) * in[i];
                            }};
  IdentityOperator<double> identity{n};
  std::vector<double> b = std::vector<double>(n, 1.0);
  std::vector<double> x = std::vector<double>(n, 0.0);
};

TEST(Gmres, EndsAfterAsManyIterationsAsThereAreEigenvalues) {
  FourEigenvalues s;
  const auto result = gmres<double>(s.comm, s.op, s.identity, s.b, s.x, {.relative_tolerance = 1e-13});
  EXPECT_EQ(result.status, GmresStatus::converged);
  EXPECT_EQ(result.iterations, 4);
}

TEST(Gmres, StopsAtTheIterationLimitWithItsTrueResidual) {
  FourEigenvalues s;
  const auto result = gmres<double>(s.comm, s.op, s.identity, s.b, s.x,
                                    {.relative_tolerance = 1e-13, .restart = 2, .max_iterations = 3});
  EXPECT_EQ(result.status, GmresStatus::iteration_limit);
  EXPECT_EQ(result.iterations, 3);
  std::vector<double> ax(s.n);
  s.op.apply(s.x, ax);
  EXPECT_NEAR(result.relative_residual, distance(s.comm, ax, s.b) / norm(s.comm, s.b), 1e-15);
}

TEST(Gmres, ContinuesFromTheGivenStart) {
  FourEigenvalues s;
  for (std::size_t i = 0; i < s.n; ++i) s.x[i] = 1.0 / double(1 + i % 4);
  const auto result = gmres<double>(s.comm, s.op, s.identity, s.b, s.x, {});
  EXPECT_EQ(result.status, GmresStatus::converged);
  EXPECT_EQ(result.iterations, 0);
}

TEST(Gmres, AnswersAZeroRightHandSideWithZero) {
  FourEigenvalues s;
  s.b.assign(s.n, 0.0);
  s.x.assign(s.n, 3.0);
  const auto result = gmres<double>(s.comm, s.op, s.identity, s.b, s.x, {});
  EXPECT_EQ(result.status, GmresStatus::converged);
  EXPECT_EQ(s.x, std::vector<double>(s.n, 0.0));
}

TEST(Gmres, SaysWhenANumberIsNotFinite) {
  FourEigenvalues s;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const LambdaOperator<double> broken(s.n, [&](std::span<const double>, std::span<double> y) {
    std::fill(y.begin(), y.end(), s.comm.is_root() ? nan : 0.0);
  });
  EXPECT_EQ(gmres<double>(s.comm, broken, s.identity, s.b, s.x, {}).status, GmresStatus::not_finite);
  EXPECT_EQ(s.x, std::vector<double>(s.n, 0.0));
  s.b[0] = nan;
  EXPECT_EQ(gmres<double>(s.comm, s.op, s.identity, s.b, s.x, {}).status, GmresStatus::not_finite);
}

TEST(Gmres, StagnatesWhereNoSolutionExists) {
  FourEigenvalues s;
  const LambdaOperator<double> projection(s.n, [](std::span<const double> x, std::span<double> y) {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = i == 0 ? 0.0 : x[i];
  });
  const auto result = gmres<double>(s.comm, projection, s.identity, s.b, s.x, {.restart = 10});
  EXPECT_EQ(result.status, GmresStatus::stagnated);
  // One entry a rank is out of reach.
  EXPECT_NEAR(result.relative_residual, std::sqrt(double(s.comm.size())) / norm(s.comm, s.b), 1e-12);
}

TEST(Gmres, AllowsAPreconditionerThatChangesBetweenCalls) {
  FourEigenvalues s;
  int calls = 0;
  const LambdaOperator<double> changing(s.n, [&](std::span<const double> x, std::span<double> y) {
    ++calls;
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = x[i] / (1.0 + 0.1 * noise(calls + 0.3 * double(i)));
  });
  const auto result = gmres<double>(s.comm, s.op, changing, s.b, s.x, {.relative_tolerance = 1e-12});
  EXPECT_EQ(result.status, GmresStatus::converged);
  for (std::size_t i = 0; i < s.n; ++i) EXPECT_NEAR(s.x[i], 1.0 / double(1 + i % 4), 1e-11);
}

TEST(Gmres, RepeatsToTheLastBit) {
  const Comm comm;
  const ModelGrid<4> grid(comm, 16, 6);
  const auto a = grid.matrix();
  const ShiftedOperator<double, 4> op(grid, a, grid.shift<double>());
  const IdentityOperator<double> identity(op.local_size());
  const auto b = grid.field<double>(0.4);
  std::vector<double> first(b.size()), second(b.size());
  gmres<double>(comm, op, identity, b, first, {.relative_tolerance = 1e-6});
  gmres<double>(comm, op, identity, b, second, {.relative_tolerance = 1e-6});
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace wingbeat::test
