// Restricted additive Schwarz with incomplete factors.
#include <gtest/gtest.h>

#include "core/algebra/gmres.hpp"
#include "core/io/error.hpp"
#include "test/core/algebra/schwarz_case.hpp"

namespace wingbeat::test {
namespace {

SubdomainOptions ilu(int fill, int overlap = 1) {
  return {.overlap = overlap, .method = SubdomainMethod::ilu, .fill = fill};
}

template <class T>
void expect_lu_with_full_fill() {
  const Preconditioned<T> complete(16, 6, {.overlap = 1}), incomplete(16, 6, ilu(1000));
  const auto b = complete.grid.template field<T>(0.6);
  std::vector<T> expected(b.size()), x(b.size());
  complete.schwarz.apply(b, expected);
  incomplete.schwarz.apply(b, x);
  EXPECT_LT(distance(complete.comm, x, expected), 1e-12 * norm(complete.comm, expected));
  complete.schwarz.apply_transpose(b, expected);
  incomplete.schwarz.apply_transpose(b, x);
  EXPECT_LT(distance(complete.comm, x, expected), 1e-12 * norm(complete.comm, expected));
}

TEST(SchwarzIlu, IsThatWithLuWhereTheFillIsFull) {
  expect_lu_with_full_fill<double>();
  expect_lu_with_full_fill<Complex>();
}

template <class T>
void expect_dot_test(const SubdomainOptions& options) {
  const Preconditioned<T> s(16, 6, options);
  const auto x = s.grid.template field<T>(0.3);
  const auto v = s.grid.template field<T>(0.9);
  std::vector<T> mx(x.size()), mtv(x.size());
  s.schwarz.apply(x, mx);
  s.schwarz.apply_transpose(v, mtv);
  EXPECT_LT(std::abs(bilinear(s.comm, v, mx) - bilinear(s.comm, mtv, x)),
            1e-13 * norm(s.comm, v) * norm(s.comm, mx));
}

TEST(SchwarzIlu, TransposePassesTheDotTest) {
  for (const int fill : {0, 2})
    for (const int overlap : {0, 2}) {
      expect_dot_test<double>(ilu(fill, overlap));
      expect_dot_test<Complex>(ilu(fill, overlap));
    }
}

template <class T>
int iterations(int fill, bool transpose) {
  const Preconditioned<T> s(48, 16, ilu(fill));
  const TransposedOperator<T> op_transposed(s.op), schwarz_transposed(s.schwarz);
  const LinearOperator<T>& op = transpose ? static_cast<const LinearOperator<T>&>(op_transposed) : s.op;
  const LinearOperator<T>& m =
      transpose ? static_cast<const LinearOperator<T>&>(schwarz_transposed) : s.schwarz;
  const auto exact = s.grid.template field<T>(0.8);
  std::vector<T> b(exact.size()), x(exact.size());
  op.apply(exact, b);
  const auto result = gmres<T>(s.comm, op, m, b, x, {.relative_tolerance = 1e-12});
  EXPECT_EQ(result.status, GmresStatus::converged);
  EXPECT_LT(distance(s.comm, x, exact), 1e-9 * norm(s.comm, exact));
  return result.iterations;
}

template <class T>
void expect_fill_spares_iterations(bool transpose) {
  const int none = iterations<T>(0, transpose), some = iterations<T>(2, transpose),
            much = iterations<T>(6, transpose);
  EXPECT_LT(some, none);
  EXPECT_LE(much, some);
  EXPECT_LT(much, 0.7 * none);
}

TEST(SchwarzIlu, MakesGmresConvergeInFewerIterationsWithMoreFill) {
  expect_fill_spares_iterations<double>(false);
  expect_fill_spares_iterations<double>(true);
  expect_fill_spares_iterations<Complex>(false);
  expect_fill_spares_iterations<Complex>(true);
}

TEST(SchwarzIlu, TakesLessMemoryThanLu) {
  const Preconditioned<double> complete(48, 16, {.overlap = 1}), incomplete(48, 16, ilu(0));
  EXPECT_GT(incomplete.schwarz.factor_bytes(), 0.0);
  EXPECT_LT(incomplete.schwarz.factor_bytes(), 0.5 * complete.schwarz.factor_bytes());
}

TEST(SchwarzIlu, ASingularBlockOnOneRankIsRefusedOnAll) {
  Preconditioned<double> s(16, 6, ilu(1));
  if (s.comm.is_root()) {
    for (int k = s.grid.pattern->row_begin[0]; k < s.grid.pattern->row_begin[1]; ++k)
      std::fill_n(s.matrix.block(k).begin(), B, 0.0);  // the first row of cell 0
  }
  EXPECT_THROW(s.schwarz.factor(s.matrix, {}), InternalError);
  EXPECT_FALSE(s.schwarz.is_factored());
}

TEST(SchwarzIlu, RefusesBlocksItHasNoKernelsFor) {
  const Comm comm;
  const ModelGrid<B> grid(comm, 16, 6);
  const auto subdomain = std::make_shared<Subdomain>(comm, grid.halo, grid.pattern, ilu(1));
  EXPECT_THROW(SchwarzSolver<double>(comm, subdomain, 7), InternalError);
}

}  // namespace
}  // namespace wingbeat::test
