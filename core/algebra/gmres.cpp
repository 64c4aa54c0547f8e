#include "core/algebra/gmres.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "core/algebra/hessenberg_least_squares.hpp"
#include "core/algebra/krylov_deflation.hpp"
#include "core/algebra/krylov_kernels.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// A cycle that leaves more than this part of the residual leads nowhere,
constexpr double stagnation = 0.999;
// but this many of them may pass while deflation finds the directions that hold it up.
constexpr int stalls_allowed = 3;

// The residual may lie outside the kept space by this part of itself, squared.
constexpr double negligible_part = 1e-8;

// Orthonormal basis V of the Krylov space, its preconditioned copies Z = M^-1 V, and the small problem
// with A Z = V H.
template <class T>
struct KrylovSpace {
  std::vector<std::vector<T>> v;
  std::vector<std::vector<T>> z;
  HessenbergLeastSquares<T> small{0.0};
};

struct Orthogonalized {
  double norm = 0.0;  // of what is left
  double norm_before = 0.0;
};

// Classical Gram-Schmidt of w against v, twice, with one reduction a pass; adds to `coefficients`.
template <class T>
Orthogonalized orthogonalize(const Comm& comm, const std::vector<std::vector<T>>& v, std::span<T> w,
                             std::vector<T>& coefficients) {
  const std::size_t k = v.size();
  std::vector<T> dots(k + 1);
  Orthogonalized result;
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < k; ++i) dots[i] = local_dot(v[i], w);
    dots[k] = local_dot(w, w);
    comm.sum(std::span<T>(dots));
    double removed = 0.0;
    for (std::size_t i = 0; i < k; ++i) {
      add_scaled(-dots[i], v[i], w);
      coefficients[i] += dots[i];
      removed += std::norm(dots[i]);
    }
    const double squared = std::real(dots[k]);
    if (pass == 0) result.norm_before = std::sqrt(squared);
    // Pythagoras spares a reduction where it loses no digits.
    const double left = squared - removed;
    if (pass == 1) result.norm = left > 0.5 * squared ? std::sqrt(left) : global_norm<T>(comm, w);
  }
  return result;
}

// Replaces vectors by combinations of them, a stretch of entries at a time.
template <class T>
void combine(std::vector<std::vector<T>>& vectors, const DenseMatrix<T>& weights) {
  constexpr std::size_t stretch = 256;
  const auto old_count = static_cast<std::size_t>(weights.rows());
  const auto new_count = static_cast<std::size_t>(weights.cols());
  const std::size_t n = vectors.front().size();
  for (std::size_t begin = 0; begin < n; begin += stretch) {
    const auto length = static_cast<Eigen::Index>(std::min(stretch, n - begin));
    DenseMatrix<T> old(length, weights.rows());
    for (std::size_t j = 0; j < old_count; ++j)
      std::copy_n(vectors[j].begin() + begin, length, old.col(j).begin());
    const DenseMatrix<T> combined = old * weights;
    for (std::size_t j = 0; j < new_count; ++j)
      std::copy_n(combined.col(j).begin(), length, vectors[j].begin() + begin);
  }
  vectors.resize(new_count);
}

template <class T>
void restart_plainly(KrylovSpace<T>& space, std::span<const T> r, double beta) {
  space.v.clear();
  space.z.clear();
  scale<T>(1.0 / beta, space.v.emplace_back(r.begin(), r.end()));
  space.small = HessenbergLeastSquares<T>(beta);
}

// Goes on with the slow directions of the last cycle, which left the residual r of norm beta. False where
// that is not possible; a plain restart always is.
template <class T>
bool restart_deflated(const Comm& comm, KrylovSpace<T>& space, std::span<const T> r, double beta, int count) {
  if (space.z.empty() || space.v.size() == space.z.size()) return false;  // none yet, or one exhausted
  const auto kept = deflated_space<T>(space.small.matrix(), count);
  if (!kept) return false;
  const auto [rows, columns] = std::pair(kept->hessenberg.rows(), kept->hessenberg.cols());
  combine<T>(space.v, kept->basis);
  combine<T>(space.z, kept->basis.topLeftCorner(kept->basis.rows() - 1, columns));
  DenseVector<T> c(rows);
  for (Eigen::Index i = 0; i < rows; ++i) c[i] = local_dot(space.v[i], r);
  comm.sum(std::span<T>(c.data(), space.v.size()));
  if (!(std::abs(c.squaredNorm() / (beta * beta) - 1.0) < negligible_part)) return false;
  space.small = HessenbergLeastSquares<T>(kept->hessenberg, c);
  return true;
}

