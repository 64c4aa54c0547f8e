#include "adjoint/hicks_henne.hpp"

#include <cmath>
#include <numbers>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

constexpr double negligible = 1e-16;

// A bump whose peak lies in the upper half: sin^t(pi s^p), and where it begins to differ from 0.
struct UpperBump {
  double exponent = 1.0;
  double width = 3.0;
  double begin = 0.0;

  UpperBump(double peak, double t) : exponent(-std::numbers::ln2 / std::log(peak)), width(t) {
    begin = std::pow(std::pow(negligible, 1.0 / t) / std::numbers::pi, 1.0 / exponent);
  }

  double operator()(double s) const {
    if (s <= begin || s >= 1.0) return 0.0;
    const double sine = std::sin(std::numbers::pi * std::exp(exponent * std::log(s)));
    return width == 3.0 ? sine * sine * sine : std::pow(sine, width);
  }
};

}  // namespace

HicksHenne::HicksHenne(const SectionWall& wall, const BumpOptions& options)
    : options_(options), s_(wall.s), normals_(wall.normals) {
  ensure(options.bumps >= 1 && options.width > 0.0, "number and width of bumps must be positive");
}

int HicksHenne::variables() const { return options_.symmetric ? (options_.bumps + 1) / 2 : options_.bumps; }

double HicksHenne::peak(int i) const { return (i + 1.0) / (options_.bumps + 1.0); }

double HicksHenne::bump(int i, double s) const {
  const int mirrored = options_.bumps - 1 - i;
  const UpperBump upper(peak(std::max(i, mirrored)), options_.width);
  return upper(i < mirrored ? 1.0 - s : s);
}

// Calls f(variable, node of the wall, value of the bump there), in the same order every time.
template <class F>
void HicksHenne::for_each_value(F&& f) const {
  for (int i = 0; i < options_.bumps; ++i) {
    const int mirrored = options_.bumps - 1 - i;
    const int variable = options_.symmetric ? std::min(i, mirrored) : i;
    const UpperBump upper(peak(std::max(i, mirrored)), options_.width);
    for (std::size_t w = 0; w < s_.size(); ++w)
      if (const double value = upper(i < mirrored ? 1.0 - s_[w] : s_[w]); value != 0.0) f(variable, w, value);
  }
}

std::vector<Vec<double, 2>> HicksHenne::displacement(std::span<const double> amplitudes) const {
  ensure(std::ssize(amplitudes) == variables(), "one amplitude a shape variable");
  std::vector<double> outward(s_.size(), 0.0);
  for_each_value(
      [&](int variable, std::size_t w, double value) { outward[w] += amplitudes[variable] * value; });
  std::vector<Vec<double, 2>> wall;
  for (std::size_t w = 0; w < s_.size(); ++w) wall.push_back(outward[w] * normals_[w]);
  return wall;
}

std::vector<double> HicksHenne::amplitude_gradient(std::span<const Vec<double, 2>> wall) const {
  ensure(wall.size() == s_.size(), "one sensitivity a node of the wall");
  std::vector<double> outward, gradient(variables(), 0.0);
  for (std::size_t w = 0; w < s_.size(); ++w) outward.push_back(dot(normals_[w], wall[w]));
  for_each_value(
      [&](int variable, std::size_t w, double value) { gradient[variable] += value * outward[w]; });
  return gradient;
}

}  // namespace wingbeat
