#include <gtest/gtest.h>

#include "core/algebra/gmres.hpp"
#include "test/core/algebra/model_grid.hpp"

namespace wingbeat::test {
namespace {

using Complex = std::complex<double>;

// Pairs of unknowns with eigenvalues a +- ib, not normal, divided evenly among 1, 2 or 4 ranks: a few near
// to zero, the others in a cluster.
template <class T>
class PairedSpectrum final : public LinearOperator<T> {
 public:
  static constexpr int pairs = 400;
  explicit PairedSpectrum(const Comm& comm)
      : first_(pairs / comm.size() * comm.rank()), count_(pairs / comm.size()) {}

  std::size_t local_size() const override { return 2 * static_cast<std::size_t>(count_); }
  void apply(std::span<const T> x, std::span<T> y) const override { product(x, y, 4.0, -0.25); }
  void apply_transpose(std::span<const T> x, std::span<T> y) const override { product(x, y, -0.25, 4.0); }

  // A vector that does not depend on the number of ranks.
  std::vector<T> field(double seed) const {
    std::vector<T> x;
    for (int i = 2 * first_; i < 2 * (first_ + count_); ++i) {
      if constexpr (std::is_same_v<T, double>)
        x.push_back(noise(seed + i));
      else
        x.push_back({noise(seed + i), noise(seed + i + 0.5)});
    }
    return x;
  }

 private:
  void product(std::span<const T> x, std::span<T> y, double above, double below) const {
    for (int p = 0; p < count_; ++p) {
      const int g = first_ + p;
      const double a = g < 4 ? 1e-4 * (g + 1) : 1.0 + static_cast<double>(g) / pairs;
      const double b = 0.3 * a;
      T diagonal(a);
      if constexpr (!std::is_same_v<T, double>) diagonal *= Complex(0.98, g % 2 == 0 ? 0.2 : -0.2);
      y[2 * p] = diagonal * x[2 * p] + above * b * x[2 * p + 1];
      y[2 * p + 1] = diagonal * x[2 * p + 1] + below * b * x[2 * p];
    }
  }
  int first_, count_;
};

template <class T>
struct Solved {
  GmresResult result;
  std::vector<T> x;
};

template <class T>
Solved<T> solve(const LinearOperator<T>& op, const std::vector<T>& b, const GmresOptions& options) {
  Solved<T> solved{{}, std::vector<T>(b.size())};
  solved.result = gmres<T>(Comm(), op, IdentityOperator<T>(b.size()), b, solved.x, options);
  return solved;
}

constexpr GmresOptions deflated{
    .relative_tolerance = 1e-10, .restart = 20, .max_iterations = 200, .deflation = 10};

template <class T>
void expect_deflation_pays(bool transpose) {
  const Comm comm;
  const PairedSpectrum<T> direct(comm);
  const TransposedOperator<T> transposed(direct);
  const LinearOperator<T>& op = transpose ? static_cast<const LinearOperator<T>&>(transposed) : direct;
  const auto b = direct.field(0.4);
  std::vector<T> ax(b.size());
  const auto solved = solve<T>(op, b, deflated);
  EXPECT_EQ(solved.result.status, GmresStatus::converged) << solved.result.relative_residual;
  op.apply(solved.x, ax);
  EXPECT_NEAR(solved.result.relative_residual, distance(comm, ax, b) / norm(comm, b), 1e-15);

  GmresOptions plain = deflated;
  plain.deflation = 0;
  plain.max_iterations = 4 * solved.result.iterations;
  const GmresResult without = solve<T>(op, b, plain).result;
  EXPECT_NE(without.status, GmresStatus::converged);
  EXPECT_GT(without.relative_residual, 10.0 * deflated.relative_tolerance);
}

TEST(GmresDeflation, ConvergesWherePlainRestartsTakeManyTimesAsLong) {
  expect_deflation_pays<double>(false);
  expect_deflation_pays<double>(true);
  expect_deflation_pays<Complex>(false);
  expect_deflation_pays<Complex>(true);
}

template <class T>
void expect_the_same_on_one_rank() {
  const Comm all, alone(MPI_COMM_SELF);
  const PairedSpectrum<T> shared(all), whole(alone);
  const auto solved = solve<T>(shared, shared.field(0.4), deflated);
  std::vector<T> x(whole.local_size());
  const auto b = whole.field(0.4);
  const auto result = gmres<T>(alone, whole, IdentityOperator<T>(x.size()), b, x, deflated);
  EXPECT_EQ(solved.result.iterations, result.iterations);
  const auto begin = x.begin() + static_cast<std::ptrdiff_t>(shared.local_size()) * all.rank();
  const std::vector<T> part(begin, begin + static_cast<std::ptrdiff_t>(shared.local_size()));
  EXPECT_LT(distance(all, solved.x, part), 1e-7 * norm(all, part));
}

TEST(GmresDeflation, TakesAsManyIterationsOnAnyNumberOfRanks) {
  expect_the_same_on_one_rank<double>();
  expect_the_same_on_one_rank<Complex>();
}

TEST(GmresDeflation, ChangesNothingWhereNoRestartIsNeeded) {
  const Comm comm;
  const ModelGrid<4> grid(comm, 16, 6);
  const auto a = grid.matrix();
  const ShiftedOperator<double, 4> op(grid, a, grid.shift<double>());
  const auto b = grid.field<double>(0.4);
  const GmresOptions plain{.relative_tolerance = 1e-9, .restart = 400, .max_iterations = 400, .deflation = 0};
  GmresOptions kept = plain;
  kept.deflation = 20;
  EXPECT_EQ(solve<double>(op, b, plain).x, solve<double>(op, b, kept).x);
}

TEST(GmresDeflation, AllowsAPreconditionerThatChangesBetweenCalls) {
  const Comm comm;
  const PairedSpectrum<double> op(comm);
  // Each call solves a little, and differently.
  class Changing final : public LinearOperator<double> {
   public:
    explicit Changing(std::size_t n) : n_(n) {}
    std::size_t local_size() const override { return n_; }
    void apply(std::span<const double> x, std::span<double> y) const override {
      ++calls_;
      for (std::size_t i = 0; i < x.size(); ++i)
        y[i] = x[i] * (1.0 + 0.05 * noise(calls_ + 0.3 * static_cast<double>(i)));
    }
    void apply_transpose(std::span<const double> x, std::span<double> y) const override { apply(x, y); }

   private:
    std::size_t n_;
    mutable int calls_ = 0;
  };
  const Changing changing(op.local_size());
  const auto b = op.field(0.4);
  std::vector<double> x(b.size());
  GmresOptions options = deflated;
  options.max_iterations = 1000;
  const auto result = gmres<double>(comm, op, changing, b, x, options);
  EXPECT_EQ(result.status, GmresStatus::converged) << result.relative_residual;
}

TEST(GmresDeflation, KeepsLessThanTheRestartLength) {
  const PairedSpectrum<double> op{Comm()};
  const auto b = op.field(0.4);
  for (const int restart : {1, 2, 3, 6}) {
    GmresOptions options = deflated;
    options.restart = restart;
    options.deflation = 1000;
    options.max_iterations = 40;
    EXPECT_LT(solve<double>(op, b, options).result.relative_residual, 1.0) << restart;
  }
}

}  // namespace
}  // namespace wingbeat::test
