#pragma once

#include <cmath>

namespace wingbeat::testing {

// Perfect gas in one dimension.
struct TubeState {
  double density;
  double u;
  double p;

  double sound_speed(double gamma) const { return std::sqrt(gamma * p / density); }
};

// The waves that part two uniform gases brought into contact at x = t = 0: on each side a shock or
// a centred expansion, a contact between them (E. F. Toro, Riemann Solvers and Numerical Methods
// for Fluid Dynamics, chapter 4). No vacuum.
class RiemannProblem {
 public:
  RiemannProblem(const TubeState& left, const TubeState& right, double gamma)
      : left_(left), right_(right), gamma_(gamma) {
    p_ = 0.5 * (left.p + right.p);
    for (int i = 0; i < 50; ++i) {
      const Drop a = drop(left), b = drop(right);
      const double change = (a.value + b.value + right.u - left.u) / (a.slope + b.slope);
      p_ = std::fmax(p_ - change, 1e-3 * p_);
      if (std::abs(change) < 1e-15 * p_) break;
    }
    u_ = 0.5 * (left.u + right.u + drop(right).value - drop(left).value);
  }

  double contact_pressure() const { return p_; }
  double contact_speed() const { return u_; }

  // At x / t.
  TubeState operator()(double speed) const {
    if (speed < u_) return left_of_contact(left_, u_, speed);
    // Seen in a mirror, the right side is a left one.
    const auto mirrored = left_of_contact({right_.density, -right_.u, right_.p}, -u_, -speed);
    return {mirrored.density, -mirrored.u, mirrored.p};
  }

 private:
  // Change of speed across a side's wave to the pressure at the contact, with its derivative.
  struct Drop {
    double value;
    double slope;
  };
  Drop drop(const TubeState& s) const {
    const double c = s.sound_speed(gamma_);
    if (p_ > s.p) {
      const double a = 2.0 / ((gamma_ + 1.0) * s.density), b = (gamma_ - 1.0) / (gamma_ + 1.0) * s.p;
      const double root = std::sqrt(a / (p_ + b));
      return {(p_ - s.p) * root, root * (1.0 - 0.5 * (p_ - s.p) / (p_ + b))};
    }
    const double exponent = 0.5 * (gamma_ - 1.0) / gamma_;
    return {2.0 * c / (gamma_ - 1.0) * (std::pow(p_ / s.p, exponent) - 1.0),
            std::pow(p_ / s.p, exponent - 1.0) / (s.density * c)};
  }

  // s: the gas that the wave has not reached; u: speed of the contact.
  TubeState left_of_contact(const TubeState& s, double u, double speed) const {
    const double c = s.sound_speed(gamma_), ratio = p_ / s.p, g = (gamma_ - 1.0) / (gamma_ + 1.0);
    if (ratio > 1.0) {
      const double shock = s.u - c * std::sqrt(0.5 * ((gamma_ + 1.0) * ratio + gamma_ - 1.0) / gamma_);
      return speed < shock ? s : TubeState{s.density * (ratio + g) / (g * ratio + 1.0), u, p_};
    }
    const double tail = u - c * std::pow(ratio, 0.5 * (gamma_ - 1.0) / gamma_);
    if (speed < s.u - c) return s;
    if (speed > tail) return {s.density * std::pow(ratio, 1.0 / gamma_), u, p_};
    const double c_there = g * (s.u - speed) + 2.0 / (gamma_ + 1.0) * c;
    const double density = s.density * std::pow(c_there / c, 2.0 / (gamma_ - 1.0));
    return {density, speed + c_there, density * c_there * c_there / gamma_};
  }

  TubeState left_;
  TubeState right_;
  double gamma_;
  double p_ = 0.0;  // at the contact
  double u_ = 0.0;
};

}  // namespace wingbeat::testing
