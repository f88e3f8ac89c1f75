// SPDX-License-Identifier: Apache-2.0
// Tests of nuisance numbers in a study against one least-squares problem in which all numbers are
// variables, and of what is refused.
#include "correlation/nuisance/nuisance_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <fstream>

#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "correlation/nuisance/oscillation_testing.h"
#include "correlation/study/study.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

class NuisanceNumbers : public testing::Test {
 protected:
  void measure(double offset, double gain, double delay, std::uint64_t seed) {
    RandomStream random(seed, 0);
    const Channels truth = oscillation(2.0, 1.5);
    measured_.clear();
    std::ofstream out(folder_ / "measured.csv");
    out << "t [s],y [N]\n";
    out.precision(17);
    for (int i = 0; i < kRecorded; ++i) {
      const double t = kRecordedStep * i;
      measured_.push_back((1.0 + gain) * oscillation_at(truth, t - delay).y + offset +
                          kRecordedNoise * random.normal());
      out << t << ',' << measured_.back() << '\n';
    }
  }
  Study study(const std::string& settings, const std::string& y = "y [N]") {
    std::ofstream(folder_ / "in.txt") << "{a} {k}";
    std::ofstream(folder_ / "study.toml") << R"(
[simulator]
command = ["/bin/true"]
inputs = ["in.txt"]
[simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["t [s]", ")" << y << R"("]
[variable.a]
lower = 0.1
upper = 9
initial = 1.8
[variable.k]
lower = 0.1
upper = 9
initial = 1.2
[experiment.light]
kind = "curve"
x = "out/t"
y = "out/y"
measurement = "measured.csv"
exponent = 2
)" << scale_ << settings;
    return read_study(folder_ / "study.toml", experiment::language());
  }
  void refused(const std::string& settings,
               const std::string& part,
               const std::string& y = "y [N]") {
    try {
      study(settings, y);
      FAIL() << settings;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  ScratchFolder folder_;
  std::vector<double> measured_;
  std::string scale_ = "scale = \"2 N\"\n";
};

constexpr const char* kStated = "noise = \"0.05 N\"\n";

/// Residuals and slopes of the problem in which offset, gain and delay are variables as a and k.
struct AllUnknowns {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
};
AllUnknowns all_unknowns(const std::vector<double>& measured,
                         const Eigen::VectorXd& p,
                         const Eigen::Vector3d& sigma) {
  const Channels channels = oscillation(p[0], p[1]);
  AllUnknowns all{Eigen::VectorXd::Zero(kRecorded + 3), Eigen::MatrixXd::Zero(kRecorded + 3, 5)};
  for (int i = 0; i < kRecorded; ++i) {
    const CurvePoint s = oscillation_at(channels, kRecordedStep * i - p[4]);
    all.r[i] = (measured[static_cast<std::size_t>(i)] - (1.0 + p[3]) * s.y - p[2]) / kRecordedNoise;
    all.J.row(i) << -(1.0 + p[3]) * s.by_a, -(1.0 + p[3]) * s.by_k, -1.0, -s.y,
        (1.0 + p[3]) * s.by_t;
    all.J.row(i) /= kRecordedNoise;
  }
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(sigma[k])) continue;
    all.r[kRecorded + k] = p[2 + k] / sigma[k];
    all.J(kRecorded + k, 2 + k) = 1.0 / sigma[k];
  }
  return all;
}

struct Agreement {
  std::string settings;
  Eigen::Vector3d sigma;  // offset, gain, delay; 0: held at 0
};

