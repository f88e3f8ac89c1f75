// SPDX-License-Identifier: Apache-2.0
// Campaigns of a Magic Formula with two coefficients, against exhaustive search by differences of
// its forces.
#include "correlation/campaign/campaign.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "correlation/campaign/campaign_files.h"
#include "correlation/search/study_reuse_testing.h"
#include "experiment/language.h"

namespace latsch::correlation {
namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr double kForceNoise = 50.0;  // N

double determinant_of(const Eigen::Matrix2d& M) { return M(0, 0) * M(1, 1) - M(0, 1) * M(1, 0); }

/// Returns the deviations of both variables by their information.
Eigen::Vector2d deviations_of(const Eigen::Matrix2d& M) {
  return (Eigen::Vector2d(M(1, 1), M(0, 0)) / determinant_of(M)).cwiseSqrt();
}

class CampaignOfStudy : public FittedStudy {
 protected:
  /// Reads the study with priors of both variables and this [design].
  Study with_design(const std::string& design) {
    std::string text = kHead + "noise = \"2 %\"\nexponent = 2\n" + design;
    const auto put = [&](const std::string& before, const std::string& after) {
      text.replace(text.find(before), before.size(), after);
    };
    put("initial = 0.7", "initial = 1.3\nprior = 1.3\nprior_sigma = 0.3");
    put("initial = -10", "initial = -22\nprior = -22\nprior_sigma = 8");
    write("study.toml", text);
    return read_study(folder_ / "study.toml", experiment::language());
  }
  static std::string design(const std::string& more) {
    return "[design]\ntest = \"steady\"\nnoise = \"50 N\"\n"
           "settings = {Fz = [\"2 kN\", \"6 kN\"], alpha = [\"-12 deg\", \"12 deg\"]}\n" +
           more;
  }
  static CampaignPlan plan_of(const Study& study) {
    CampaignPlan plan{study, *start_before_fit(study), nullptr};
    plan.slopes = computed_slopes(study, {plan.start.point});
    return plan;
  }
  static Campaign campaign_of(const Study& study, int count) {
    const auto found = plan_campaign(plan_of(study), count);
    EXPECT_TRUE(found) << (found ? "" : found.failure().reason);
    return *found;
  }
  /// Returns the side force, N, of a specimen with these coefficients.
  static double force(const Study& study, const DesignPoint& point, double Fz, double alpha) {
    experiment::MovableTest test = *study.campaign->movable;
    test.set("states.Fz", Fz);
    test.set("states.alpha", alpha);
    const auto specimen = study.specimens->at(study, point);
    return (*test.test()->run(*specimen))["Fy"].front();
  }
  /// Returns the slopes of the force in units of its noise, by differences in the unit cube.
  static Eigen::RowVector2d row(const Study& study, double Fz, double alpha) {
    Eigen::RowVector2d J;
    const std::vector<double> center = study.space.to_unit(study.space.initial());
    constexpr double kStep = 1e-4;
    for (int i = 0; i < 2; ++i) {
      std::vector<double> up = center, down = center;
      up[static_cast<std::size_t>(i)] += kStep;
      down[static_cast<std::size_t>(i)] -= kStep;
      J[i] = (force(study, study.space.from_unit(up), Fz, alpha) -
              force(study, study.space.from_unit(down), Fz, alpha)) /
             (2.0 * kStep * kForceNoise);
    }
    return J;
  }
  /// Returns the information of the bounds and of both priors.
  static Eigen::Matrix2d known(const Study& study) {
    Eigen::Matrix2d M = 12.0 * Eigen::Matrix2d::Identity();
    M(0, 0) += std::pow((study.space[0].upper - study.space[0].lower) / 0.3, 2);
    M(1, 1) += std::pow((study.space[1].upper - study.space[1].lower) / 8.0, 2);
    return M;
  }
};

TEST_F(CampaignOfStudy, TwoTestsAreAsGoodAsTheBestPairOfAGrid) {
  const Study study = with_design(design("limits = [\"Fz * abs(alpha) <= 30 kN deg\"]\n"));
  const Campaign campaign = campaign_of(study, 2);
  std::vector<Eigen::RowVector2d> rows;
  constexpr int kLevels = 25;
  for (int a = 0; a < kLevels; ++a)
    for (int b = 0; b < kLevels; ++b) {
      const double Fz = 2000.0 + 4000.0 * a / (kLevels - 1);
      const double alpha = (-12.0 + 24.0 * b / (kLevels - 1)) * kDegree;
      if (Fz * std::abs(alpha) <= 30e3 * kDegree) rows.push_back(row(study, Fz, alpha));
    }
  double most = 0.0;
  for (const auto& a : rows)
    for (const auto& b : rows)
      most = std::max(most, determinant_of(known(study) + a.transpose() * a + b.transpose() * b));
  Eigen::Matrix2d M = known(study);
  for (const CampaignTest& test : campaign.tests) {
    EXPECT_LE(test.values[0] * std::abs(test.values[1]), 30e3 * kDegree * (1.0 + 1e-6));
    const Eigen::RowVector2d J = row(study, test.values[0], test.values[1]);
    M += J.transpose() * J;
  }
  // rounding to a hundredth of the ranges may cost some thousandths of the criterion
  EXPECT_GT(std::sqrt(determinant_of(M)), 0.99 * std::sqrt(most));
}

TEST_F(CampaignOfStudy, IntervalsAreThoseOfTheInformation) {
  const Study study = with_design(design(""));
  const Campaign campaign = campaign_of(study, 5);
  ASSERT_EQ(campaign.standings.size(), 3u);
  EXPECT_EQ(campaign.standings[1].tests, 4);
  Eigen::Matrix2d M = known(study);
  const auto expect_standing = [&](const CampaignStanding& standing) {
    const Eigen::Vector2d expected = deviations_of(M);
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(standing.deviations[i], expected[i], 1e-5 * expected[i]);
  };
  expect_standing(campaign.standings[0]);
  for (std::size_t k = 0; k < 5; ++k) {
    const Eigen::RowVector2d J =
        row(study, campaign.tests[k].values[0], campaign.tests[k].values[1]);
    M += J.transpose() * J;
    if (k == 3) expect_standing(campaign.standings[1]);
  }
  expect_standing(campaign.standings[2]);
}

TEST_F(CampaignOfStudy, TheVarianceOfOneVariableIsLeastByItsOwnCriterion) {
  const Study stiffness = with_design(design("criterion = \"c\"\nof = \"stiffness\"\n"));
  const Campaign own = campaign_of(stiffness, 4);
  const Campaign grip = campaign_of(with_design(design("criterion = \"c\"\nof = \"grip\"\n")), 4);
  EXPECT_LT(own.standings.back().deviations[1], 0.8 * grip.standings.back().deviations[1]);
  EXPECT_LT(grip.standings.back().deviations[0], 0.8 * own.standings.back().deviations[0]);
}

TEST_F(CampaignOfStudy, EachTestIsAFileThatRunsAndGivesItsForce) {
  const Study study = with_design(design(""));
  const Campaign campaign = campaign_of(study, 3);
  const auto folder = folder_ / "next";
  write_campaign_tests(study, campaign, folder);
  for (std::size_t k = 0; k < campaign.tests.size(); ++k) {
    const auto file = folder / campaign_test_file(campaign, k);
    const auto test = experiment::language().read_test(file);
    const auto specimen = study.specimens->at(study, study.space.initial());
    EXPECT_NEAR(
        (*test->run(*specimen))["Fy"].front(),
        force(
            study, study.space.initial(), campaign.tests[k].values[0], campaign.tests[k].values[1]),
        1e-9);
  }
  // files of an earlier, longer design go; a file of somebody else stays
  write_text_file(folder / "mine.toml", "kind = \"mine\"\n");
  write_campaign_tests(study, campaign_of(study, 1), folder);
  EXPECT_TRUE(std::filesystem::exists(folder / "mine.toml"));
  EXPECT_FALSE(std::filesystem::exists(folder / "test_03.toml"));
}

TEST_F(CampaignOfStudy, KrigedSlopesChooseTestsAsGoodAsComputedOnes) {
  const Study study = with_design(design("runs = 60\n"));
  CampaignPlan plan = plan_of(study);
  const Campaign computed = *plan_campaign(plan, 4);
  const auto kriged = kriged_slopes(study, plan.start.point, plan.start.lengths, RunOptions{});
  ASSERT_TRUE(kriged && *kriged) << (*kriged ? "" : kriged->failure().reason);
  EXPECT_EQ((*kriged)->trials, 1);  // the model computes its slopes, so one trial has them all
  EXPECT_GT((*kriged)->least_values, 0.9);
  const auto criterion = [&](const Campaign& campaign) {
    Eigen::Matrix2d M = known(study);
    for (const CampaignTest& test : campaign.tests) {
      const Eigen::RowVector2d J = row(study, test.values[0], test.values[1]);
      M += J.transpose() * J;
    }
    return std::sqrt(determinant_of(M));
  };
  plan.slopes = computed_slopes(study, {plan.start.point});
  const double best = criterion(computed);
  CampaignPlan interpolated{study, plan.start, nullptr, false};
  interpolated.slopes = std::move(const_cast<KrigedSlopes&>(**kriged).slopes);
  const Campaign other = *plan_campaign(interpolated, 4);
  EXPECT_GT(criterion(other), 0.95 * best);
  EXPECT_EQ(other.ends, 0);
  EXPECT_FALSE(other.why_no_ends.empty());
}

TEST_F(CampaignOfStudy, WhatCannotBeDesignedIsRefusedWithAReason) {
  const auto reason = [&](const std::string& text) -> std::string {
    try {
      with_design(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [&](const std::string& text, const std::string& words) {
    EXPECT_NE(reason(text).find(words), std::string::npos) << reason(text);
  };
  says("[design]\ntest = \"stedy\"\nsettings = {Fz = [\"2 kN\", \"6 kN\"]}\n", "steady");
  says("[design]\ntest = \"steady\"\nsettings = {alhpa = [\"0 deg\", \"6 deg\"]}\n",
       "did you mean \"alpha\"?");
  says("[design]\ntest = \"steady\"\nsettings = {Fz = [\"2 bar\", \"6 bar\"]}\n", "bar");
  says("[design]\ntest = \"steady\"\nsettings = {Fz = [\"6 kN\", \"2 kN\"]}\n", "no range");
  says("[design]\ntest = \"steady\"\nsettings = {Fz = [\"-2 kN\", \"2 kN\"]}\n", "-2 kN");
  says("[design]\ntest = \"steady\"\nsettings = {alpha = [\"-10 rad\", \"10 rad\"]}\n",
       "-90 .. 90 deg");
  says(design("criterion = \"I\"\n"), "of is missing");
  says(design("criterion = \"c\"\n"), "of is missing");
  says(design("criterion = \"T\"\n"), "against is missing");
  says(design("of = \"grip\"\n"), "belongs to criterion");
  says(design("criterion = \"c\"\nof = \"grib\"\n"), "grip");
  says(design("limits = [\"Fz <= 4 deg\"]\n"), "compares N with rad");
  says(design("measures = [\"Fyy\"]\n"), "did you mean \"Fy\"?");
  says(design("cost = {pressure = 3}\n"), "none of the settings");
  says(design("count = 0\n"), "count");
}

TEST_F(CampaignOfStudy, SettingsWithoutEffectAreNamed) {
  EXPECT_TRUE(campaign_of(with_design(design("")), 3).idle.empty());
  // The cornering stiffness is that at no slip, whatever the slip angle.
  const Study study = with_design(
      "[design]\ntest = \"steady\"\nnoise = \"500 N/rad\"\nmeasures = [\"Kya\"]\n"
      "settings = {Fz = [\"2 kN\", \"6 kN\"], alpha = [\"-12 deg\", \"12 deg\"]}\n");
  EXPECT_EQ(campaign_of(study, 3).idle, std::vector<std::string>{"alpha"});
}

TEST_F(CampaignOfStudy, LimitsThatLeaveNothingAreAFailure) {
  const Study study = with_design(design("limits = [\"Fz >= 7 kN\"]\n"));
  const auto found = plan_campaign(plan_of(study), 2);
  ASSERT_FALSE(found);
  EXPECT_NE(found.failure().reason.find("leave no settings"), std::string::npos);
}

TEST_F(CampaignOfStudy, AStudyWithoutFitAndPriorsHasNoDesign) {
  write("study.toml", kHead + "noise = \"2 %\"\nexponent = 2\n" + design(""));
  const Study study = read_study(folder_ / "study.toml", experiment::language());
  const auto start = start_before_fit(study);
  ASSERT_FALSE(start);
  EXPECT_NE(start.failure().reason.find("latsch run"), std::string::npos);
}

// At zero slip angle no side force depends on grip or stiffness, whatever the load.
TEST_F(CampaignOfStudy, SettingsThatTouchNoVariableAreRefused) {
  write("steady.toml", "kind = \"steady_states\"\nstates = {Fz = \"4 kN\", alpha = \"0 deg\"}\n");
  write("measured.csv", "Fy [N]\n100\n");
  const Study study = with_design(
      "[design]\ntest = \"steady\"\nnoise = \"50 N\"\nsettings = {Fz = [\"2 kN\", \"6 kN\"]}\n");
  const auto found = plan_campaign(plan_of(study), 2);
  ASSERT_FALSE(found);
  EXPECT_NE(found.failure().reason.find("no setting changes"), std::string::npos);
}

// Forces at a small slip angle determine only the stiffness, so the grip, which has no prior here,
// is named.
TEST_F(CampaignOfStudy, ADirectionThatNoSettingTouchesIsNamed) {
  Study study = with_design(
      "[design]\ntest = \"steady\"\nnoise = \"50 N\"\nsettings = {alpha = [\"0 deg\", \"0.1 "
      "deg\"]}\n");
  std::vector<DesignVariable> variables = study.space.variables();
  variables[0].prior.reset();
  study.space = DesignSpace(variables);
  const Campaign campaign = campaign_of(study, 4);
  ASSERT_EQ(campaign.untouched.size(), 1u);
  EXPECT_EQ(campaign.untouched[0], "grip");
}

}  // namespace
}  // namespace latsch::correlation
