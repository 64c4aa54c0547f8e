#pragma once

#include <Eigen/Dense>
#include <functional>
#include <span>
#include <vector>

namespace wingbeat {

// Q(k): harmonic generalised forces f = Q u_hat e^{i omega t} at reduced frequency k = omega/(2V), m x m.
using AerodynamicMatrix = std::function<Eigen::MatrixXcd(double k)>;

// Q(k) between samples, by a cubic spline in k (fourth order where Q is smooth). Q(-k) is the
// conjugate of Q(k); a sample at k = 0 makes the spline obey that there: the real part is even, the
// imaginary part odd. Other ends are not-a-knot.
class AerodynamicTable {
 public:
  // At least four samples, k >= 0 strictly increasing, square matrices of one size; otherwise InputError.
  AerodynamicTable(std::vector<double> k, std::vector<Eigen::MatrixXcd> q);

  double k_min() const { return k_.front(); }
  double k_max() const { return k_.back(); }
  int size() const { return static_cast<int>(q_.front().rows()); }
  std::span<const double> sampled_k() const { return k_; }
  std::span<const Eigen::MatrixXcd> samples() const { return q_; }

  // Q and dQ/dk at k_min <= k <= k_max; the table does not extrapolate.
  Eigen::MatrixXcd operator()(double k) const;
  Eigen::MatrixXcd derivative(double k) const;

 private:
  std::size_t interval(double k) const;

  std::vector<double> k_;
  std::vector<Eigen::MatrixXcd> q_;
  std::vector<Eigen::MatrixXcd> curvature_;  // second derivatives at the samples
};

// Evaluates q at every k, in the order given.
AerodynamicTable tabulate(const AerodynamicMatrix& q, std::span<const double> k);

// The table with q evaluated at more k, none of which is among the samples.
AerodynamicTable with_samples(const AerodynamicTable& table, const AerodynamicMatrix& q,
                              std::span<const double> k);

// `count` reduced frequencies from k_min to k_max, dense at the lower end, where the wake bends Q most.
std::vector<double> spread_reduced_frequencies(double k_min, double k_max, int count);

}  // namespace wingbeat
