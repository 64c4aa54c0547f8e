#include "flow/flow_equations.hpp"

#include <algorithm>
#include <cmath>

#include "flow/cell_vector.hpp"

namespace wingbeat {
namespace {

template <int Dim>
FlowModel<Dim, Dual<double, 3>> lifted(const FlowModel<Dim, double>& model) {
  const auto& f = model.freestream;
  return {{f.gamma, f.mach, f.angle_cosine, f.angle_sine}, model.scheme};
}

}  // namespace

template <int Dim>
FlowEquations<Dim>::FlowEquations(const FlowDomain<Dim>& domain, const FlowModel<Dim, double>& model,
                                  const TimeSpectral& time)
    : domain_(domain),
      model_(model),
      time_(time),
      balance_(domain, model),
      walls_(domain, model),
      ghosts_(instance_count() * static_cast<std::size_t>(domain.ghost_count()) * n) {}

template <int Dim>
std::vector<double> FlowEquations<Dim>::uniform_state() const {
  const State<Dim, double> freestream = model_.freestream.state();
  std::vector<double> w(state_count());
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = freestream[static_cast<int>(i % n)];
  return w;
}

template <int Dim>
double FlowEquations<Dim>::uniform_residual() {
  const std::vector<MotionState> at_rest(instance_count());
  std::vector<double> r(state_count());
  residual(uniform_state(), at_rest, 0.0, r);
  double sum = 0.0;
  for (double value : r) sum += value * value;
  return std::sqrt(domain_.comm().sum(sum));
}

template <int Dim>
void FlowEquations<Dim>::fetch_ghosts(std::span<const double> w) const {
  domain_.exchange().template gather<double>(w, ghosts_, time_.instances(), n);
}

template <int Dim>
std::span<const double> FlowEquations<Dim>::ghosts_of(std::size_t instance) const {
  const std::size_t count = static_cast<std::size_t>(domain_.ghost_count()) * n;
  return std::span<const double>(ghosts_).subspan(instance * count, count);
}

template <int Dim>
void FlowEquations<Dim>::residual(std::span<const double> w, std::span<const MotionState> motions,
                                  TimeTerm term, std::span<double> r) {
  fetch_ghosts(w);
  const std::size_t count = domain_.state_count();
  for (std::size_t i = 0; i < instance_count(); ++i)
    balance_.evaluate(w.subspan(i * count, count), ghosts_of(i), rigid_motion(motions[i]),
                      r.subspan(i * count, count));
  add_time_term(term, w, r);
}

template <int Dim>
void FlowEquations<Dim>::stage_balance(std::span<const double> w, std::span<const MotionState> motions,
                                       double renewed, std::span<double> dissipation, std::span<double> r) {
  fetch_ghosts(w);
  const std::size_t count = domain_.state_count();
  for (std::size_t i = 0; i < instance_count(); ++i)
    balance_.evaluate_stage(w.subspan(i * count, count), ghosts_of(i), rigid_motion(motions[i]), renewed,
                            dissipation.subspan(i * count, count), r.subspan(i * count, count));
}

template <int Dim>
void FlowEquations<Dim>::add_time_derivative(double scale, std::span<const double> w,
                                             std::span<double> r) const {
  const std::size_t count = domain_.state_count(), instances = instance_count();
  if (instances == 1) return;
  std::vector<double> weights;
  for (int row = 0; row < time_.instances(); ++row)
    for (int column = 0; column < time_.instances(); ++column)
      weights.push_back(scale * time_.derivative(row, column));
  // A few cells of all instances at a time: instances lie so far apart that their cells compete for
  // the same lines of the cache.
  constexpr std::size_t chunk = 16;
  std::vector<CellVector<n>> states(instances * chunk);
  const auto volumes = domain_.volumes();
  for (std::size_t first = 0; first < volumes.size(); first += chunk) {
    const std::size_t last = std::min(first + chunk, volumes.size());
    for (std::size_t i = 0; i < instances; ++i)
      for (std::size_t c = first; c < last; ++c)
        states[i * chunk + c - first] = volumes[c] * load_cell<n>(w.data() + i * count + c * n);
    for (std::size_t row = 0; row < instances; ++row)
      for (std::size_t c = first; c < last; ++c) {
        double* out = r.data() + row * count + c * n;
        CellVector<n> sum = load_cell<n>(out);
        for (std::size_t i = 0; i < instances; ++i)
          sum += weights[row * instances + i] * states[i * chunk + c - first];
        store_cell<n>(sum, out);
      }
  }
}

template <int Dim>
void FlowEquations<Dim>::add_time_term(TimeTerm term, std::span<const double> w, std::span<double> r) const {
  add_time_derivative(term.kappa, w, r);
  if (term.shift == 0.0) return;
  const auto volumes = domain_.volumes();
  for (std::size_t i = 0, at = 0; i < instance_count(); ++i)
    for (std::size_t c = 0; c < volumes.size(); ++c, at += n)
      store_cell<n>(load_cell<n>(r.data() + at) + term.shift * volumes[c] * load_cell<n>(w.data() + at),
                    r.data() + at);
}

template <int Dim>
std::vector<Loads<double>> FlowEquations<Dim>::loads(std::span<const double> w,
                                                     std::span<const MotionState> motions) {
  fetch_ghosts(w);
  const std::size_t count = domain_.state_count();
  std::vector<Loads<double>> result;
  for (std::size_t i = 0; i < instance_count(); ++i)
    result.push_back(walls_.evaluate(w.subspan(i * count, count), ghosts_of(i), rigid_motion(motions[i])));
  return result;
}

template <int Dim>
void FlowEquations<Dim>::linearize_state(std::span<const double> w, std::span<const MotionState> motions,
                                         TimeTerm term) {
  fetch_ghosts(w);
  term_ = term;
  const std::size_t count = domain_.state_count();
  if (!assembler_) assembler_.emplace(domain_, model_);
  jacobians_.resize(instance_count(), BlockSparse<n>(domain_.pattern()));
  for (std::size_t i = 0; i < instance_count(); ++i)
    assembler_->assemble(w.subspan(i * count, count), ghosts_of(i), rigid_motion(motions[i]), jacobians_[i]);
}

template <int Dim>
void FlowEquations<Dim>::linearize(std::span<const double> w, std::span<const MotionState> motions,
                                   TimeTerm term) {
  linearize_state(w, motions, term);
  const std::size_t count = domain_.state_count();
  using D = Dual<double, 3>;
  if (!motion_balance_) motion_balance_.emplace(domain_, lifted(model_));
  std::vector<D> state(count), ghosts(ghosts_of(0).size()), balance(count);
  motion_gradients_.resize(instance_count());
  load_gradients_.resize(instance_count());
  linearized_loads_.resize(instance_count());
  for (std::size_t i = 0; i < instance_count(); ++i) {
    const auto instance = w.subspan(i * count, count);
    const RigidMotion<D> seeded = seeded_motion(motions[i]);
    load_gradients_[i] = walls_.gradients(instance, ghosts_of(i), rigid_motion(motions[i]));
    linearized_loads_[i] = walls_.evaluate(instance, ghosts_of(i), seeded);
    std::copy(instance.begin(), instance.end(), state.begin());
    std::copy(ghosts_of(i).begin(), ghosts_of(i).end(), ghosts.begin());
    motion_balance_->evaluate(state, ghosts, seeded, balance);
    for (int k = 0; k < 3; ++k) {
      auto& column = motion_gradients_[i][static_cast<std::size_t>(k)];
      column.resize(count);
      for (std::size_t j = 0; j < count; ++j) column[j] = balance[j].gradient[k];
    }
  }
}

template <int Dim>
void FlowEquations<Dim>::apply(std::span<const double> x, std::span<double> y) const {
  fetch_ghosts(x);
  std::fill(y.begin(), y.end(), 0.0);
  const std::size_t count = domain_.state_count();
  for (std::size_t i = 0; i < instance_count(); ++i)
    jacobians_[i].multiply_add(x.subspan(i * count, count), ghosts_of(i), y.subspan(i * count, count));
  add_time_term(term_, x, y);
}

template <int Dim>
void FlowEquations<Dim>::apply_transpose(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  std::fill(ghosts_.begin(), ghosts_.end(), 0.0);
  const std::size_t count = domain_.state_count();
  const std::size_t ghost_count = static_cast<std::size_t>(domain_.ghost_count()) * n;
  for (std::size_t i = 0; i < instance_count(); ++i)
    jacobians_[i].transpose_multiply_add(x.subspan(i * count, count), y.subspan(i * count, count),
                                         std::span<double>(ghosts_).subspan(i * ghost_count, ghost_count));
  domain_.exchange().template scatter_add<double>(ghosts_, y, time_.instances(), n);
  add_time_term({-term_.kappa, term_.shift}, x, y);  // D is antisymmetric, Omega the same in all instances
}

template class FlowEquations<2>;
template class FlowEquations<3>;

}  // namespace wingbeat
