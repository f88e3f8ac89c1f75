// SPDX-License-Identifier: Apache-2.0
// Tests of nuisance numbers that two recordings share, against one least-squares problem in which
// all numbers of both are variables, and of what is refused.
#include "correlation/nuisance/shared_numbers.h"

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

/// Places of the numbers of one recording among all unknowns; -1: it has no such number.
struct Places {
  std::string name;
  double start = 0.0;  // time of its first sample, s
  int offset = -1, gain = -1, delay = -1;
};

/// All unknowns: a, k and the nuisance numbers, with the deviations of their priors.
struct SharedCase {
  std::string settings;
  std::vector<Places> recordings;
  Eigen::VectorXd sigma;  // deviations of the nuisance numbers' priors
  Eigen::VectorXd truth;  // the numbers themselves
};

double number(const Eigen::VectorXd& p, int place) { return place < 0 ? 0.0 : p[place]; }

class SharedNumbers : public testing::Test {
 protected:
  void measure(const SharedCase& one, std::uint64_t seed) {
    RandomStream random(seed, 0);
    const Channels truth = oscillation(2.0, 1.5);
    Eigen::VectorXd p(2 + one.truth.size());
    p << 2.0, 1.5, one.truth;
    for (const Places& its : one.recordings) {
      std::ofstream out(folder_ / (its.name + ".csv"));
      out << "t [s],y [N]\n";
      out.precision(17);
      std::vector<double>& values = measured_.emplace_back();
      for (int i = 0; i < kRecorded; ++i) {
        const double t = its.start + kRecordedStep * i;
        values.push_back((1.0 + number(p, its.gain)) *
                             oscillation_at(truth, t - number(p, its.delay)).y +
                         number(p, its.offset) + kRecordedNoise * random.normal());
        out << t << ',' << values.back() << '\n';
      }
    }
  }

  Study study(const std::string& settings) {
    std::ofstream(folder_ / "in.txt") << "{a} {k}";
    std::ofstream(folder_ / "study.toml") << R"([simulator]
command = ["/bin/true"]
inputs = ["in.txt"]
[simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["t [s]", "y [N]"]
[variable.a]
lower = 0.1
upper = 9
initial = 1.8
[variable.k]
lower = 0.1
upper = 9
initial = 1.2
)" << settings;
    return read_study(folder_ / "study.toml", experiment::language());
  }

