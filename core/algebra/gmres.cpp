#include "core/algebra/gmres.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/algebra/krylov_kernels.hpp"
#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// A cycle that leaves more than this part of the residual leads nowhere.
constexpr double stagnation = 0.999;

// The small least-squares problem min |beta e_1 - H y|, H upper Hessenberg, kept triangular by
// Givens rotations while columns are added.
template <class T>
class HessenbergLeastSquares {
 public:
  explicit HessenbergLeastSquares(double beta) : rhs_{T(beta)} {}

  // Adds column (h_0 .. h_k, subdiagonal); returns the residual norm of the larger problem.
  double add_column(std::vector<T> column, double subdiagonal) {
    for (std::size_t i = 0; i < rotations_.size(); ++i) rotations_[i].turn(column[i], column[i + 1]);
    Rotation rotation(column.back(), subdiagonal);
    T below = subdiagonal;
    rotation.turn(column.back(), below);
    rhs_.push_back(T(0));
    rotation.turn(rhs_[rhs_.size() - 2], rhs_.back());
    rotations_.push_back(rotation);
    columns_.push_back(std::move(column));
    return std::abs(rhs_.back());
  }

  // The minimiser; directions the operator maps to nothing, to round-off, get no weight.
  std::vector<T> solution() const {
    std::vector<T> y(rhs_.begin(), rhs_.end() - 1);
    double largest = 0.0;
    for (std::size_t k = 0; k < y.size(); ++k) largest = std::max(largest, std::abs(columns_[k][k]));
    const double negligible = 16.0 * std::numeric_limits<double>::epsilon() * largest;
    for (std::size_t k = y.size(); k-- > 0;) {
      const T pivot = columns_[k][k];
      y[k] = std::abs(pivot) <= negligible ? T(0) : y[k] / pivot;
      for (std::size_t i = 0; i < k; ++i) y[i] -= columns_[k][i] * y[k];
    }
    return y;
  }

 private:
  struct Rotation {
    double cosine = 1.0;
    T sine = T(0);

    Rotation(T upper, double lower) {
      const double length = std::hypot(std::abs(upper), lower);
      if (length == 0.0) return;
      cosine = std::abs(upper) / length;
      const T direction = upper == T(0) ? T(1) : upper / std::abs(upper);
      sine = direction * (lower / length);
    }
    void turn(T& upper, T& lower) const {
      const T old = upper;
      upper = cosine * old + sine * lower;
      lower = cosine * lower - conjugate(sine) * old;
    }
  };

  std::vector<Rotation> rotations_;
  std::vector<std::vector<T>> columns_;
  std::vector<T> rhs_;
};

// Orthonormal basis V of the Krylov space and its preconditioned copies Z = M^-1 V.
template <class T>
struct KrylovSpace {
  std::vector<std::vector<T>> v;
  std::vector<std::vector<T>> z;
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

// One cycle from residual r of norm beta; x is improved unless something was not finite.
template <class T>
bool run_cycle(const Comm& comm, const LinearOperator<T>& op, const LinearOperator<T>& preconditioner,
               std::vector<T> r, double beta, double target, int max_columns, KrylovSpace<T>& space,
               std::span<T> x, int& iterations) {
  scale<T>(1.0 / beta, r);
  space.v.clear();
  space.z.clear();
  space.v.push_back(std::move(r));
  HessenbergLeastSquares<T> small(beta);
  for (int k = 0; k < max_columns; ++k) {
    std::vector<T>& z = space.z.emplace_back(x.size());
    std::vector<T> w(x.size());
    preconditioner.apply(space.v.back(), z);
    op.apply(z, w);
    std::vector<T> column(space.v.size());
    const auto [norm, norm_before] = orthogonalize<T>(comm, space.v, w, column);
    ++iterations;
    if (!std::isfinite(norm) || !std::isfinite(norm_before)) return false;
    const bool exhausted = norm <= std::numeric_limits<double>::epsilon() * norm_before;
    const double estimate = small.add_column(std::move(column), exhausted ? 0.0 : norm);
    if (exhausted || estimate <= target) break;
    scale<T>(1.0 / norm, w);
    space.v.push_back(std::move(w));
  }
  const std::vector<T> y = small.solution();
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
  KrylovSpace<T> space;
  for (;;) {
    result.relative_residual = norm / rhs_norm;
    if (!std::isfinite(norm)) return result.status = GmresStatus::not_finite, result;
    if (norm <= tolerance) return result.status = GmresStatus::converged, result;
    const int columns = std::min(options.restart, options.max_iterations - result.iterations);
    if (columns <= 0) return result.status = GmresStatus::iteration_limit, result;
    const std::vector<T> x_before(x.begin(), x.end());
    if (!run_cycle<T>(comm, op, preconditioner, r, norm, target, columns, space, x, result.iterations))
      return result.status = GmresStatus::not_finite, result;
    const double previous = norm;
    norm = update_residual();
    if (norm < previous) {
      if (norm <= tolerance || norm <= stagnation * previous) continue;
    } else {
      std::copy(x_before.begin(), x_before.end(), x.begin());
    }
    result.relative_residual = std::min(norm, previous) / rhs_norm;
    result.status = std::isfinite(norm) ? GmresStatus::stagnated : GmresStatus::not_finite;
    return result;
  }
}

template GmresResult gmres<double>(const Comm&, const LinearOperator<double>&, const LinearOperator<double>&,
                                   std::span<const double>, std::span<double>, const GmresOptions&);
template GmresResult gmres<std::complex<double>>(const Comm&, const LinearOperator<std::complex<double>>&,
                                                 const LinearOperator<std::complex<double>>&,
                                                 std::span<const std::complex<double>>,
                                                 std::span<std::complex<double>>, const GmresOptions&);

}  // namespace wingbeat
