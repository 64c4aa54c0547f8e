// p-k of any number of modes, and with Q(k) read from a file.
#include "structure/pk.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "core/io/error.hpp"
#include "structure/aerodynamic_table_file.hpp"
#include "structure/flutter_roots.hpp"
#include "structure/modal_settings.hpp"
#include "test/structure/theodorsen_cases.hpp"

namespace wingbeat {
namespace {

using testing::flat_plate_samples;
using testing::theodorsen_cases;
using testing::TheodorsenCase;

// m coupled modes of frequencies near 1, 1.4, 1.8, ... as a case would give them.
ModalSettings modes_of(int m) {
  ModalSettings settings;
  for (int i = 0; i < m; ++i) settings.modes.push_back("mode " + std::to_string(i + 1));
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const double distance = std::abs(i - j), frequency = 1.0 + 0.4 * i;
      settings.mass.push_back(i == j ? 1.0 : 0.1 / (1.0 + distance));
      settings.damping.push_back(i == j ? 0.01 * (i + 1) : 0.0);
      settings.stiffness.push_back(i == j ? frequency * frequency : 0.02 / distance);
    }
  settings.load_factor = 1.0;
  return settings;
}

// Loads that couple neighbours against each other, as those that cause flutter do.
Eigen::MatrixXcd constant_loads(int m) {
  Eigen::MatrixXcd q = Eigen::MatrixXcd::Zero(m, m);
  for (int i = 0; i + 1 < m; ++i) {
    q(i, i + 1) = 0.5 + 0.1 * i;
    q(i + 1, i) = -0.4;
  }
  for (int i = 0; i < m; ++i) q(i, i) = 0.05 * i - 0.1;
  return q;
}

// Eigenvalues p of the constant-coefficient equation, those of positive frequency.
std::vector<std::complex<double>> direct(const StructureModel& model, const Eigen::MatrixXd& q, double v) {
  StructureModel loaded = model;
  loaded.stiffness -= model.load(v) * q;
  std::vector<std::complex<double>> found;
  for (const std::complex<double> p : (-first_order_matrix(loaded)).eigenvalues())
    if (p.imag() > 0.0) found.push_back(p);
  return found;
}

class PkModes : public ::testing::TestWithParam<int> {};

TEST_P(PkModes, AreTheEigenvaluesUnderConstantLoads) {
  const int m = GetParam();
  const StructureModel model = structure_model(modes_of(m));
  const Eigen::MatrixXcd q = constant_loads(m);
  const std::vector<double> speeds = {0.3, 0.6, 0.9, 1.2, 1.5, 1.8};
  const PkResult result = pk(
      model, [&](double) { return q; }, 0.0, 100.0, speeds);
  ASSERT_EQ(static_cast<int>(result.branches.size()), m);
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    const auto exact = direct(model, q.real(), speeds[s]);
    ASSERT_EQ(static_cast<int>(exact.size()), m);
    for (const std::complex<double> p : exact) {
      double nearest = 1.0;
      for (const auto& branch : result.branches) nearest = std::min(nearest, std::abs(branch[s].p - p));
      EXPECT_LT(nearest, 1e-11) << "V = " << speeds[s];
    }
  }
  // At a crossing the eigenvalue of the matrix has no real part either.
  ASSERT_GE(result.crossings.size(), 1u);
  for (const PkCrossing& crossing : result.crossings) {
    double smallest = 1.0;
    for (const auto& p : direct(model, q.real(), crossing.point.reduced_velocity))
      smallest = std::min(smallest, std::abs(p.real()) + std::abs(p.imag() - crossing.point.frequency()));
    EXPECT_LT(smallest, 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(OfModels, PkModes, ::testing::Values(3, 6));

// Modes of one frequency, which loads then part: one falls until it diverges, the other rises.
TEST(Pk, TellsModesApartThatCoincideAtRest) {
  ModalSettings settings;
  settings.modes = {"bending", "torsion"};
  settings.mass = {1.0, 0.0, 0.0, 2.0};
  settings.stiffness = {0.25, 0.0, 0.0, 0.5};
  settings.load_factor = 0.25;
  const Eigen::MatrixXcd q = Eigen::Vector2cd(-0.1, 0.5).asDiagonal();
  const std::vector<double> speeds = {0.5, 1.0, 1.5};
  const PkResult result = pk(
      structure_model(settings), [&](double) { return q; }, 0.0, 100.0, speeds);
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    const double load = 0.25 * speeds[s] * speeds[s];
    std::vector<double> found = {result.branches[0][s].frequency(), result.branches[1][s].frequency()};
    std::sort(found.begin(), found.end());
    EXPECT_NEAR(found[0], std::sqrt((0.5 - 0.5 * load) / 2.0), 1e-12);
    EXPECT_NEAR(found[1], std::sqrt(0.25 + 0.1 * load), 1e-12);
  }
}

TEST(ModalSettings, FillTheMatricesRowByRow) {
  ModalSettings settings = modes_of(2);
  settings.damping = {0.1, 0.2, 0.3, 0.4};
  const StructureModel model = structure_model(settings);
  EXPECT_EQ(model.damping(0, 1), 0.2);
  EXPECT_EQ(model.damping(1, 0), 0.3);
  EXPECT_EQ(model.modes, settings.modes);
  settings.damping.clear();
  EXPECT_EQ(structure_model(settings).damping.norm(), 0.0);
  settings.mass = {1.0, 2.0, 2.0, 1.0};
  EXPECT_THROW(structure_model(settings), InputError);
}

TEST(AerodynamicTableFile, GivesTheodorsensEightPoints) {
  for (const TheodorsenCase& expected : theodorsen_cases) {
    SCOPED_TRACE(::testing::Message() << "U/(b omega_alpha) = " << expected.speed);
    const std::string text =
        aerodynamic_csv(flat_plate_samples(expected.section.elastic_axis, 60), true).text();
    const AerodynamicTable table = read_aerodynamic_table(text, "q.csv", 2);
    const StructureModel model = structure_model(expected.section);
    std::vector<double> speeds;
    for (int j = 1; j <= 25; ++j) speeds.push_back(0.026 * expected.speed * j);
    const PkResult result = pk(model, table, speeds);
    ASSERT_GE(result.crossings.size(), 1u);
    EXPECT_TRUE(result.crossings[0].is_destabilising);
    // The spline errs by h^4 of its spacing, 1e-8 here; tabulated speeds have nine digits.
    EXPECT_NEAR(2.0 * result.crossings[0].point.reduced_velocity / expected.speed, 1.0, 1e-6);
    EXPECT_NEAR(result.crossings[0].point.frequency() / expected.frequency, 1.0, 1e-6);
  }
}

TEST(AerodynamicTableFile, ReadsBackWhatItWrites) {
  for (int m : {1, 2, 3, 11}) {
    std::vector<double> k = {0.0, 0.1, 0.25, 1.0 / 3.0};
    std::vector<Eigen::MatrixXcd> q;
    for (double at : k) {
      Eigen::MatrixXcd sample(m, m);
      for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j) sample(i, j) = {std::sin(i + 3.0 * j + at), at * (i - 2.0 * j) / 3.0};
      q.push_back(sample);
    }
    const AerodynamicTable table(k, q);
    const AerodynamicTable again = read_aerodynamic_table(aerodynamic_csv(table, false).text(), "q.csv", m);
    for (std::size_t s = 0; s < k.size(); ++s) {
      EXPECT_EQ(again.sampled_k()[s], k[s]);
      EXPECT_EQ(again.samples()[s], q[s]);
    }
  }
}

std::string complaint(const std::string& text, int modes) {
  try {
    read_aerodynamic_table(text, "q.csv", modes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(AerodynamicTableFile, SaysWhatIsWrongAndWhere) {
  const std::string head = "# comment\nk,Q11_re,Q11_im\n";
  const auto expect = [&](const std::string& text, int modes, const std::string& part) {
    EXPECT_NE(complaint(text, modes).find(part), std::string::npos) << complaint(text, modes);
  };
  EXPECT_EQ(complaint(head + "0,1,0\n0.1,1,0\n\n0.2,1,0\n0.3,1,0\n", 1), "accepted");
  expect(head, 2, "q.csv:2: 3 columns; 2 modes need 9");
  expect("k,Q11_im,Q11_re\n", 1, "q.csv:1: column 2 is named \"Q11_im\"; expected \"Q11_re\"");
  expect(head + "0,1\n", 1, "q.csv:3: 2 values");
  expect(head + "0,1,zero\n", 1, "q.csv:3: \"zero\" is not a number");
  expect(head + "0,1,0\n0.1,1,0\n", 1, "q.csv: ");
  expect(head + "0,1,0\n0.1,1,0\n0.1,1,0\n0.3,1,0\n", 1, "k must be >= 0 and increase");
}

TEST(AerodynamicTable, WithMoreSamplesPassesThroughAllOfThem) {
  const AerodynamicMatrix q = [](double k) { return theodorsen_matrix(-0.6, k); };
  const AerodynamicTable table = flat_plate_samples(-0.6, 8);
  const AerodynamicTable more = with_samples(table, q, std::vector<double>{0.5, 0.1});
  ASSERT_EQ(more.sampled_k().size(), 10u);
  for (double k : {0.1, 0.5}) EXPECT_LT((more(k) - q(k)).norm(), 1e-13);
  for (double k : table.sampled_k()) EXPECT_LT((more(k) - q(k)).norm(), 1e-13);
}

}  // namespace
}  // namespace wingbeat
