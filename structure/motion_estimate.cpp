#include "structure/motion_estimate.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

constexpr int max_iterations = 60;
// Modes with less of the energy than this share take no part in a motion.
constexpr double least_share = 0.01;

// The record as rows of states whose squares add up to twice their energy.
Eigen::MatrixXd weighed_rows(const StructureModel& model, const MotionRecord& record) {
  const int m = model.size();
  const auto width = static_cast<std::size_t>(2 * m);
  ensure(!record.y.empty() && record.y.size() % width == 0, "motion record of the wrong size");
  const Eigen::Map<const Eigen::MatrixXd> states(record.y.data(), 2 * m,
                                                 static_cast<Eigen::Index>(record.y.size() / width));
  const auto root = [](const Eigen::MatrixXd& matrix) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).operatorSqrt();
  };
  Eigen::MatrixXd rows(states.cols(), 2 * m);
  rows.leftCols(m) = states.topRows(m).transpose() * root(model.stiffness);
  rows.rightCols(m) = states.bottomRows(m).transpose() * root(model.mass);
  return rows;
}

// Rates and frequencies (sigma_1, omega_1, ...) to start from: exponents of the linear map that takes the
// motion best from one time to another a good part of a radian later. Fewer than asked where the motion
// does not oscillate in so many ways.
std::vector<double> starting_exponents(const Eigen::MatrixXd& rows, double dtau, int modes) {
  constexpr double lag_time = 0.6;
  const Eigen::Index n = rows.rows(), width = rows.cols();
  const auto lag =
      std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::lround(lag_time / dtau)), 1, n / 3);
  Eigen::MatrixXd from(n - lag, width + 1);
  from << rows.topRows(n - lag), Eigen::VectorXd::Constant(n - lag, rows.norm() / std::sqrt(double(n)));
  const Eigen::MatrixXd map = from.colPivHouseholderQr().solve(rows.bottomRows(n - lag)).topRows(width);
  const Eigen::VectorXcd multipliers = map.eigenvalues();
  std::vector<std::complex<double>> exponents;
  for (const std::complex<double>& multiplier : multipliers)
    if (multiplier.imag() > 1e-6 * std::abs(multiplier))
      exponents.push_back(std::log(multiplier) / (static_cast<double>(lag) * dtau));
  std::ranges::sort(exponents, std::greater(), [](const std::complex<double>& p) { return p.real(); });
  std::vector<double> result;
  for (std::size_t j = 0; j < std::min(exponents.size(), static_cast<std::size_t>(modes)); ++j)
    result.insert(result.end(), {exponents[j].real(), exponents[j].imag()});
  return result;
}

// The fit at given exponents, amplitudes eliminated (variable projection, G. H. Golub and V. Pereyra
// 1973, doi:10.1137/0710036), and its derivatives in Kaufman's simpler form.
struct Projection {
  Eigen::MatrixXd residual;                // rows less the fit
  Eigen::MatrixXd amplitudes;              // of the columns 1, e cos, e sin, ...
  std::vector<Eigen::MatrixXd> gradients;  // of the residual by the exponents
};

Projection project(const Eigen::MatrixXd& rows, const Eigen::VectorXd& times,
                   const std::vector<double>& exponents) {
  const auto count = static_cast<Eigen::Index>(exponents.size());
  Eigen::MatrixXd basis(rows.rows(), 1 + count);
  basis.col(0).setOnes();
  for (Eigen::Index j = 0; j < count; j += 2) {
    const Eigen::ArrayXd envelope = (exponents[static_cast<std::size_t>(j)] * times).array().exp();
    const Eigen::ArrayXd phase = exponents[static_cast<std::size_t>(j + 1)] * times.array();
    basis.col(1 + j) = envelope * phase.cos();
    basis.col(2 + j) = envelope * phase.sin();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(rows.rows(), 1 + count);
  const auto beyond = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
    return x - q * (q.transpose() * x);
  };
  Projection result;
  result.amplitudes = qr.solve(rows);
  result.residual = beyond(rows);
  for (Eigen::Index j = 0; j < count; j += 2) {
    const Eigen::MatrixXd moved = times.asDiagonal() * basis.middleCols(1 + j, 2);
    const Eigen::MatrixXd own = result.amplitudes.middleRows(1 + j, 2);
    Eigen::MatrixXd turned(2, own.cols());  // d/d omega: cos -> -t sin, sin -> t cos
    turned << own.row(1), -own.row(0);
    result.gradients.push_back(-beyond(moved * own));
    result.gradients.push_back(-beyond(moved * turned));
  }
  return result;
}

struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

NormalEquations normal_equations(const Projection& at) {
  const auto count = static_cast<Eigen::Index>(at.gradients.size());
  NormalEquations result{Eigen::MatrixXd(count, count), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::MatrixXd& gradient = at.gradients[static_cast<std::size_t>(i)];
    result.right[i] = -gradient.cwiseProduct(at.residual).sum();
    for (Eigen::Index j = 0; j <= i; ++j)
      result.matrix(i, j) = result.matrix(j, i) =
          gradient.cwiseProduct(at.gradients[static_cast<std::size_t>(j)]).sum();
  }
  return result;
}

