#pragma once

#include <Eigen/Dense>
#include <complex>
#include <memory>
#include <optional>
#include <random>

#include "flow/frequency_response.hpp"
#include "flow/pseudo_transient.hpp"
#include "structure/aeroelastic_problem.hpp"
#include "structure/flutter_roots.hpp"
#include "structure/harmonic_motion.hpp"
#include "structure/typical_section.hpp"
#include "test/flow/flow_case.hpp"

namespace wingbeat::testing {

// The typical section of Thomas, Dowell & Hall 2002 (doi:10.2514/2.1713): a = -0.6, so that the elastic axis
// is at 0.2 chords, where FlowCase has its axis of rotation.
inline const TypicalSection paper_section{-0.6, 0.25, 0.75, 0.5, 75.0, {}};

// A coupled problem on a small mesh, about a given base state.
struct CoupledCase {
  FlowCase<2> flow_case;
  TimeSpectral time;
  StructureModel model;
  FlowEquations<2> flow;
  std::shared_ptr<const Subdomain> subdomain;
  HarmonicFactors factors;
  std::unique_ptr<AeroelasticProblem<2>> problem;

  CoupledCase(MultiblockMesh<2> mesh, double mach, int harmonics, const Comm& ranks = Comm())
      : flow_case(std::move(mesh), mach, 0.0, 1.0, ranks),
        time(harmonics),
        model(structure_model(paper_section)),
        flow(flow_case.domain, flow_case.model, time),
        subdomain(std::make_shared<const Subdomain>(
            ranks, flow_case.domain.exchange(), flow_case.domain.pattern(), SubdomainOptions{.overlap = 3})),
        factors(unfactored(ranks, subdomain, state_size<2>, harmonics)) {}
  CoupledCase(const CoupledCase&) = delete;
  CoupledCase& operator=(const CoupledCase&) = delete;

  const Comm& comm() const { return flow_case.comm; }
  double flow_speed() const { return flow_case.model.freestream.speed(); }

  // `energy` empty: static equilibrium.
  AeroelasticProblem<2>& pose(AeroelasticState base, std::optional<double> energy, double mean_pitch = 0.0) {
    std::optional<CycleCondition> amplitude;
    if (energy) amplitude = energy_condition(model, *energy);
    problem = std::make_unique<AeroelasticProblem<2>>(
        flow, StructuralEquation(model, time), SectionKinematics{flow_speed(), mean_pitch, 1.0}, amplitude,
        std::move(base), factors, AeroelasticTolerances{});
    return *problem;
  }
};

// Steady flow of one instance at a fixed pitch, from uniform flow.
inline std::vector<double> steady_state(CoupledCase& c, double pitch_angle = 0.0) {
  FlowEquations<2> flow(c.flow_case.domain, c.flow_case.model, TimeSpectral(0));
  std::vector<double> w = flow.uniform_state();
  PseudoTransientOptions options;
  options.tolerance = 5e-12;
  const auto result = pseudo_transient<2>(flow, {pitch_angle, 0.0, 0.0}, *c.factors.mean, w, options);
  if (result.status != SolveStatus::converged) throw std::runtime_error("steady flow: not converged");
  return w;
}

// A flutter solution from nothing: steady flow, table of Q(k), lowest destabilising root, coupled Newton.
struct FlutterSolution {
  NewtonResult newton;
  std::vector<double> norms;  // |F| at the start and after every iteration
  FlutterRoot root;
  AeroelasticState state;
  AeroelasticResiduals residuals;
};

inline FlutterSolution solve_flutter(CoupledCase& c, double energy, const NewtonOptions& options) {
  using Complex = std::complex<double>;
  const std::vector<double> steady = steady_state(c);
  FlowEquations<2> one(c.flow_case.domain, c.flow_case.model, TimeSpectral(0));
  const MotionState at_rest;
  one.linearize(steady, {&at_rest, 1}, 0.0);
  FrequencyResponse<2> response(one, c.factors.harmonics[0], 1e-9);
  const AerodynamicMatrix q = [&](double k) {
    const HarmonicResponse at = response.at(2.0 * k * c.flow_speed());
    // Displacements are (h/b, alpha), forces (-C_l, 2 C_m).
    Eigen::MatrixXcd matrix(2, 2);
    matrix << -0.5 * at.loads.plunge[0], -at.loads.pitch[0], at.loads.plunge[1], 2.0 * at.loads.pitch[1];
    return matrix;
  };
  const auto table = tabulate(q, spread_reduced_frequencies(0.05, 0.25, 5));
  FlutterSolution solution;
  for (const FlutterRoot& root : flutter_roots(c.model, q, table))
    if (root.is_destabilising()) {
      solution.root = root;
      break;
    }
  if (!solution.root.is_converged) throw std::runtime_error("no flutter root");

  const double omega = solution.root.frequency, v = solution.root.reduced_velocity;
  const Eigen::VectorXcd mode = scaled_to_energy(c.model, solution.root.mode, omega, energy);
  const HarmonicResponse at = response.at(omega * c.flow_speed() / v);
  AeroelasticState start{{}, harmonic_states(c.model, c.time, mode, omega), omega, v * v};
  for (int n = 0; n < c.time.instances(); ++n)
    for (std::size_t i = 0; i < steady.size(); ++i) {
      const Complex amplitude = at.pitch[i] * mode[pitch_mode] + at.plunge[i] * 0.5 * mode[plunge_mode];
      start.w.push_back(steady[i] + (amplitude * std::polar(1.0, c.time.phase(n))).real());
    }

  AeroelasticProblem<2>& problem = c.pose({steady, std::vector<double>(4, 0.0), 0.0, 1.0}, energy);
  std::vector<double> u = problem.unknowns(start), f(u.size());
  solution.newton = newton(c.comm(), problem, u, options, [&](const NewtonIteration& it, auto...) {
    solution.norms.push_back(it.residual_norm);
    return true;
  });
  problem.residual(u, f);
  solution.residuals = problem.measure(f);
  solution.state = problem.state(u);
  return solution;
}

// Reproducible entries in [-1, 1]: each rank its own.
template <class T = double>
std::vector<T> random_vector(const Comm& comm, std::size_t size, unsigned seed) {
  std::mt19937_64 generator(seed * 100 + static_cast<unsigned>(comm.rank()));
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  std::vector<T> x(size);
  for (T& value : x) {
    if constexpr (std::is_same_v<T, double>)
      value = entry(generator);
    else
      value = {entry(generator), entry(generator)};
  }
  return x;
}

// |<v, A x> - <A^T v, x>| relative to |v| |A x|.
template <class T>
double transpose_defect(const Comm& comm, const LinearOperator<T>& op) {
  const std::size_t size = op.local_size();
  const auto x = random_vector<T>(comm, size, 1), v = random_vector<T>(comm, size, 2);
  std::vector<T> ax(size), atv(size);
  op.apply(x, ax);
  op.apply_transpose(v, atv);
  T forward{}, backward{};
  double size_v = 0.0, size_ax = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    forward += v[i] * ax[i];
    backward += atv[i] * x[i];
    size_v += std::norm(v[i]);
    size_ax += std::norm(ax[i]);
  }
  return std::abs(comm.sum(forward) - comm.sum(backward)) / std::sqrt(comm.sum(size_v) * comm.sum(size_ax));
}

inline double global_distance(const Comm& comm, std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(comm.sum(sum));
}

}  // namespace wingbeat::testing