  void refused(const std::string& settings, const std::string& part) {
    try {
      study(settings);
      FAIL() << settings;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  /// Residuals and slopes of the problem in which all numbers are variables as a and k.
  std::pair<Eigen::VectorXd, Eigen::MatrixXd> all_unknowns(const SharedCase& one,
                                                           const Eigen::VectorXd& p) const {
    const Channels channels = oscillation(p[0], p[1]);
    const Eigen::Index m = kRecorded * std::ssize(one.recordings), n = p.size();
    Eigen::VectorXd r = Eigen::VectorXd::Zero(m + n);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(m + n, n);
    Eigen::Index row = 0;
    for (std::size_t e = 0; e < one.recordings.size(); ++e) {
      const Places& its = one.recordings[e];
      for (int i = 0; i < kRecorded; ++i, ++row) {
        const double times = 1.0 + number(p, its.gain);
        const CurvePoint s =
            oscillation_at(channels, its.start + kRecordedStep * i - number(p, its.delay));
        r[row] = measured_[e][static_cast<std::size_t>(i)] - times * s.y - number(p, its.offset);
        J(row, 0) = -times * s.by_a;
        J(row, 1) = -times * s.by_k;
        if (its.offset >= 0) J(row, its.offset) = -1.0;
        if (its.gain >= 0) J(row, its.gain) = -s.y;
        if (its.delay >= 0) J(row, its.delay) = times * s.by_t;
      }
    }
    r /= kRecordedNoise;
    J /= kRecordedNoise;
    for (Eigen::Index k = 2; k < n; ++k) {
      if (!std::isfinite(one.sigma[k - 2])) continue;
      r[m + k] = p[k] / one.sigma[k - 2];
      J(m + k, k) = 1.0 / one.sigma[k - 2];
    }
    return {r, J};
  }

  ScratchFolder folder_;
  std::vector<std::vector<double>> measured_;
};

std::string recording(const std::string& name, const std::string& nuisance) {
  return "[experiment." + name +
         "]\nkind = \"curve\"\nx = \"out/t\"\ny = \"out/y\"\nmeasurement = \"" + name +
         ".csv\"\nexponent = 2\nscale = \"2 N\"\nnoise = \"0.05 N\"\nnuisance = {" + nuisance +
         "}\n";
}

SharedCase one_cell() {
  return {"[nuisance.cell]\ngain = \"3 %\"\ndelay = \"free\"\n" +
              recording("light", "offset = \"0.2 N\", gain = \"cell\", delay = \"cell\"") +
              recording("heavy", "offset = \"0.2 N\", gain = \"cell\", delay = \"cell\""),
          {{"light", 0.0, 2, 4, 5}, {"heavy", 0.3, 3, 4, 5}},
          Eigen::Vector4d(0.2, 0.2, 0.03, INFINITY),
          Eigen::Vector4d(0.1, -0.15, 0.04, 0.02)};
}

/// Two recordings share an offset and have delays of their own; one has a gain.
SharedCase one_zero() {
  return {"[nuisance.zero]\noffset = \"0.2 N\"\n" +
              recording("light", "offset = \"zero\", gain = \"3 %\", delay = \"20 ms\"") +
              recording("heavy", "offset = \"zero\", delay = \"free\""),
          {{"light", 0.0, 2, 3, 4}, {"heavy", 0.3, 2, -1, 5}},
          Eigen::Vector4d(0.2, 0.03, 0.02, INFINITY),
          Eigen::Vector4d(0.1, 0.03, 0.02, -0.015)};
}

TEST_F(SharedNumbers, AgreeWithAFitOfAllUnknownsTogether) {
  for (const SharedCase& one : {one_cell(), one_zero()}) {
    measured_.clear();
    measure(one, 5);
    const Study s = study(one.settings);
    const Objective objective = residual_objective(s);
    DesignPoint point = s.space.initial();
    Eigen::VectorXd p = Eigen::VectorXd::Zero(2 + one.sigma.size());
    p.head(2) << point.values[0], point.values[1];
    Score score;
    Eigen::MatrixXd J;
    for (int step = 0; step < 40; ++step) {
      const auto found = objective(point, oscillation(point.values[0], point.values[1]));
      ASSERT_TRUE(found) << found.failure().reason;
      score = *found;
      J = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          score.jacobian.data(), std::ssize(score.residuals), 2);
      const Eigen::VectorXd move =
          -(J.transpose() * J).inverse() * J.transpose() * to_vector(score.residuals);
      point.values[0] += move[0];
      point.values[1] += move[1];
      const auto [r, all] = all_unknowns(one, p);
      p -= (all.transpose() * all).inverse() * all.transpose() * r;
    }
    const auto [r, all] = all_unknowns(one, p);
    EXPECT_NEAR(point.values[0], p[0], 1e-6) << one.settings;
    EXPECT_NEAR(point.values[1], p[1], 1e-6);
    EXPECT_NEAR(score.value, r.squaredNorm(), 1e-6 * score.value);
    const Eigen::MatrixXd covariance = (all.transpose() * all).inverse();
    const Eigen::MatrixXd own = (J.transpose() * J).inverse();
    EXPECT_LT((own - covariance.topLeftCorner(2, 2)).norm(), 1e-5 * own.norm());
    // The deviation of a number at given variables is that of the block of all numbers.
    const Eigen::Index count = one.sigma.size();
    const Eigen::MatrixXd numbers =
        (all.rightCols(count).transpose() * all.rightCols(count)).inverse();
    const Channels best = oscillation(point.values[0], point.values[1]);
    const auto comparisons = compare_all(s.experiments, best);
    ASSERT_TRUE(comparisons);
    for (std::size_t e = 0; e < comparisons->size(); ++e) {
      const Places& its = one.recordings[e];
      const Comparison alone = compare(s.experiments[e], s.experiments, best);
      for (std::size_t k = 0; k < (*comparisons)[e].nuisance.size(); ++k) {
        const SolvedNumber& solved = (*comparisons)[e].nuisance[k];
        const int place = solved.kind == NuisanceKind::offset ? its.offset
                          : solved.kind == NuisanceKind::gain ? its.gain
                                                              : its.delay;
        EXPECT_NEAR(solved.value, p[place], 1e-6) << its.name << ' ' << name_of(solved.kind);
        const double deviation = std::sqrt(numbers(place - 2, place - 2));
        // in units of a difference of 2 N, of which 0.05 N is the noise
        EXPECT_NEAR(solved.deviation, deviation, 1e-5 * deviation)
            << its.name << ' ' << name_of(solved.kind);
        EXPECT_NEAR(alone.nuisance[k].value, solved.value, 1e-12);
      }
      EXPECT_LT((to_vector(alone.differences) - to_vector((*comparisons)[e].differences)).norm(),
                1e-12);
    }
  }
}

TEST_F(SharedNumbers, GiveTheExactSlopeOfTheSumOfSquares) {
  for (const SharedCase& one : {one_cell(), one_zero()}) {
    measured_.clear();
    measure(one, 6);
    const Study s = study(one.settings);
    for (const Objective& objective : {residual_objective(s), objective(s)}) {
      const auto value = [&](double a, double k) {
        DesignPoint moved = s.space.initial();
        moved.values = {a, k};
        return objective(moved, oscillation(a, k))->value;
      };
      const auto score = objective(s.space.initial(), oscillation(1.8, 1.2));
      ASSERT_TRUE(score);
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
}

TEST_F(SharedNumbers, CountOnce) {
  measure(one_cell(), 7);
  const Study s = study(one_cell().settings);
  const ResidualTraits traits = residual_traits(s);
  // the priors of two offsets and of one gain
  EXPECT_EQ(traits.deviations.size(), 2U * kRecorded + 3U);
  EXPECT_EQ(traits.solved.size(), 4U);
  EXPECT_EQ(prior_count(s), 3U);
  EXPECT_EQ(solved_numbers(s, 0), 3);
  EXPECT_EQ(solved_numbers(s, 1), 1);
  const auto rows = residual_rows(s);
  ASSERT_EQ(rows.size(), traits.deviations.size());
  EXPECT_EQ(rows[2 * kRecorded + 1].name, "prior of gain of [nuisance.cell]");
  const auto score = residual_objective(s)(s.space.initial(), oscillation(1.8, 1.2));
  ASSERT_TRUE(score);
  EXPECT_EQ(score->residuals.size(), rows.size());
  // The residuals change by the shared gain in both recordings and in its prior.
  const Eigen::VectorXd& gain = traits.solved[1];
  EXPECT_GT(gain.head(kRecorded).norm(), 1.0);
  EXPECT_GT(gain.segment(kRecorded, kRecorded).norm(), 1.0);
  EXPECT_DOUBLE_EQ(gain[2 * kRecorded + 1], 1.0 / 0.03);
}

TEST_F(SharedNumbers, ThePriorCountsWithTheFirstRecordingThatCounts) {
  measure(one_cell(), 8);
  Study s = study(one_cell().settings);
  s.experiments[0].objective.weight = 0.0;
  EXPECT_EQ(prior_count(s), 2U);
  EXPECT_EQ(residual_rows(s)[kRecorded + 1].name, "prior of gain of [nuisance.cell]");
  const auto score = residual_objective(s)(s.space.initial(), oscillation(1.8, 1.2));
  ASSERT_TRUE(score);
  EXPECT_EQ(score->residuals.size(), kRecorded + 2U);
  // A recording without weight takes the gain that the others choose.
  const Channels trial = oscillation(1.8, 1.2);
  const Comparison light = compare(s.experiments[0], s.experiments, trial);
  const Comparison heavy = compare(s.experiments[1], {s.experiments[1]}, trial);
  EXPECT_NEAR(light.nuisance[1].value, heavy.nuisance[1].value, 1e-12);
}

TEST_F(SharedNumbers, AreRefusedWithoutATableOrARecording) {
  measure(one_cell(), 9);
  refused(recording("light", "gain = \"cell\""), "neither a deviation, \"free\", nor a table");
  refused("[nuisance.cell]\noffset = \"1 N\"\n" + recording("light", "gain = \"cell\""),
          "[nuisance.cell] has no gain");
  refused("[nuisance.cell]\ngain = \"1 %\"\n" + recording("light", "offset = \"1 N\""),
          "is named by no recording");
  refused("[nuisance.cell]\n" + recording("light", "offset = \"1 N\""), "is missing");
  refused("[nuisance.cell]\ngain = \"cell\"\n" + recording("light", "gain = \"cell\""), "gain");
  refused("[nuisance.cell]\ngain = \"60 %\"\n" + recording("light", "gain = \"cell\""), "50 %");
  refused(
      "[nuisance.cell]\ngian = \"1 %\"\ngain = \"1 %\"\n" + recording("light", "gain = \"cell\""),
      "gian");
}

}  // namespace
}  // namespace latsch::correlation