// Levenberg's and Marquardt's steps until the exponents settle.
Projection settle(const Eigen::MatrixXd& rows, const Eigen::VectorXd& times, std::vector<double>& exponents) {
  Projection at = project(rows, times, exponents);
  double damping = 1e-6;
  for (int i = 0; i < max_iterations; ++i) {
    const NormalEquations normal = normal_equations(at);
    Eigen::MatrixXd damped = normal.matrix;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd change = damped.ldlt().solve(normal.right);
    if (!change.allFinite()) break;
    std::vector<double> tried = exponents;
    for (std::size_t j = 0; j < tried.size(); ++j) tried[j] += change[static_cast<Eigen::Index>(j)];
    Projection next = project(rows, times, tried);
    const bool is_better = next.residual.squaredNorm() <= at.residual.squaredNorm();
    damping = is_better ? 0.1 * damping : 10.0 * damping;
    if (is_better) {
      at = std::move(next);
      exponents = std::move(tried);
    }
    if (change.norm() < 1e-12 || damping > 1e12) break;
  }
  return at;
}

// By how much the correlation of the residual in time widens errors: the square root of
// 1 + 2 sum of its autocorrelations up to the first that is negative.
double correlation_factor(const Eigen::MatrixXd& residual) {
  const double power = residual.squaredNorm();
  if (!(power > 0.0)) return 1.0;
  double sum = 1.0;
  const Eigen::Index n = residual.rows();
  for (Eigen::Index lag = 1; lag < n / 2; ++lag) {
    const double correlation =
        residual.topRows(n - lag).cwiseProduct(residual.bottomRows(n - lag)).sum() / power;
    if (correlation < 0.0) break;
    sum += 2.0 * correlation;
  }
  return std::sqrt(sum);
}

const DampedMode& least_stable(const ModalFit& fit) {
  double largest = 0.0;
  for (const DampedMode& mode : fit.modes) largest = std::max(largest, mode.energy);
  const DampedMode* found = &fit.modes.front();
  double rate = -std::numeric_limits<double>::infinity();
  for (const DampedMode& mode : fit.modes)
    if (mode.energy >= least_share * largest && mode.rate > rate) {
      found = &mode;
      rate = mode.rate;
    }
  return *found;
}

}  // namespace

std::optional<ModalFit> fit_damped_modes(const StructureModel& model, const MotionRecord& record, int modes) {
  const Eigen::MatrixXd rows = weighed_rows(model, record);
  const Eigen::Index n = rows.rows();
  if (n < 8 * (modes + 1) || !rows.allFinite()) return std::nullopt;
  std::vector<double> exponents = starting_exponents(rows, record.dtau, modes);
  if (exponents.size() != static_cast<std::size_t>(2 * modes)) return std::nullopt;
  const double half = 0.5 * record.dtau * static_cast<double>(n - 1);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(n, -half, half);
  const Projection fit = settle(rows, times, exponents);
  const NormalEquations normal = normal_equations(fit);
  const Eigen::MatrixXd covariance = normal.matrix.inverse();
  const auto freedom = static_cast<double>(rows.size() - fit.amplitudes.size()) - 2.0 * modes;
  const double deviation = std::sqrt(fit.residual.squaredNorm() / freedom) * correlation_factor(fit.residual);

  ModalFit result;
  result.residual = fit.residual.norm() / (rows.rowwise() - rows.colwise().mean()).norm();
  for (int j = 0; j < modes; ++j) {
    const auto at = static_cast<std::size_t>(2 * j);
    DampedMode mode;
    mode.rate = exponents[at];
    mode.frequency = std::abs(exponents[at + 1]);
    mode.rate_error = deviation * std::sqrt(covariance(2 * j, 2 * j));
    mode.frequency_error = deviation * std::sqrt(covariance(2 * j + 1, 2 * j + 1));
    mode.energy =
        0.25 * std::exp(2.0 * mode.rate * half) * fit.amplitudes.middleRows(1 + 2 * j, 2).squaredNorm();
    if (!std::isfinite(mode.rate_error + mode.frequency_error + mode.energy)) return std::nullopt;
    result.modes.push_back(mode);
  }
  return result;
}

std::optional<GrowthEstimate> estimate_growth(const StructureModel& model, const MotionRecord& record) {
  const auto width = static_cast<std::size_t>(2 * model.size());
  const std::size_t samples = record.y.size() / width;
  const MotionRecord later{record.y.subspan(samples / 2 * width), record.dtau};
  std::optional<GrowthEstimate> best;
  for (int modes = 1; modes <= model.size(); ++modes) {
    const auto whole = fit_damped_modes(model, record, modes), end = fit_damped_modes(model, later, modes);
    if (!whole || !end) continue;
    const DampedMode &a = least_stable(*whole), &b = least_stable(*end);
    const GrowthEstimate found{a.rate, std::hypot(a.rate_error, b.rate - a.rate), a.frequency,
                               std::hypot(a.frequency_error, b.frequency - a.frequency)};
    if (!best || found.rate_error < best->rate_error) best = found;
  }
  return best;
}

}  // namespace wingbeat
