#include <gtest/gtest.h>

#include "test/structure/coupled_case.hpp"

namespace wingbeat {
namespace {

using namespace testing;

// A state far from any solution: noise on the flow of every instance, on the structure, and
// omega, r of their usual size.
std::vector<double> disturbed_unknowns(CoupledCase& c, double size) {
  auto u = random_vector(c.comm(), c.problem->local_size(), 7);
  for (double& value : u) value *= size;
  if (c.comm().is_root() && c.time.harmonics() > 0) {
    u[u.size() - 2] = 0.65;
    u[u.size() - 1] = 8.0;
  }
  return u;
}

// What w^ and y^ are measured from.
AeroelasticState disturbed_base(CoupledCase& c) {
  FlowEquations<2> one(c.flow_case.domain, c.flow_case.model, TimeSpectral(0));
  return {disturbed_state(c.flow_case, one, 0.02, 5), {0.01, 0.02, 0.0, 0.0}, 0.0, 2.0};
}

// Central difference of the residual in direction v.
std::vector<double> difference(AeroelasticProblem<2>& problem, std::span<const double> u,
                               std::span<const double> v, double h) {
  std::vector<double> up(u.begin(), u.end()), down = up, high(u.size()), low(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) up[i] += h * v[i], down[i] -= h * v[i];
  EXPECT_TRUE(problem.residual(up, high) && problem.residual(down, low));
  for (std::size_t i = 0; i < u.size(); ++i) high[i] = (high[i] - low[i]) / (2 * h);
  return high;
}

void expect_exact_jacobian(const std::string& section, int harmonics, double mean_pitch) {
  CoupledCase c(section_mesh(section, 32, 8), 0.75, harmonics);
  const std::optional<double> energy = harmonics > 0 ? std::optional(1e-4) : std::nullopt;
  AeroelasticProblem<2>& problem = c.pose(disturbed_base(c), energy, mean_pitch);
  const auto u = disturbed_unknowns(c, harmonics > 0 ? 0.5 : 0.01);
  problem.linearize(u);
  EXPECT_LE(transpose_defect(c.comm(), problem.jacobian()), 1e-12);

  // All rows together, then omega and r alone, which would drown among the flow's columns.
  const std::size_t tail = c.comm().is_root() ? (harmonics > 0 ? 2 : 4) : 0;
  for (bool tail_only : {false, true}) {
    auto v = random_vector(c.comm(), u.size(), 9);
    if (tail_only) std::fill(v.begin(), v.end() - static_cast<std::ptrdiff_t>(tail), 0.0);
    std::vector<double> product(u.size());
    problem.jacobian().apply(v, product);
    const double size = global_norm(c.comm(), product);
    EXPECT_LE(global_distance(c.comm(), difference(problem, u, v, 1e-5), product), 1e-6 * size);
    // Richardson: the error of second order cancels. Only where a step of w^ or y^ is small in the flow, s
    // times itself: the kinks of |u . S| in the spectral radii spoil larger ones.
    if (harmonics == 0) continue;
    const auto coarse = difference(problem, u, v, 2e-3), fine = difference(problem, u, v, 1e-3);
    std::vector<double> extrapolated(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) extrapolated[i] = (4.0 * fine[i] - coarse[i]) / 3.0;
    EXPECT_LE(global_distance(c.comm(), extrapolated, product), 1e-8 * size);
  }
}

TEST(AeroelasticProblem, JacobianIsThatOfTheResidual) {
  expect_exact_jacobian("naca0012", 1, 0.0);
  expect_exact_jacobian("naca2412", 1, 0.03);
  expect_exact_jacobian("naca0012", 2, 0.02);
  expect_exact_jacobian("naca2412", 0, 0.01);
}

TEST(AeroelasticProblem, UnknownsAndStateAreInverse) {
  CoupledCase c(section_mesh("naca0012", 32, 8), 0.75, 1);
  AeroelasticProblem<2>& problem = c.pose(disturbed_base(c), 1e-4);
  const auto u = disturbed_unknowns(c, 0.5);
  EXPECT_LE(global_distance(c.comm(), problem.unknowns(problem.state(u)), u),
            1e-12 * global_norm(c.comm(), u));
}

TEST(AeroelasticProblem, PreconditionersHaveTheirTransposes) {
  for (int harmonics : {1, 2}) {
    CoupledCase c(section_mesh("naca0012", 40, 10, 3), 0.7, harmonics);
    AeroelasticProblem<2>& problem = c.pose(disturbed_base(c), 1e-4, 0.01);
    problem.linearize(disturbed_unknowns(c, 0.5));
    problem.refactor();
    EXPECT_LE(transpose_defect(c.comm(), problem.preconditioner()), 1e-12);
    EXPECT_LE(transpose_defect<double>(c.comm(), *c.factors.mean), 1e-12);
    EXPECT_LE(transpose_defect<std::complex<double>>(c.comm(), *c.factors.harmonics.back()), 1e-12);

    const HarmonicPreconditioner<2> harmonic(c.flow_case.domain, c.time, c.factors);
    EXPECT_LE(transpose_defect(c.comm(), harmonic), 1e-12);
    MultiplicativePreconditioner<2> multiplicative(c.flow, harmonic, c.subdomain);
    multiplicative.factor();
    EXPECT_LE(transpose_defect(c.comm(), multiplicative), 1e-12);
  }
}

// A x = b and back, relative to x.
double inversion_error(const Comm& comm, const LinearOperator<double>& inverse, std::span<const double> ax,
                       std::span<const double> x) {
  std::vector<double> y(x.size());
  inverse.apply(ax, y);
  return global_distance(comm, y, x) / global_norm(comm, x);
}

TEST(HarmonicPreconditioner, IsExactWhereTheInstancesAreAlike) {
  const Comm alone(MPI_COMM_SELF);
  for (int harmonics : {1, 3}) {
    CoupledCase c(section_mesh("naca0012", 32, 8), 0.7, harmonics, alone);
    const std::vector<double> one = disturbed_base(c).w;
    std::vector<double> w;
    for (int n = 0; n < c.time.instances(); ++n) w.insert(w.end(), one.begin(), one.end());
    const std::vector<MotionState> motions(c.flow.instance_count(), {0.02, 0.01, -0.03});
    const double kappa = 0.3;
    c.flow.linearize(w, motions, kappa);
    HarmonicPreconditioner<2> harmonic(c.flow_case.domain, c.time, c.factors);
    harmonic.factor(c.flow, kappa);
    const auto x = random_vector(alone, w.size(), 3);
    std::vector<double> ax(x.size());
    c.flow.apply(x, ax);
    EXPECT_LE(inversion_error(alone, harmonic, ax, x), 1e-9);
    MultiplicativePreconditioner<2> multiplicative(c.flow, harmonic, c.subdomain);
    multiplicative.factor();
    EXPECT_LE(inversion_error(alone, multiplicative, ax, x), 1e-9);

    // With unlike instances the harmonic one is an approximation, and the other corrects it.
    w[0] *= 1.01;
    c.flow.linearize(w, motions, kappa);
    c.flow.apply(x, ax);
    EXPECT_GE(inversion_error(alone, harmonic, ax, x), 1e-6);
  }
}

// Left over is what the instances differ by, which is proportional to the amplitude s. The base carries no
// load: a static load that grows with r would be O(1/s) beside the fluctuating ones.
TEST(BorderedPreconditioner, InvertsTheCoupledJacobianOfSmallMotions) {
  const Comm alone(MPI_COMM_SELF);
  std::vector<double> errors;
  for (double energy : {1e-8, 1e-12}) {
    CoupledCase c(section_mesh("naca0012", 32, 8), 0.7, 1, alone);
    FlowEquations<2> one(c.flow_case.domain, c.flow_case.model, TimeSpectral(0));
    AeroelasticProblem<2>& problem =
        c.pose({one.uniform_state(), std::vector<double>(4, 0.0), 0.0, 1.0}, energy);
    problem.linearize(disturbed_unknowns(c, 0.5));
    problem.refactor();
    const auto x = random_vector(alone, problem.local_size(), 3);
    std::vector<double> ax(x.size());
    problem.jacobian().apply(x, ax);
    errors.push_back(inversion_error(alone, problem.preconditioner(), ax, x));
  }
  EXPECT_LE(errors[1], 1e-4);
  EXPECT_NEAR(errors[0] / errors[1], 100.0, 5.0);
}

TEST(BorderedPreconditioner, InvertsTheJacobianOfStaticEquilibrium) {
  const Comm alone(MPI_COMM_SELF);
  CoupledCase c(section_mesh("naca2412", 32, 8), 0.7, 0, alone);
  AeroelasticProblem<2>& problem = c.pose(disturbed_base(c), std::nullopt);
  problem.linearize(disturbed_unknowns(c, 0.01));
  problem.refactor();
  const auto x = random_vector(alone, problem.local_size(), 3);
  std::vector<double> ax(x.size());
  problem.jacobian().apply(x, ax);
  EXPECT_LE(inversion_error(alone, problem.preconditioner(), ax, x), 1e-9);
}

TEST(FrequencyResponse, SolvesTheLinearizedEquation) {
  CoupledCase c(section_mesh("naca0012", 40, 10), 0.7, 1);
  FlowEquations<2> one(c.flow_case.domain, c.flow_case.model, TimeSpectral(0));
  const std::vector<double> w = disturbed_state(c.flow_case, one, 0.01, 5);
  const MotionState at_rest;
  one.linearize(w, {&at_rest, 1}, 0.0);
  FrequencyResponse<2> response(one, c.factors.harmonics[0], 1e-11);
  for (double kappa : {0.2, 0.25}) {
    const HarmonicResponse at = response.at(kappa);
    std::vector<double> real(w.size()), imaginary(w.size()), defect(w.size());
    for (std::size_t i = 0; i < w.size(); ++i)
      real[i] = at.pitch[i].real(), imaginary[i] = at.pitch[i].imag();
    // The real part: J Re w^ - kappa Omega Im w^ = -dR/dalpha.
    one.apply(real, defect);
    const auto& by_pitch = one.motion_gradients(0)[0];
    for (std::size_t i = 0; i < w.size(); ++i)
      defect[i] += by_pitch[i] - kappa * c.flow_case.domain.volumes()[i / 4] * imaginary[i];
    EXPECT_LE(global_norm(c.comm(), defect), 1e-10 * global_norm(c.comm(), by_pitch));
    // The imaginary part: J Im w^ + kappa Omega Re w^ = -kappa dR/dalpha'.
    one.apply(imaginary, defect);
    const auto& by_rate = one.motion_gradients(0)[1];
    for (std::size_t i = 0; i < w.size(); ++i)
      defect[i] += kappa * (by_rate[i] + c.flow_case.domain.volumes()[i / 4] * real[i]);
    EXPECT_LE(global_norm(c.comm(), defect), 1e-10 * global_norm(c.comm(), by_pitch));
    const double lift = global_dot(c.comm(), one.load_gradients(0).force_y, real);
    EXPECT_NEAR(at.loads.pitch[0].real(), lift + one.linearized_loads(0).force_y.gradient[0], 1e-9);
  }
  EXPECT_EQ(response.factorization_count(), 1) << "neighbouring frequencies share factors";
}

NewtonOptions exact_newton() {
  NewtonOptions options;
  options.forcing_max = options.forcing_min = 1e-9;
  options.gmres.max_iterations = 300;
  return options;
}

const AeroelasticTolerances tolerances{};

TEST(Flutter, NewtonConvergesQuadraticallyFromTheLinearSolution) {
  CoupledCase c(section_mesh("naca64a010", 64, 16, 1, 60.0), 0.8, 1, Comm(MPI_COMM_SELF));
  const auto solution = solve_flutter(c, 1e-4, exact_newton());
  EXPECT_EQ(solution.newton.status, SolveStatus::converged);
  ASSERT_GE(solution.norms.size(), 3U);
  EXPECT_LE(solution.norms[1], 10.0 * std::pow(solution.norms[0], 2));
  EXPECT_LE(solution.norms[2], 10.0 * std::pow(solution.norms[1], 2));
  EXPECT_LE(solution.newton.iterations, 4);
}

TEST(Flutter, BoundaryIsThatOfTheLinearRootOnAnyNumberOfRanksAndHarmonics) {
  CoupledCase alone(section_mesh("naca64a010", 64, 16, 1, 60.0), 0.8, 1, Comm(MPI_COMM_SELF));
  CoupledCase together(section_mesh("naca64a010", 64, 16, 3, 60.0), 0.8, 1);
  const auto one = solve_flutter(alone, 1e-6, {}), all = solve_flutter(together, 1e-6, {});
  for (const auto& solution : {one, all}) {
    EXPECT_EQ(solution.newton.status, SolveStatus::converged);
    EXPECT_LE(solution.newton.iterations, 4);
    EXPECT_LE(solution.residuals.flow, tolerances.flow);
    EXPECT_LE(solution.residuals.structure, tolerances.structure);
    EXPECT_LE(solution.residuals.phase, tolerances.structure);
    EXPECT_LE(solution.residuals.energy, tolerances.structure);
  }
  const double v = std::sqrt(one.state.r);
  EXPECT_NEAR(std::sqrt(all.state.r), v, 1e-8 * v);
  EXPECT_NEAR(all.state.omega, one.state.omega, 1e-8);
  // The linear root is the limit of small amplitude.
  EXPECT_NEAR(v, one.root.reduced_velocity, 1e-4 * v);
  EXPECT_NEAR(one.state.omega, one.root.frequency, 1e-4);

  // A second harmonic changes the answer in proportion to the energy.
  CoupledCase finer(section_mesh("naca64a010", 64, 16, 1, 60.0), 0.8, 2, Comm(MPI_COMM_SELF));
  const auto two = solve_flutter(finer, 1e-6, {});
  EXPECT_EQ(two.newton.status, SolveStatus::converged);
  EXPECT_NEAR(std::sqrt(two.state.r), v, 2e-5 * v);
  EXPECT_NEAR(two.state.omega, one.state.omega, 2e-5);
}

TEST(StaticEquilibrium, OfACamberedSectionBalancesSpringsAndLoads) {
  CoupledCase c(section_mesh("naca2412", 64, 16, 2), 0.5, 0);
  const double v = 1.2, mean_pitch = 0.01;
  const std::vector<double> rigid = steady_state(c, mean_pitch);
  AeroelasticProblem<2>& problem =
      c.pose({rigid, std::vector<double>(4, 0.0), 0.0, v * v}, std::nullopt, mean_pitch);
  std::vector<double> u(problem.local_size(), 0.0), f(u.size());
  const auto result = newton(c.comm(), problem, u, exact_newton());
  EXPECT_EQ(result.status, SolveStatus::converged);
  problem.residual(u, f);
  EXPECT_LE(problem.measure(f).flow, 1e-10);
  EXPECT_LE(problem.measure(f).structure, 1e-12);

  const AeroelasticState state = problem.state(u);
  const double plunge_b = state.y[0], twist = state.y[1];
  const Loads<double> loads = c.flow.loads(state.w, problem.motions(state))[0];
  const double pressure_scale = 4.0 * v * v / (std::numbers::pi * paper_section.mass_ratio);
  EXPECT_NEAR(0.25 * plunge_b, -pressure_scale * loads.force_y, 1e-10)
      << "plunge spring: (omega_h/omega_alpha)^2 h/b";
  EXPECT_NEAR(0.75 * twist, pressure_scale * 2.0 * loads.moment, 1e-10) << "torsion spring: r_alpha^2 alpha";
  EXPECT_GE(loads.force_y, 0.2) << "a cambered section lifts";
  EXPECT_LE(plunge_b, -1e-3) << "and rises: plunge is positive down";
  EXPECT_EQ(state.y[2], 0.0);
}

}  // namespace
}  // namespace wingbeat