// Adds up to `new_columns` to the space; x is improved unless something was not finite.
template <class T>
bool run_cycle(const Comm& comm, const LinearOperator<T>& op, const LinearOperator<T>& preconditioner,
               double target, int new_columns, KrylovSpace<T>& space, std::span<T> x, int& iterations) {
  for (int k = 0; k < new_columns; ++k) {
    std::vector<T>& z = space.z.emplace_back(x.size());
    std::vector<T> w(x.size());
    preconditioner.apply(space.v.back(), z);
    op.apply(z, w);
    std::vector<T> column(space.v.size());
    const auto [norm, norm_before] = orthogonalize<T>(comm, space.v, w, column);
    ++iterations;
    if (!std::isfinite(norm) || !std::isfinite(norm_before)) return false;
    const bool exhausted = norm <= std::numeric_limits<double>::epsilon() * norm_before;
    const double estimate = space.small.add_column(column, exhausted ? 0.0 : norm);
    if (exhausted) break;
    scale<T>(1.0 / norm, w);
    space.v.push_back(std::move(w));
    if (estimate <= target) break;
  }
  const std::vector<T> y = space.small.solution();
  for (std::size_t k = 0; k < y.size(); ++k) add_scaled(y[k], space.z[k], x);
  return true;
}

}  // namespace

std::string_view to_string(GmresStatus status) {
  switch (status) {
    case GmresStatus::converged:
      return "converged";
    case GmresStatus::iteration_limit:
      return "iteration limit";
    case GmresStatus::stagnated:
      return "stagnated";
    case GmresStatus::not_finite:
      return "not finite";
  }
  return "unknown";
}

template <class T>
GmresResult gmres(const Comm& comm, const LinearOperator<T>& op, const LinearOperator<T>& preconditioner,
                  std::span<const T> rhs, std::span<T> x, const GmresOptions& options) {
  const std::size_t n = op.local_size();
  ensure(rhs.size() == n && x.size() == n && preconditioner.local_size() == n,
         "gmres: vector or preconditioner of a wrong size");
  ensure(options.restart > 0, "gmres: restart length must be positive");
  ensure(options.deflation >= 0, "gmres: negative deflation");

  GmresResult result;
  const double rhs_norm = global_norm<T>(comm, rhs);
  const double start_norm = global_norm<T>(comm, x);
  if (rhs_norm == 0.0) {
    std::fill(x.begin(), x.end(), T(0));
    return {GmresStatus::converged, 0, 0.0};
  }
  if (!std::isfinite(rhs_norm) || !std::isfinite(start_norm)) {
    result.status = GmresStatus::not_finite;
    result.relative_residual = std::numeric_limits<double>::quiet_NaN();
    return result;
  }

  std::vector<T> r(rhs.begin(), rhs.end());
  const auto update_residual = [&] {
    op.apply(x, r);
    for (std::size_t i = 0; i < n; ++i) r[i] = rhs[i] - r[i];
    return global_norm<T>(comm, r);
  };
  double norm = start_norm == 0.0 ? rhs_norm : update_residual();
  // The recurrence aims a little lower, so that its round-off does not cost another cycle.
  const double tolerance = options.relative_tolerance * rhs_norm;
  const double target = 0.99 * tolerance;
  const int kept = std::min(options.deflation, options.restart - 2);
  KrylovSpace<T> space;
  for (int stalls = 0;;) {
    result.relative_residual = norm / rhs_norm;
    if (!std::isfinite(norm)) return result.status = GmresStatus::not_finite, result;
    if (norm <= tolerance) return result.status = GmresStatus::converged, result;
    if (result.iterations >= options.max_iterations)
      return result.status = GmresStatus::iteration_limit, result;
    const bool is_deflated = kept > 0 && restart_deflated<T>(comm, space, r, norm, kept);
    if (stalls > (is_deflated ? stalls_allowed : 0)) return result.status = GmresStatus::stagnated, result;
    if (!is_deflated) restart_plainly<T>(space, r, norm);

    const int columns = std::min(options.restart - static_cast<int>(space.z.size()),
                                 options.max_iterations - result.iterations);
    const std::vector<T> x_before(x.begin(), x.end());
    const double previous = norm;
    const bool is_finite =
        run_cycle<T>(comm, op, preconditioner, target, columns, space, x, result.iterations);
    if (!is_finite) return result.status = GmresStatus::not_finite, result;
    norm = update_residual();
    stalls = norm <= tolerance || norm <= stagnation * previous ? 0 : stalls + 1;
    if (norm < previous) continue;
    std::copy(x_before.begin(), x_before.end(), x.begin());
    if (!std::isfinite(norm)) return result.status = GmresStatus::not_finite, result;
    norm = update_residual();
  }
}

template GmresResult gmres<double>(const Comm&, const LinearOperator<double>&, const LinearOperator<double>&,
                                   std::span<const double>, std::span<double>, const GmresOptions&);
template GmresResult gmres<std::complex<double>>(const Comm&, const LinearOperator<std::complex<double>>&,
                                                 const LinearOperator<std::complex<double>>&,
                                                 std::span<const std::complex<double>>,
                                                 std::span<std::complex<double>>, const GmresOptions&);

}  // namespace wingbeat
