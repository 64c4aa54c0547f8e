#pragma once

#include <Eigen/Dense>
#include <complex>

namespace wingbeat {

// Theodorsen's lift deficiency C(k) = H1(k)/(H1(k) + i H0(k)), Hankel functions of the second kind,
// for a harmonically moving thin section in incompressible flow (NACA Report 496, 1935); k >= 0.
std::complex<double> theodorsen_function(double k);

// The same continued to s = g + i k, motion as e^{s tau}: C = K1(s)/(K0(s) + K1(s)), modified Bessel
// functions with their cut along s < 0. Relative error about 1e-14. Throws InputError on the cut.
std::complex<double> generalised_theodorsen_function(std::complex<double> s);

// Q(k) of the flat plate: f = Q u with f = (-C_l, 2 C_m), u = (h/b, alpha), apparent mass included;
// elastic axis `a` semichords aft of mid-chord, C_m about it (eq:theodorsen). 2 x 2.
Eigen::MatrixXcd theodorsen_matrix(double elastic_axis, double k);

}  // namespace wingbeat
