#include "structure/time_marching.hpp"

#include <algorithm>
#include <cmath>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// Forces of this many steps are extrapolated to the next.
constexpr std::size_t predicted_from = 3;
// Smaller changes of y, in tolerances, carry too much of the flow's own error to learn from.
constexpr double least_lesson = 10.0;
constexpr double round_off = 1e-14;

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a);
  for (std::size_t i = 0; i < a.size(); ++i) result[i] -= b[i];
  return result;
}

template <class Level>
void keep_newest(std::vector<Level>& levels, Level newest, std::size_t count) {
  levels.insert(levels.begin(), std::move(newest));
  if (levels.size() > count) levels.resize(count);
}

}  // namespace

TimeMarching::TimeMarching(StructureModel model, double load, double dtau, UnsteadyLoads& flow,
                           const TimeMarchingOptions& options)
    : structure_(std::move(model), TimeSpectral(0)),
      load_(load),
      dtau_(dtau),
      flow_(flow),
      options_(options) {
  ensure(dtau > 0.0, "time steps are positive");
  const int m = structure_.modes();
  weight_ = Eigen::MatrixXd::Zero(2 * m, 2 * m);
  weight_.topLeftCorner(m, m) = structure_.model().stiffness;
  weight_.bottomRightCorner(m, m) = structure_.model().mass;
  memory_.response = Eigen::MatrixXd::Zero(m, 2 * m);
}

void TimeMarching::start(std::vector<std::vector<double>> history) {
  ensure(!history.empty(), "a march needs a state to start from");
  for (const auto& level : history)
    ensure(level.size() == structure_.state_size(), "structural state of the wrong size");
  history_ = std::move(history);
  memory_.forces.clear();
  memory_.response.setZero();
}

TimeStepResult TimeMarching::step() {
  const int order = std::min(options_.order, static_cast<int>(history_.size()));
  const BackwardDifference formula(order);
  const std::size_t width = structure_.state_size();
  std::vector<double> past(width, 0.0);
  for (std::size_t k = 1; k <= static_cast<std::size_t>(order); ++k)
    for (std::size_t j = 0; j < width; ++j) past[j] += formula.c[k] * history_[k - 1][j];

  flow_.begin(dtau_);
  std::vector<double> y = history_.front();
  if (!memory_.forces.empty()) {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(structure_.modes());
    const std::vector<double> weights = extrapolation_weights(static_cast<int>(memory_.forces.size()));
    for (std::size_t k = 0; k < memory_.forces.size(); ++k) f += weights[k] * memory_.forces[k];
    const Eigen::MatrixXd learnt = memory_.response;
    memory_.response.setZero();
    y = implicit_step(past, formula.c[0], f, y).value_or(y);
    memory_.response = learnt;
  }

  TimeStepResult result;
  std::vector<double> dy;
  Eigen::VectorXd last;
  for (int i = 1; i <= options_.max_iterations; ++i) {
    Eigen::VectorXd f(structure_.modes());
    result.iterations = i;
    const SolveStatus status = flow_.forces(y, {f.data(), static_cast<std::size_t>(f.size())});
    if (status != SolveStatus::converged) {
      result.status = status;
      return result;
    }
    const double travel = norm(difference(y, history_.front()));
    const double least = options_.tolerance * travel;
    if (i > 1 && norm(dy) > least_lesson * least) learn_response(dy, f - last);
    if (!f.allFinite()) {
      result.status = SolveStatus::diverged;
      return result;
    }
    std::optional<std::vector<double>> solved = implicit_step(past, formula.c[0], f, y);
    if (!solved) {
      result.status = SolveStatus::stalled;
      return result;
    }
    std::vector<double> next = *std::move(solved);
    dy = difference(next, y);
    const double change = norm(dy);
    result.change = travel > 0.0 ? change / travel : change;
    if (change <= std::max(least, round_off * norm(next))) {
      flow_.accept();
      keep_newest(history_, std::move(next), static_cast<std::size_t>(options_.order) + 1);
      keep_newest(memory_.forces, std::move(f), predicted_from);
      result.status = SolveStatus::converged;
      return result;
    }
    y = std::move(next);
    last = std::move(f);
  }
  return result;
}

std::optional<std::vector<double>> TimeMarching::implicit_step(const std::vector<double>& past, double c0,
                                                               const Eigen::VectorXd& f,
                                                               const std::vector<double>& about) const {
  constexpr int max_newton = 20;
  // Steps that round-off alone still makes are shorter than this, relative to y.
  constexpr double settled = 1e-10;
  const auto width = static_cast<Eigen::Index>(about.size());
  const auto map = [width](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), width);
  };
  std::vector<double> y = about, s(about.size());
  bool is_settled = false;
  for (int i = 0; i < max_newton; ++i) {
    const Eigen::VectorXd now = f + memory_.response * (map(y) - map(about));
    structure_.residual(y, 0.0, load_, {now.data(), static_cast<std::size_t>(now.size())}, s);
    const Eigen::VectorXd rows = map(s) + (c0 * map(y) + map(past)) / dtau_;
    Eigen::MatrixXd jacobian = structure_.state_jacobian(y, 0.0);
    jacobian.diagonal().array() += c0 / dtau_;
    for (Eigen::Index j = 0; j < width; ++j) {
      const Eigen::VectorXd column = memory_.response.col(j);
      structure_.add_force_tangent(load_, {column.data(), static_cast<std::size_t>(column.size())}, 1.0,
                                   {jacobian.col(j).data(), about.size()});
    }
    const Eigen::VectorXd dy = -jacobian.partialPivLu().solve(rows);
    Eigen::Map<Eigen::VectorXd>(y.data(), width) += dy;
    is_settled = dy.norm() <= settled * map(y).norm();
    if (dy.norm() <= round_off * map(y).norm()) break;
  }
  if (!is_settled) return std::nullopt;
  return y;
}

// The smallest change of J, in the norm of energy, that makes J dy = df.
void TimeMarching::learn_response(const std::vector<double>& dy, const Eigen::VectorXd& df) {
  const Eigen::Map<const Eigen::VectorXd> step(dy.data(), static_cast<Eigen::Index>(dy.size()));
  const Eigen::VectorXd weighted = weight_ * step;
  memory_.response += (df - memory_.response * step) * weighted.transpose() / step.dot(weighted);
}

double TimeMarching::norm(const std::vector<double>& dy) const {
  const Eigen::Map<const Eigen::VectorXd> step(dy.data(), static_cast<Eigen::Index>(dy.size()));
  return std::sqrt(step.dot(weight_ * step));
}

}  // namespace wingbeat
