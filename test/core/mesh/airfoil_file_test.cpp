#include "core/mesh/airfoil_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

using Point = Vec<double, 2>;

// Ordinates of a section in Selig order at curve parameters of cosine spacing.
std::vector<Point> ordinates(const Airfoil& airfoil, int count) {
  std::vector<Point> points;
  for (int k = 0; k < count; ++k)
    points.push_back(airfoil.at(std::cos(std::numbers::pi * k / (count - 1))).position);
  return points;
}

std::string text_of(const std::vector<Point>& points) {
  std::ostringstream text;
  text.precision(12);
  for (const auto& p : points) text << p[0] << ' ' << p[1] << '\n';
  return text.str();
}

Airfoil read(const std::string& text) {
  std::istringstream input(text);
  return read_airfoil(input, "section.dat");
}

// Greatest distance of points of `section` from `reference`, upper and lower surface of both being
// single-valued in x behind the nose.
double distance(const Airfoil& section, const Airfoil& reference) {
  double worst = 0.0;
  for (double t = -0.99; t < 1.0; t += 0.0173) {
    const Point p = section.at(t).position;
    double near = t;
    for (int step = 0; step < 20; ++step) {  // foot of the perpendicular
      const auto [position, tangent] = reference.at(near);
      near += dot(p - position, tangent) / dot(tangent, tangent);
    }
    const Point miss = p - reference.at(near).position;
    worst = std::max(worst, std::hypot(miss[0], miss[1]));
  }
  return worst;
}

