#include "structure/aeroelastic_linearization.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

void add(double scale, std::span<const double> x, std::span<double> y) {
  if (scale == 0.0) return;
  for (std::size_t i = 0; i < x.size(); ++i) y[i] += scale * x[i];
}

double dot(std::span<const double> x, std::span<const double> y) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

std::array<double, 3> components(const MotionState& m) { return {m.pitch, m.pitch_rate, m.plunge_rate}; }

}  // namespace

template <int Dim>
void AeroelasticLinearization<Dim>::add_flow_by_tail(std::span<const double> t, std::span<double> yw) const {
  const std::size_t count = flow->domain().state_count();
  for (std::size_t n = 0; n < instances(); ++n) {
    const auto change = components(kinematics.motion_change(t.subspan(4 * n, 4), r));
    for (std::size_t k = 0; k < 3; ++k)
      add(change[k], flow->motion_gradients(n)[k], yw.subspan(n * count, count));
  }
  if (!is_periodic) return;
  add(t[4 * instances()], flow_by_omega, yw);
  add(t[4 * instances() + 1], flow_by_r, yw);
}

template <int Dim>
std::vector<double> AeroelasticLinearization<Dim>::flow_by_tail_adjoint(std::span<const double> xw) const {
  const std::size_t count = flow->domain().state_count();
  std::vector<double> t(tail_size(), 0.0);
  for (std::size_t n = 0; n < instances(); ++n) {
    const auto x = xw.subspan(n * count, count);
    const auto& columns = flow->motion_gradients(n);
    kinematics.add_motion_adjoint({dot(columns[0], x), dot(columns[1], x), dot(columns[2], x)}, r,
                                  std::span<double>(t).subspan(4 * n, 4));
  }
  if (is_periodic) {
    t[4 * instances()] = dot(flow_by_omega, xw);
    t[4 * instances() + 1] = dot(flow_by_r, xw);
  }
  flow->domain().comm().sum(t);
  return t;
}

template <int Dim>
Eigen::VectorXd AeroelasticLinearization<Dim>::forces_by_flow(std::span<const double> xw) const {
  const std::size_t count = flow->domain().state_count();
  std::vector<double> f;
  for (std::size_t n = 0; n < instances(); ++n) {
    const auto x = xw.subspan(n * count, count);
    f.push_back(-dot(flow->load_gradients(n).force_y, x));
    f.push_back(2.0 * dot(flow->load_gradients(n).moment, x));
  }
  flow->domain().comm().sum(f);
  return Eigen::Map<Eigen::VectorXd>(f.data(), static_cast<Eigen::Index>(f.size()));
}

template <int Dim>
void AeroelasticLinearization<Dim>::add_forces_by_flow_adjoint(const Eigen::VectorXd& f,
                                                               std::span<double> yw) const {
  const std::size_t count = flow->domain().state_count();
  for (std::size_t n = 0; n < instances(); ++n) {
    const auto y = yw.subspan(n * count, count);
    add(-f[static_cast<Eigen::Index>(2 * n)], flow->load_gradients(n).force_y, y);
    add(2.0 * f[static_cast<Eigen::Index>(2 * n + 1)], flow->load_gradients(n).moment, y);
  }
}

std::vector<double> broadcast_tail(const Comm& comm, std::span<const double> x, std::size_t flow_size,
                                   std::size_t tail_size) {
  std::vector<double> tail(tail_size);
  if (comm.is_root())
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(flow_size), tail_size, tail.begin());
  comm.broadcast(tail);
  return tail;
}

template <int Dim>
std::size_t AeroelasticJacobian<Dim>::local_size() const {
  return at_.flow->state_count() + (at_.flow->domain().comm().is_root() ? at_.tail_size() : 0);
}

template <int Dim>
void AeroelasticJacobian<Dim>::apply(std::span<const double> x, std::span<double> y) const {
  const std::size_t flow_size = at_.flow->state_count(), tail_size = at_.tail_size();
  const Comm& comm = at_.flow->domain().comm();
  const std::vector<double> t = broadcast_tail(comm, x, flow_size, tail_size);
  const auto xw = x.first(flow_size);
  at_.flow->apply(xw, y.first(flow_size));
  at_.add_flow_by_tail(t, y.first(flow_size));
  const Eigen::VectorXd forces = at_.forces_by_flow(xw);
  if (!comm.is_root()) return;
  const auto n = static_cast<Eigen::Index>(tail_size);
  Eigen::Map<Eigen::VectorXd>(y.data() + flow_size, n) =
      at_.tail * Eigen::Map<const Eigen::VectorXd>(t.data(), n) + at_.by_force * forces;
}

template <int Dim>
void AeroelasticJacobian<Dim>::apply_transpose(std::span<const double> x, std::span<double> y) const {
  const std::size_t flow_size = at_.flow->state_count(), tail_size = at_.tail_size();
  const Comm& comm = at_.flow->domain().comm();
  const std::vector<double> t = broadcast_tail(comm, x, flow_size, tail_size);
  const auto n = static_cast<Eigen::Index>(tail_size);
  const Eigen::Map<const Eigen::VectorXd> multipliers(t.data(), n);
  const auto xw = x.first(flow_size);
  at_.flow->apply_transpose(xw, y.first(flow_size));
  at_.add_forces_by_flow_adjoint(at_.by_force.transpose() * multipliers, y.first(flow_size));
  const std::vector<double> from_flow = at_.flow_by_tail_adjoint(xw);
  if (!comm.is_root()) return;
  Eigen::Map<Eigen::VectorXd>(y.data() + flow_size, n) =
      at_.tail.transpose() * multipliers + Eigen::Map<const Eigen::VectorXd>(from_flow.data(), n);
}

template struct AeroelasticLinearization<2>;
template struct AeroelasticLinearization<3>;
template class AeroelasticJacobian<2>;
template class AeroelasticJacobian<3>;

}  // namespace wingbeat
