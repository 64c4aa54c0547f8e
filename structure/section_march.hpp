#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/spectral/time_spectral.hpp"
#include "flow/dual_time.hpp"
#include "structure/section_kinematics.hpp"
#include "structure/time_marching.hpp"

namespace wingbeat {

// The flow about a typical section at a reduced velocity, as the marching structure sees it: its states
// move the mesh, steps are taken on the flow's clock (eq:two-clocks), f = (-C_l, 2 C_m).
template <int Dim>
class SectionLoads final : public UnsteadyLoads {
 public:
  // `flow` is kept by reference and has been started.
  SectionLoads(DualTime<Dim>& flow, const SectionKinematics& kinematics, double reduced_velocity);

  void begin(double dtau) override;
  SolveStatus forces(std::span<const double> y, std::span<double> f) override;
  void accept() override { flow_.accept(); }

  // Loads of the last call of forces(), and the iterations of the flow since the step was opened.
  const Loads<double>& loads() const { return loads_; }
  int iterations() const { return iterations_; }

 private:
  DualTime<Dim>& flow_;
  SectionKinematics kinematics_;
  double r_;
  Loads<double> loads_;
  int iterations_ = 0;
};

// Levels, newest first, dtau apart, that lead up to the first instance of a periodic solution of
// frequency omega, by trigonometric interpolation (exact for the harmonics it carries). `values` are
// [instance][width].
std::vector<std::vector<double>> periodic_history(const TimeSpectral& time, std::span<const double> values,
                                                  double omega, double dtau, int levels);

}  // namespace wingbeat