TEST_F(NuisanceNumbers, AgreeWithAFitOfAllUnknownsTogether) {
  measure(0.1, 0.03, 0.02, 5);
  const std::vector<Agreement> cases{
      {"nuisance = {offset = \"0.2 N\", gain = \"3 %\", delay = \"20 ms\"}\n", {0.2, 0.03, 0.02}},
      {"nuisance = {offset = \"free\", gain = \"3 %\", delay = \"free\"}\n",
       {INFINITY, 0.03, INFINITY}}};
  for (const Agreement& one : cases) {
    const Study s = study(kStated + one.settings);
    const Objective objective = residual_objective(s);
    DesignPoint point = s.space.initial();
    Eigen::VectorXd p(5);
    p << point.values[0], point.values[1], 0.0, 0.0, 0.01;
    Score score;
    Eigen::MatrixXd J;
    for (int step = 0; step < 40; ++step) {
      const auto found = objective(point, oscillation(point.values[0], point.values[1]));
      ASSERT_TRUE(found);
      score = *found;
      const auto m = std::ssize(score.residuals);
      J = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          score.jacobian.data(), m, 2);
      const Eigen::VectorXd move =
          -(J.transpose() * J).inverse() * J.transpose() * to_vector(score.residuals);
      point.values[0] += move[0];
      point.values[1] += move[1];
      const AllUnknowns all = all_unknowns(measured_, p, one.sigma);
      p -= (all.J.transpose() * all.J).inverse() * all.J.transpose() * all.r;
    }
    const AllUnknowns all = all_unknowns(measured_, p, one.sigma);
    EXPECT_NEAR(point.values[0], p[0], 1e-6) << one.settings;
    EXPECT_NEAR(point.values[1], p[1], 1e-6);
    EXPECT_NEAR(score.value, all.r.squaredNorm(), 1e-6 * score.value);
    const Comparison c =
        compare(s.experiments[0], s.experiments, oscillation(point.values[0], point.values[1]));
    ASSERT_EQ(c.nuisance.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(c.nuisance[k].value, p[2 + static_cast<Eigen::Index>(k)], 1e-6);
    const Eigen::MatrixXd covariance = (all.J.transpose() * all.J).inverse();
    const Eigen::MatrixXd own = (J.transpose() * J).inverse();
    EXPECT_LT((own - covariance.topLeftCorner(2, 2)).norm(), 1e-5 * own.norm());
  }
}

TEST_F(NuisanceNumbers, GiveTheExactSlopeOfTheSumOfSquares) {
  measure(0.1, 0.03, 0.02, 6);
  const Study s = study(std::string(kStated) +
                        "nuisance = {offset = \"0.2 N\", gain = \"3 %\", delay = \"20 "
                        "ms\"}\n");
  for (const Objective& objective : {residual_objective(s), objective(s)}) {
    DesignPoint point = s.space.initial();
    const auto value = [&](double a, double k) {
      DesignPoint moved = point;
      moved.values = {a, k};
      return objective(moved, oscillation(a, k))->value;
    };
    const auto score = objective(point, oscillation(1.8, 1.2));
    ASSERT_TRUE(score);
    ASSERT_EQ(score->residuals.size(), kRecorded + 3U);
    double by_a = 0.0, by_k = 0.0;
    for (std::size_t i = 0; i < score->residuals.size(); ++i) {
      by_a += 2.0 * score->residuals[i] * score->jacobian[2 * i];
      by_k += 2.0 * score->residuals[i] * score->jacobian[2 * i + 1];
    }
    constexpr double h = 1e-5;
    EXPECT_NEAR(
        (value(1.8 + h, 1.2) - value(1.8 - h, 1.2)) / (2.0 * h), by_a, 1e-6 * std::abs(by_a));
    EXPECT_NEAR(
        (value(1.8, 1.2 + h) - value(1.8, 1.2 - h)) / (2.0 * h), by_k, 1e-6 * std::abs(by_k));
  }
}

TEST_F(NuisanceNumbers, AnOffsetGivesExactSlopesOfEveryDifference) {
  measure(0.1, 0.0, 0.0, 7);
  const Study s = study("nuisance = {offset = \"free\"}\n");
  const auto differences = [&](double k) {
    return compare(s.experiments[0], s.experiments, oscillation(1.8, k)).differences;
  };
  constexpr double h = 1e-5;
  const auto more = differences(1.2 + h), less = differences(1.2 - h);
  const Comparison c = compare(s.experiments[0], s.experiments, oscillation(1.8, 1.2));
  for (std::size_t i = 0; i < more.size(); ++i)
    EXPECT_NEAR((more[i] - less[i]) / (2.0 * h), c.slopes[2 * i + 1], 1e-6);
}

