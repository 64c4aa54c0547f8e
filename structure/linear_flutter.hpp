#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "flow/frequency_response.hpp"
#include "flow/steady_sequence.hpp"
#include "structure/aeroelastic_problem.hpp"
#include "structure/flutter_roots.hpp"
#include "structure/section_kinematics.hpp"
#include "structure/structure_model.hpp"

namespace wingbeat {

// The flow about a section that rests in (static) equilibrium, linearized for small motion: gives
// the aerodynamic matrix Q(k) and the flow that goes with a motion (eq:aerodynamic-matrix).
template <int Dim>
class LinearizedSection {
 public:
  // `rest`: one instance w, y of the section at rest. `is_stopped` is polled before every Q(k), which
  // then throws SolveFailure(interrupted). Collective.
  LinearizedSection(FlowLevel<Dim>& level, const SectionKinematics& kinematics, AeroelasticState rest,
                    double tolerance, std::function<bool()> is_stopped = {}, const GmresOptions& gmres = {});

  const AeroelasticState& rest() const { return rest_; }
  // f = Q (h/b, alpha), f = (-C_l, 2 C_m). Collective.
  Eigen::MatrixXcd aerodynamic_matrix(double k);
  // States of all instances in small motion u^ e^{i theta} about rest. Collective.
  AeroelasticState harmonic_state(const StructureModel& model, const TimeSpectral& time,
                                  const Eigen::VectorXcd& u_hat, double omega, double reduced_velocity);
  // The factors of the last frequency solved at.
  std::shared_ptr<SchwarzSolver<std::complex<double>>> factors() const { return solver_; }
  int factorization_count() const { return response_.factorization_count(); }

 private:
  double kappa(double k) const { return 2.0 * k * kinematics_.flow_speed; }

  SectionKinematics kinematics_;
  AeroelasticState rest_;
  std::shared_ptr<SchwarzSolver<std::complex<double>>> solver_;
  FrequencyResponse<Dim> response_;
  std::function<bool()> is_stopped_;
};

struct LinearFlutterOptions {
  std::array<double, 2> reduced_frequency_range{0.02, 0.6};
  int samples = 12;
  // Where set, the table need only be that accurate (sketched_matrix): to see which roots there are.
  std::optional<double> sketch_accuracy{};
  double tolerance = 1e-8;  // of the linear solves behind Q
  NewtonOptions newton{};   // of static equilibrium; its lengths of GMRES hold behind Q too
  AeroelasticTolerances tolerances{};
  // Roots up to this many times the lowest speed are polished, for the lowest may change; 0: none is.
  double polish_margin = 1.2;
  double settled_speed = 1e-4;         // relative change of V that ends the repetition of equilibrium and root
  std::function<bool()> is_stopped{};  // collective; polled between linear solves
};

struct LinearFlutter {
  std::optional<FlutterRoot> root;  // the lowest destabilising one; nothing if there is none in range
  std::vector<FlutterRoot> roots;   // all, by speed
};

// True where the steady loads would move the section off its springs' neutral point.
bool is_deflected(const Loads<double>& loads);

// Static aeroelastic equilibrium at reduced velocity V: w, y with R = S = 0, started from the
// level's steady state and `y`. Throws SolveFailure where Newton's method fails. Collective.
template <int Dim>
AeroelasticState static_equilibrium(FlowLevel<Dim>& level, const StructureModel& model,
                                    const SectionKinematics& kinematics, double reduced_velocity,
                                    const LinearFlutterOptions& options);

// Q(k) sampled over the range of the options.
template <int Dim>
AerodynamicTable sampled_matrix(LinearizedSection<Dim>& section, const LinearFlutterOptions& options);

// Flutter by the linearized frequency domain, from coarse to fine: all roots are sought with a table
// of Q(k) on the coarsest level, those near the lowest destabilising one are then polished with Q of
// each finer level. Where the section carries lift, equilibrium and root are repeated until the
// speed at which it rests is the speed at which it flutters. All levels hold steady solutions.
template <int Dim>
struct LinearFlutterSolution {
  LinearFlutter flutter;
  std::unique_ptr<LinearizedSection<Dim>> section;  // of the finest level, last solved near the root
};
template <int Dim>
LinearFlutterSolution<Dim> solve_linear_flutter(FlowLevelRange<Dim> levels, const StructureModel& model,
                                                const SectionKinematics& kinematics,
                                                const LinearFlutterOptions& options);

}  // namespace wingbeat
