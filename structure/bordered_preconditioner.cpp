#include "structure/bordered_preconditioner.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

using Complex = std::complex<double>;

Complex dot(std::span<const double> x, std::span<const Complex> y) {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

double weight(const TimeSpectral& time, int h) { return (h == 0 ? 1.0 : 2.0) / time.instances(); }

}  // namespace

template <int Dim>
BorderedPreconditioner<Dim>::BorderedPreconditioner(const AeroelasticLinearization<Dim>& at,
                                                    const HarmonicPreconditioner<Dim>& harmonic)
    : at_(at), harmonic_(harmonic), flow_preconditioner_(&harmonic) {}

template <int Dim>
std::size_t BorderedPreconditioner<Dim>::local_size() const {
  return at_.flow->state_count() + (at_.flow->domain().comm().is_root() ? at_.tail_size() : 0);
}

template <int Dim>
void BorderedPreconditioner<Dim>::build_responses() {
  const std::size_t count = at_.flow->domain().state_count();
  responses_.clear();
  for (int h = 0; h <= time().harmonics(); ++h)
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<double> mean(count, 0.0);
      for (std::size_t n = 0; n < at_.instances(); ++n)
        for (std::size_t i = 0; i < count; ++i)
          mean[i] += at_.flow->motion_gradients(n)[k][i] / static_cast<double>(at_.instances());
      responses_.push_back(harmonic_.solve_harmonic(h, mean));
    }
  if (!at_.is_periodic) return;
  by_omega_.resize(at_.flow->state_count());
  by_r_.resize(at_.flow->state_count());
  harmonic_.apply(at_.flow_by_omega, by_omega_);
  harmonic_.apply(at_.flow_by_r, by_r_);
}

template <int Dim>
void BorderedPreconditioner<Dim>::subtract_x(std::span<const double> t, std::span<double> yw) const {
  const std::size_t count = at_.flow->domain().state_count(), instances = at_.instances();
  std::vector<double> motions;
  for (std::size_t n = 0; n < instances; ++n) {
    const MotionState m = at_.kinematics.motion_change(t.subspan(4 * n, 4), at_.r);
    motions.insert(motions.end(), {m.pitch, m.pitch_rate, m.plunge_rate});
  }
  const std::vector<Complex> harmonics = time().harmonics_of(motions);
  std::vector<Complex> states(count * static_cast<std::size_t>(time().harmonics() + 1));
  for (int h = 0; h <= time().harmonics(); ++h)
    for (int k = 0; k < 3; ++k) {
      const Complex amplitude = harmonics[static_cast<std::size_t>(3 * h + k)];
      const auto column = response(h, k);
      Complex* out = states.data() + static_cast<std::size_t>(h) * count;
      for (std::size_t i = 0; i < count; ++i) out[i] += amplitude * column[i];
    }
  const std::vector<double> change = time().instances_of(states);
  for (std::size_t i = 0; i < change.size(); ++i) yw[i] -= change[i];
  if (!at_.is_periodic) return;
  const double omega = t[4 * instances], r = t[4 * instances + 1];
  for (std::size_t i = 0; i < yw.size(); ++i) yw[i] -= omega * by_omega_[i] + r * by_r_[i];
}

template <int Dim>
std::vector<double> BorderedPreconditioner<Dim>::x_adjoint(std::span<const double> xw) const {
  const std::size_t count = at_.flow->domain().state_count(), instances = at_.instances();
  const int harmonics = time().harmonics();
  std::vector<Complex> sums(static_cast<std::size_t>(3 * (harmonics + 1)));
  for (int h = 0; h <= harmonics; ++h)
    for (int k = 0; k < 3; ++k)
      for (std::size_t n = 0; n < instances; ++n)
        sums[static_cast<std::size_t>(3 * h + k)] += weight(time(), h) *
                                                     std::polar(1.0, h * time().phase(static_cast<int>(n))) *
                                                     dot(xw.subspan(n * count, count), response(h, k));
  std::vector<double> t(at_.tail_size(), 0.0);
  if (at_.is_periodic)
    for (std::size_t i = 0; i < xw.size(); ++i) {
      t[4 * instances] += by_omega_[i] * xw[i];
      t[4 * instances + 1] += by_r_[i] * xw[i];
    }
  at_.flow->domain().comm().sum(t);
  at_.flow->domain().comm().sum(sums);
  for (std::size_t m = 0; m < instances; ++m) {
    std::array<double, 3> motion{};
    for (int h = 0; h <= harmonics; ++h)
      for (std::size_t k = 0; k < 3; ++k)
        motion[k] += (sums[3 * static_cast<std::size_t>(h) + k] *
                      std::polar(1.0, -h * time().phase(static_cast<int>(m))))
                         .real();
    at_.kinematics.add_motion_adjoint({motion[0], motion[1], motion[2]}, at_.r,
                                      std::span<double>(t).subspan(4 * m, 4));
  }
  return t;
}