TEST_F(NuisanceNumbers, AreFoundAgainInARecordingWithoutNoise) {
  measure(0.0, 0.0, 0.0, 8);
  std::ofstream out(folder_ / "measured.csv");
  out << "t [s],y [N]\n";
  out.precision(17);
  const Channels truth = oscillation(2.0, 1.5);
  for (int i = 0; i < kRecorded; ++i)
    out << kRecordedStep * i << ','
        << 1.04 * oscillation_at(truth, kRecordedStep * i - 0.0173).y - 0.3 << '\n';
  out.close();
  const Study s = study("nuisance = {offset = \"free\", gain = \"free\", delay = \"free\"}\n");
  const Comparison c = compare(s.experiments[0], s.experiments, truth);
  EXPECT_NEAR(c.nuisance[0].value, -0.3, 1e-9);
  EXPECT_NEAR(c.nuisance[1].value, 0.04, 1e-9);
  EXPECT_NEAR(c.nuisance[2].value, 0.0173, 1e-9);
  EXPECT_LT(c.largest_error, 1e-9);
}

TEST_F(NuisanceNumbers, EachLeavesOneDegreeOfFreedomLess) {
  measure(0.1, 0.03, 0.02, 9);
  const Study s = study(std::string(kStated) + "nuisance = {offset = \"free\", gain = \"3 %\"}\n");
  const ResidualTraits traits = residual_traits(s);
  EXPECT_EQ(traits.deviations.size(), kRecorded + 1U);  // the prior of the gain is one more value
  EXPECT_EQ(traits.solved.size(), 2U);
  EXPECT_EQ(residual_rows(s).size(), kRecorded + 1U);
  EXPECT_EQ(prior_count(s), 1U);
}

// A mean that is removed is an offset that every trial solves.
TEST_F(NuisanceNumbers, AMeanCostsADegreeOfFreedomAsAFreeOffsetDoes) {
  measure(0.1, 0.0, 0.0, 11);
  const Study about_mean = study("compare = \"about_mean\"\n");
  const Study offset = study("nuisance = {offset = \"free\"}\n");
  ASSERT_EQ(residual_traits(about_mean).solved.size(), 1U);
  EXPECT_EQ(residual_traits(about_mean).solved, residual_traits(offset).solved);
  EXPECT_EQ(solved_numbers(about_mean, 0), solved_numbers(offset, 0));
}

TEST_F(NuisanceNumbers, ADifferenceOfTemperaturesIsNoTemperature) {
  std::ofstream(folder_ / "measured.csv") << "t [s],y [K]\n0,300\n1,310\n";
  scale_.clear();
  refused("noise = \"2 degC\"\n", "expected \"2 K\"", "y [K]");
  refused("noise = \"3.6 degF\"\n", "expected \"2 K\"", "y [K]");
  refused("noise = \"2 %\"\n", "absolute zero", "y [K]");
  refused("scale = \"10 degC\"\n", "expected \"10 K\"", "y [K]");
  refused("noise = \"1 K\"\nnuisance = {offset = \"3 degC\"}\n", "expected \"3 K\"", "y [K]");
  EXPECT_DOUBLE_EQ(study("noise = \"2 K\"\n", "y [K]").experiments[0].noise->absolute, 2.0);
}

TEST_F(NuisanceNumbers, AreRefusedWhereTheyHaveNoMeaning) {
  measure(0.0, 0.0, 0.0, 10);
  const auto given = [](const std::string& numbers, const std::string& more = kStated) {
    return more + "nuisance = {" + numbers + "}\n";
  };
  refused(given("ofset = \"20 N\""), "did you mean \"offset\"");
  refused(given(""), "is empty");
  refused(given("offset = \"2 mm\""), "N");
  refused(given("gain = \"-1 %\""), "more than 0");
  refused(given("offset = \"2 N\"", ""), "expected noise in the experiment");
  refused(given("delay = \"0.2 s\""), "longer than a tenth of the record");
  refused(given("x_offset = \"2 ms\""), "expected delay");
  refused(given("offset = \"2 N\"", std::string(kStated) + "compare = \"about_mean\"\n"),
          "already removes it");
  scale_.clear();
  refused(given("gain = \"2 %\"", "compare = \"psd\"\nnoise = \"2 %\"\n"), "know no delay");
  refused(given("gain = \"2 %\"", std::string(kStated) + "use = \"predict\"\n"), "only predicted");
  std::ofstream(folder_ / "measured.csv") << "t [s],y [K]\n0,300\n1,310\n";
  refused("noise = \"1 K\"\nnuisance = {gain = \"1 %\"}\n", "no zero", "y [K]");
}

}  // namespace
}  // namespace latsch::correlation
