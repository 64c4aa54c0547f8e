#include "flow/harmonic_preconditioner.hpp"

#include <algorithm>

namespace wingbeat {

using Complex = std::complex<double>;

HarmonicFactors unfactored(const Comm& comm, const std::shared_ptr<const Subdomain>& subdomain,
                           int block_size, int harmonics) {
  HarmonicFactors factors;
  factors.mean = std::make_shared<SchwarzSolver<double>>(comm, subdomain, block_size);
  for (int h = 1; h <= harmonics; ++h)
    factors.harmonics.push_back(std::make_shared<SchwarzSolver<Complex>>(comm, subdomain, block_size));
  return factors;
}

double factor_bytes(const HarmonicFactors& factors) {
  double sum = factors.mean->factor_bytes();
  for (const auto& solver : factors.harmonics) sum += solver->factor_bytes();
  return sum;
}

std::vector<Complex> harmonic_shift(std::span<const double> volumes, double frequency) {
  std::vector<Complex> shift;
  shift.reserve(volumes.size());
  for (double volume : volumes) shift.emplace_back(0.0, frequency * volume);
  return shift;
}

template <int Dim>
HarmonicPreconditioner<Dim>::HarmonicPreconditioner(const FlowDomain<Dim>& domain, const TimeSpectral& time,
                                                    HarmonicFactors factors)
    : domain_(domain), time_(time), factors_(std::move(factors)) {}

template <int Dim>
void HarmonicPreconditioner<Dim>::factor(const FlowEquations<Dim>& flow, double kappa, bool keep_existing) {
  BlockSparse<state_size<Dim>> mean(domain_.pattern());
  const double weight = 1.0 / static_cast<double>(flow.instance_count());
  for (const auto& jacobian : flow.jacobians())
    for (std::size_t i = 0; i < mean.values().size(); ++i) mean.values()[i] += weight * jacobian.values()[i];
  const auto is_due = [&](const auto& solver) { return !keep_existing || !solver.is_factored(); };
  if (is_due(*factors_.mean)) factors_.mean->factor(mean, std::span<const double>{});
  for (int h = 1; h <= time_.harmonics(); ++h) {
    auto& solver = *factors_.harmonics[static_cast<std::size_t>(h - 1)];
    if (is_due(solver))
      solver.factor(mean, std::span<const Complex>(harmonic_shift(domain_.volumes(), h * kappa)));
  }
}

template <int Dim>
void HarmonicPreconditioner<Dim>::factor(const FlowEquations<Dim>& flow, double kappa) {
  factor(flow, kappa, false);
}
template <int Dim>
void HarmonicPreconditioner<Dim>::factor_missing(const FlowEquations<Dim>& flow, double kappa) {
  factor(flow, kappa, true);
}

template <int Dim>
bool HarmonicPreconditioner<Dim>::is_factored() const {
  return factors_.mean->is_factored() &&
         std::all_of(factors_.harmonics.begin(), factors_.harmonics.end(),
                     [](const auto& solver) { return solver->is_factored(); });
}

template <int Dim>
void HarmonicPreconditioner<Dim>::solve(std::span<const double> x, std::span<double> y,
                                        bool transposed) const {
  const std::size_t count = domain_.state_count();
  const std::vector<Complex> b = time_.harmonics_of(x);
  std::vector<Complex> solution(b.size());
  std::vector<double> real_b(count), real_x(count);
  for (std::size_t i = 0; i < count; ++i) real_b[i] = b[i].real();
  if (transposed)
    factors_.mean->apply_transpose(real_b, real_x);
  else
    factors_.mean->apply(real_b, real_x);
  std::copy(real_x.begin(), real_x.end(), solution.begin());

  std::vector<Complex> rhs(count);
  for (std::size_t h = 1; h <= factors_.harmonics.size(); ++h) {
    const auto in = std::span<const Complex>(b).subspan(h * count, count);
    const auto out = std::span<Complex>(solution).subspan(h * count, count);
    if (transposed) {
      // The transpose of kappa D is its negative: the adjoint, not the plain transpose, of the harmonic.
      for (std::size_t i = 0; i < count; ++i) rhs[i] = std::conj(in[i]);
      factors_.harmonics[h - 1]->apply_transpose(rhs, out);
      for (Complex& value : out) value = std::conj(value);
    } else {
      factors_.harmonics[h - 1]->apply(in, out);
    }
  }
  const std::vector<double> instances = time_.instances_of(solution);
  std::copy(instances.begin(), instances.end(), y.begin());
}

template <int Dim>
void HarmonicPreconditioner<Dim>::apply(std::span<const double> x, std::span<double> y) const {
  solve(x, y, false);
}
template <int Dim>
void HarmonicPreconditioner<Dim>::apply_transpose(std::span<const double> x, std::span<double> y) const {
  solve(x, y, true);
}

template <int Dim>
std::vector<Complex> HarmonicPreconditioner<Dim>::solve_harmonic(int h, std::span<const double> rhs) const {
  std::vector<Complex> x(rhs.size());
  if (h == 0) {
    std::vector<double> real(rhs.size());
    factors_.mean->apply(rhs, real);
    std::copy(real.begin(), real.end(), x.begin());
  } else {
    const std::vector<Complex> b(rhs.begin(), rhs.end());
    factors_.harmonics[static_cast<std::size_t>(h - 1)]->apply(b, x);
  }
  return x;
}

template <int Dim>
MultiplicativePreconditioner<Dim>::MultiplicativePreconditioner(const FlowEquations<Dim>& flow,
                                                                const HarmonicPreconditioner<Dim>& harmonic,
                                                                std::shared_ptr<const Subdomain> subdomain)
    : flow_(flow), harmonic_(harmonic) {
  for (std::size_t i = 0; i < flow.instance_count(); ++i)
    instances_.push_back(
        std::make_unique<SchwarzSolver<double>>(flow.domain().comm(), subdomain, state_size<Dim>));
}

template <int Dim>
void MultiplicativePreconditioner<Dim>::factor() {
  for (std::size_t i = 0; i < instances_.size(); ++i)
    instances_[i]->factor(flow_.jacobians()[i], std::span<const double>{});
}

template <int Dim>
void MultiplicativePreconditioner<Dim>::solve_instances(std::span<const double> x, std::span<double> y,
                                                        bool transposed) const {
  const std::size_t count = flow_.domain().state_count();
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const auto in = x.subspan(i * count, count);
    const auto out = y.subspan(i * count, count);
    if (transposed)
      instances_[i]->apply_transpose(in, out);
    else
      instances_[i]->apply(in, out);
  }
}

template <int Dim>
void MultiplicativePreconditioner<Dim>::apply(std::span<const double> x, std::span<double> y) const {
  std::vector<double> remainder(x.size()), correction(x.size());
  harmonic_.apply(x, y);
  flow_.apply(y, remainder);
  for (std::size_t i = 0; i < x.size(); ++i) remainder[i] = x[i] - remainder[i];
  solve_instances(remainder, correction, false);
  for (std::size_t i = 0; i < x.size(); ++i) y[i] += correction[i];
}

template <int Dim>
void MultiplicativePreconditioner<Dim>::apply_transpose(std::span<const double> x,
                                                        std::span<double> y) const {
  std::vector<double> remainder(x.size()), correction(x.size());
  solve_instances(x, y, true);
  flow_.apply_transpose(y, remainder);
  for (std::size_t i = 0; i < x.size(); ++i) remainder[i] = x[i] - remainder[i];
  harmonic_.apply_transpose(remainder, correction);
  for (std::size_t i = 0; i < x.size(); ++i) y[i] += correction[i];
}

template class HarmonicPreconditioner<2>;
template class HarmonicPreconditioner<3>;
template class MultiplicativePreconditioner<2>;
template class MultiplicativePreconditioner<3>;

}  // namespace wingbeat