std::string message_of(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// The second derivative of these sections in sqrt(x) jumps at the nose, so that a spline across it
// is of second order in the spacing there: about 3e-6 chord at 81 points.
constexpr double interpolation_error = 3e-6;

TEST(AirfoilFile, InterpolatesASectionFromItsOrdinates) {
  const Airfoil symmetric = make_airfoil("naca0012"), thin = make_airfoil("naca64a010"),
                cambered = make_airfoil("naca2412");
  EXPECT_LT(distance(read(text_of(ordinates(symmetric, 81))), symmetric), interpolation_error);
  EXPECT_LT(distance(read(text_of(ordinates(symmetric, 161))), symmetric), interpolation_error / 4);
  EXPECT_LT(distance(read(text_of(ordinates(thin, 161))), thin), interpolation_error);
  EXPECT_LT(distance(read(text_of(ordinates(cambered, 161))), cambered), interpolation_error);
}

TEST(AirfoilFile, TabulatedNaca64A010IsTheNamedSection) {
  const Airfoil named = make_airfoil("naca64a010");
  std::vector<Point> points;
  for (const double x : {100, 95, 90, 85, 80, 75, 70, 65, 60, 55, 50, 45, 40, 35, 30, 25, 20, 15, 10})
    points.push_back(named.at(std::sqrt(0.01 * x)).position);
  for (const double x : {7.5, 5.0, 2.5, 1.25, 0.75, 0.5})
    points.push_back(named.at(std::sqrt(0.01 * x)).position);
  const std::size_t upper = points.size();
  points.push_back({});
  for (std::size_t i = upper; i-- > 0;) points.push_back({{points[i][0], -points[i][1]}});
  // The named section also has its nose radius given, 0.00687; the ordinates alone say less.
  EXPECT_LT(distance(read(text_of(points)), named), 1e-4);
}

TEST(AirfoilFile, NoseBetweenOrdinatesKeepsItsRadius) {
  const Airfoil reference = make_airfoil("naca0012");
  const Airfoil even = read(text_of(ordinates(reference, 160)));  // no ordinate at the leading edge
  EXPECT_NEAR(even.nose_radius(), reference.nose_radius(), 0.05 * reference.nose_radius());
}

TEST(AirfoilFile, OrderTitleCommentsAndSeparatorsDoNotMatter) {
  std::vector<Point> points = ordinates(make_airfoil("naca2412"), 61);
  const std::string body = text_of(points);
  std::reverse(points.begin(), points.end());
  const std::string reverse_body = text_of(points);
  std::string commas = body;
  for (auto& c : commas)
    if (c == ' ') c = ',';
  const Airfoil reference = read(body);
  for (const auto& text : {reverse_body, commas, "NACA 2412\n" + body,
                           "# a comment\n\n  naca 2412, 61 points\n" + body + "# end\n"}) {
    const Airfoil airfoil = read(text);
    for (const double t : {-1.0, -0.6, -0.01, 0.0, 0.3, 1.0}) {
      EXPECT_NEAR(airfoil.at(t).position[0], reference.at(t).position[0], 1e-14);
      EXPECT_NEAR(airfoil.at(t).position[1], reference.at(t).position[1], 1e-14);
    }
  }
}

TEST(AirfoilFile, OpenTrailingEdgeIsClosedByAShear) {
  const Airfoil closed = make_airfoil("naca0012");
  std::vector<Point> points = ordinates(closed, 81);
  for (auto& p : points) p[1] += std::copysign(0.002, p[1]) * p[0];
  EXPECT_LT(distance(read(text_of(points)), closed), interpolation_error);
}

// A section whose shape was changed may begin before x = 0, and is none the shorter for it.
TEST(AirfoilFile, OrdinatesAreChordsAndStayWhereTheyAre) {
  const Airfoil unit = make_airfoil("naca0012");
  std::vector<Point> points = ordinates(unit, 81);
  const auto longer = [](Point p) { return Point{{1.0 + 1.03 * (p[0] - 1.0), p[1]}}; };
  for (auto& p : points) p = longer(p);
  const Airfoil read_back = read(text_of(points));
  for (const double t : {-0.9, -0.3, 0.0, 0.2, 0.7})
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(read_back.at(t).position[d], longer(unit.at(t).position)[d], interpolation_error);
  for (auto& p : points) p = {{100.0 * p[0], 100.0 * p[1]}};
  EXPECT_NE(message_of(text_of(points)).find("section.dat:1: x = 100"), std::string::npos)
      << message_of(text_of(points));
}

// Bad files: the message names file, line and fault.
TEST(AirfoilFile, RefusesBadOrdinatesNamingTheLine) {
  const std::vector<Point> good = ordinates(make_airfoil("naca0012"), 21);
  const auto with = [&](std::size_t line, const std::string& replacement) {
    std::ostringstream text;
    text.precision(12);
    for (std::size_t i = 0; i < good.size(); ++i)
      if (i + 1 == line)
        text << replacement << '\n';
      else
        text << good[i][0] << ' ' << good[i][1] << '\n';
    return text.str();
  };
  std::vector<Point> crossing = good;
  for (std::size_t i = 13; i < 20; ++i) crossing[i][1] *= -1.3;
  std::vector<Point> open = good;
  open.front()[1] += 0.02;
  std::vector<Point> from_nose(good.begin() + 10, good.end());
  std::reverse(from_nose.begin(), from_nose.end());
  from_nose.insert(from_nose.end(), good.begin(), good.begin() + 10);

  const std::vector<std::pair<std::string, std::string>> cases = {
      {with(4, "nan 0.01"), "section.dat:4: \"nan\" is not finite"},
      {with(5, "0.5 inf"), "section.dat:5: \"inf\" is not finite"},
      {with(6, "0.5 O.1"), "section.dat:6: \"O.1\" is not a number"},
      {with(7, "0.5"), "section.dat:7: expected two numbers"},
      {with(7, "0.5 0.1 0.2"), "section.dat:7: expected two numbers"},
      {with(8, "hello world"), "section.dat:8: \"hello\" is not a number"},
      {with(9, text_of({good[9]})), "section.dat:11: repeats the point of line 9"},
      {with(3, "0.1 0.01"), "turns back"},
      {text_of(std::vector<Point>(good.begin(), good.begin() + 9)), "section.dat: 9 points"},
      {"", "section.dat: 0 points"},
      {text_of(crossing), "crosses itself"},
      {text_of(open), "trailing edge open"},
      {text_of(from_nose), "trailing edge"},
      {"NACA 0012\n 11. 11.\n" + text_of(good), "section.dat:2: x = 11"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NE(message_of(text).find(expected), std::string::npos) << expected << " <- " << message_of(text);
}

TEST(AirfoilFile, RefusesAMissingFile) {
  try {
    read_airfoil(std::filesystem::path("/nowhere/section.dat"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/section.dat"), std::string::npos);
  }
}

}  // namespace
}  // namespace wingbeat