template <int Dim>
Eigen::MatrixXd BorderedPreconditioner<Dim>::forces_by_tail() const {
  const auto instances = static_cast<int>(at_.instances());
  const int harmonics = time().harmonics();
  // Loads of instance n in response h, k: (-C_l, 2 C_m).
  std::vector<Complex> loads;
  for (int n = 0; n < instances; ++n)
    for (int h = 0; h <= harmonics; ++h)
      for (int k = 0; k < 3; ++k) {
        const auto& gradients = at_.flow->load_gradients(static_cast<std::size_t>(n));
        loads.push_back(-dot(gradients.force_y, response(h, k)));
        loads.push_back(2.0 * dot(gradients.moment, response(h, k)));
      }
  at_.flow->domain().comm().sum(loads);

  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(2 * instances, static_cast<Eigen::Index>(at_.tail_size()));
  for (int m = 0; m < instances; ++m)
    for (int j = 0; j < 4; ++j) {
      std::array<double, 4> unit{};
      unit[static_cast<std::size_t>(j)] = 1.0;
      const MotionState change = at_.kinematics.motion_change(unit, at_.r);
      const std::array<double, 3> motion{change.pitch, change.pitch_rate, change.plunge_rate};
      for (int n = 0; n < instances; ++n)
        for (int h = 0; h <= harmonics; ++h) {
          const Complex turn = weight(time(), h) * std::polar(1.0, h * (time().phase(n) - time().phase(m)));
          for (int k = 0; k < 3; ++k)
            for (int load = 0; load < 2; ++load) {
              const auto at = static_cast<std::size_t>(((n * (harmonics + 1) + h) * 3 + k) * 2 + load);
              forces(2 * n + load, 4 * m + j) +=
                  motion[static_cast<std::size_t>(k)] * (turn * loads[at]).real();
            }
        }
    }
  if (at_.is_periodic) {
    forces.col(4 * instances) = at_.forces_by_flow(by_omega_);
    forces.col(4 * instances + 1) = at_.forces_by_flow(by_r_);
  }
  return forces;
}

template <int Dim>
void BorderedPreconditioner<Dim>::update_schur() {
  schur_.compute(at_.tail - at_.by_force * forces_by_tail());
}

template <int Dim>
void BorderedPreconditioner<Dim>::apply(std::span<const double> x, std::span<double> y) const {
  const std::size_t flow_size = at_.flow->state_count(), tail_size = at_.tail_size();
  const Comm& comm = at_.flow->domain().comm();
  const auto yw = y.first(flow_size);
  flow_preconditioner_->apply(x.first(flow_size), yw);
  const Eigen::VectorXd forces = at_.forces_by_flow(yw);
  std::vector<double> t = broadcast_tail(comm, x, flow_size, tail_size);
  Eigen::Map<Eigen::VectorXd> tail(t.data(), static_cast<Eigen::Index>(tail_size));
  tail = schur_.solve(tail - at_.by_force * forces).eval();
  subtract_x(t, yw);
  if (comm.is_root()) std::copy(t.begin(), t.end(), y.begin() + static_cast<std::ptrdiff_t>(flow_size));
}

template <int Dim>
void BorderedPreconditioner<Dim>::apply_transpose(std::span<const double> x, std::span<double> y) const {
  const std::size_t flow_size = at_.flow->state_count(), tail_size = at_.tail_size();
  const Comm& comm = at_.flow->domain().comm();
  const auto xw = x.first(flow_size);
  std::vector<double> t = broadcast_tail(comm, x, flow_size, tail_size);
  const std::vector<double> from_flow = x_adjoint(xw);
  for (std::size_t i = 0; i < t.size(); ++i) t[i] -= from_flow[i];
  Eigen::Map<Eigen::VectorXd> tail(t.data(), static_cast<Eigen::Index>(tail_size));
  tail = schur_.transpose().solve(tail).eval();
  std::vector<double> rhs(xw.begin(), xw.end());
  at_.add_forces_by_flow_adjoint(-(at_.by_force.transpose() * tail), rhs);
  flow_preconditioner_->apply_transpose(rhs, y.first(flow_size));
  if (comm.is_root()) std::copy(t.begin(), t.end(), y.begin() + static_cast<std::ptrdiff_t>(flow_size));
}

template class BorderedPreconditioner<2>;
template class BorderedPreconditioner<3>;

}  // namespace wingbeat
