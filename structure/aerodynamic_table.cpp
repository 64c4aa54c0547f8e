#include "structure/aerodynamic_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/io/error.hpp"

namespace wingbeat {

namespace {

void check(const std::vector<double>& k, const std::vector<Eigen::MatrixXcd>& q) {
  if (k.size() != q.size() || k.size() < 4)
    throw InputError(
        fmt::format("aerodynamic table: {} reduced frequencies and {} matrices; "
                    "give as many of one as of the other, at least 4",
                    k.size(), q.size()));
  for (std::size_t j = 0; j < k.size(); ++j) {
    if (!std::isfinite(k[j]) || k[j] < 0.0 || (j > 0 && k[j] <= k[j - 1]))
      throw InputError(
          fmt::format("aerodynamic table: sample {} has k = {}; k must be >= 0 and increase", j, k[j]));
    if (q[j].rows() != q[0].rows() || q[j].cols() != q[0].rows() || q[j].size() == 0)
      throw InputError(fmt::format("aerodynamic table: sample {} (k = {}) is {} x {}; all must be {} x {}", j,
                                   k[j], q[j].rows(), q[j].cols(), q[0].rows(), q[0].rows()));
    if (!q[j].allFinite())
      throw InputError(
          fmt::format("aerodynamic table: sample {} (k = {}) has an entry that is not finite", j, k[j]));
  }
}

enum class End { not_a_knot, clamped, natural };

// Second derivatives of the cubic spline through `values` (samples x components); `first` holds at k[0].
Eigen::MatrixXd spline_curvature(const std::vector<double>& k, const Eigen::MatrixXd& values, End first) {
  const auto n = static_cast<Eigen::Index>(k.size());
  const auto step = [&k](Eigen::Index j) {
    const auto i = static_cast<std::size_t>(j);
    return k[i + 1] - k[i];
  };
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(n, values.cols());
  for (Eigen::Index j = 1; j < n - 1; ++j) {
    matrix(j, j - 1) = step(j - 1);
    matrix(j, j) = 2.0 * (step(j - 1) + step(j));
    matrix(j, j + 1) = step(j);
    rhs.row(j) = 6.0 * ((values.row(j + 1) - values.row(j)) / step(j) -
                        (values.row(j) - values.row(j - 1)) / step(j - 1));
  }
  // Not-a-knot: the third derivative does not jump at the second (last but one) sample.
  const auto not_a_knot = [&](Eigen::Index row, Eigen::Index j) {
    matrix(row, j - 1) = step(j);
    matrix(row, j) = -(step(j - 1) + step(j));
    matrix(row, j + 1) = step(j - 1);
  };
  not_a_knot(n - 1, n - 2);
  if (first == End::not_a_knot) {
    not_a_knot(0, 1);
  } else if (first == End::natural) {
    matrix(0, 0) = 1.0;
  } else {
    matrix(0, 0) = 2.0 * step(0);
    matrix(0, 1) = step(0);
    rhs.row(0) = 6.0 * (values.row(1) - values.row(0)) / step(0);
  }
  return matrix.partialPivLu().solve(rhs);
}

}  // namespace

AerodynamicTable::AerodynamicTable(std::vector<double> k, std::vector<Eigen::MatrixXcd> q)
    : k_(std::move(k)), q_(std::move(q)) {
  check(k_, q_);
  const auto n = static_cast<Eigen::Index>(k_.size());
  const Eigen::Index m = size();
  Eigen::MatrixXcd values(n, m * m);
  for (Eigen::Index j = 0; j < n; ++j)
    values.row(j) = Eigen::Map<const Eigen::RowVectorXcd>(q_[static_cast<std::size_t>(j)].data(), m * m);
  const bool from_zero = k_.front() == 0.0;
  Eigen::MatrixXcd curvature(n, m * m);
  curvature.real() = spline_curvature(k_, values.real(), from_zero ? End::clamped : End::not_a_knot);
  curvature.imag() = spline_curvature(k_, values.imag(), from_zero ? End::natural : End::not_a_knot);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::RowVectorXcd row = curvature.row(j);
    curvature_.emplace_back(Eigen::Map<const Eigen::MatrixXcd>(row.data(), m, m));
  }
}

std::size_t AerodynamicTable::interval(double k) const {
  ensure(k >= k_min() && k <= k_max(),
         fmt::format("k = {} is outside the aerodynamic table, {} to {}", k, k_min(), k_max()));
  const auto above = std::upper_bound(k_.begin() + 1, k_.end() - 1, k);
  return static_cast<std::size_t>(above - k_.begin()) - 1;
}

Eigen::MatrixXcd AerodynamicTable::operator()(double k) const {
  const std::size_t j = interval(k);
  const double h = k_[j + 1] - k_[j];
  const double t = (k - k_[j]) / h;
  const double s = 1.0 - t;
  return s * q_[j] + t * q_[j + 1] +
         (h * h / 6.0) * ((s * s * s - s) * curvature_[j] + (t * t * t - t) * curvature_[j + 1]);
}

Eigen::MatrixXcd AerodynamicTable::derivative(double k) const {
  const std::size_t j = interval(k);
  const double h = k_[j + 1] - k_[j];
  const double t = (k - k_[j]) / h;
  const double s = 1.0 - t;
  return (q_[j + 1] - q_[j]) / h +
         (h / 6.0) * ((1.0 - 3.0 * s * s) * curvature_[j] + (3.0 * t * t - 1.0) * curvature_[j + 1]);
}

AerodynamicTable tabulate(const AerodynamicMatrix& q, std::span<const double> k) {
  std::vector<Eigen::MatrixXcd> samples;
  for (const double frequency : k) samples.push_back(q(frequency));
  return {{k.begin(), k.end()}, std::move(samples)};
}

AerodynamicTable with_samples(const AerodynamicTable& table, const AerodynamicMatrix& q,
                              std::span<const double> k) {
  std::map<double, Eigen::MatrixXcd> samples;
  for (std::size_t j = 0; j < table.sampled_k().size(); ++j)
    samples.emplace(table.sampled_k()[j], table.samples()[j]);
  for (const double frequency : k) samples.emplace(frequency, q(frequency));
  std::vector<double> sorted_k;
  std::vector<Eigen::MatrixXcd> sorted_q;
  for (const auto& [frequency, sample] : samples) {
    sorted_k.push_back(frequency);
    sorted_q.push_back(sample);
  }
  return {std::move(sorted_k), std::move(sorted_q)};
}

std::vector<double> spread_reduced_frequencies(double k_min, double k_max, int count) {
  if (!(k_min >= 0.0) || !(k_max > k_min) || !std::isfinite(k_max) || count < 4)
    throw InputError(
        fmt::format("reduced frequencies from {} to {}, {} of them: must be 0 <= first < last, "
                    "at least 4",
                    k_min, k_max, count));
  std::vector<double> k;
  for (int j = 0; j < count; ++j) {
    const double t = static_cast<double>(j) / (count - 1);
    k.push_back(k_min + (k_max - k_min) * t * t);
  }
  k.back() = k_max;
  return k;
}

}  // namespace wingbeat
