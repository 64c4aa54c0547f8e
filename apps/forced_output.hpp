#pragma once

#include <Eigen/Dense>
#include <vector>

#include "apps/context.hpp"
#include "apps/flow_setup.hpp"
#include "flow/forced_flow.hpp"

namespace wingbeat {

// The loads of a forced motion, one an instance: loads.csv, "pitch" of result.json and a table of
// harmonics on the terminal, f(theta) = sum_n Re(f_n e^{i n theta}). Collective.
void report_forced_loads(Context& context, const TimeSpectral& time, const std::vector<Coefficients>& loads,
                         const ForcedFlowResult& result);

// Q(k) by forced motion and by linearization, f = (-C_l, 2 C_m) per semichord and radian:
// derivatives.csv, "derivatives" of "pitch" and a table. Collective.
void report_derivatives(Context& context, const Eigen::Matrix2cd& forced, const Eigen::Matrix2cd& linearized);

}  // namespace wingbeat
