// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/own_stages.h"

#include <gmock/gmock.h>

#include <cmath>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/refit_trials.h"
#include "correlation/search/study_reuse_testing.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/compared_trial.h"

namespace latsch::correlation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// The model cannot reproduce both measurements: the side force has a ripple of half a percent, and
// the aligning moment belongs to another side force.
class OwnStages : public FittedStudy {
 protected:
  OwnStages() {
    std::string torques = "Mz [N m]\n";
    for (int i = -12; i <= 12; ++i) torques += std::to_string(i) + "\n";
    write("arm.csv", torques);
    const Study study = read("exponent = 2\n" + more("", 2));
    const auto recorded = [&](const DesignPoint& at, const char* channel) {
      return (*evaluator(study)(at))[std::string("steady/") + channel];
    };
    std::vector<double> Fy = recorded({{1.3, -22.0, 0.12}}, "Fy");
    for (std::size_t i = 0; i < Fy.size(); ++i) Fy[i] += 30.0 * std::sin(2.0 * double(i));
    Channels force, moment;
    force.add({"Fy", "N", Fy});
    moment.add({"Mz", "N m", recorded({{1.0, -40.0, 0.12}}, "Mz")});
    write("measured.csv", formats::csv_text(force));
    write("arm.csv", formats::csv_text(moment));
  }

  /// Returns the text of the study after its head; `keys` are keys that both experiments state.
  static std::string more(const std::string& keys, int exponent) {
    return keys +
           "[experiment.arm]\nkind = \"curve\"\ny = \"steady/Mz\"\nmeasurement = \"arm.csv\"\n" +
           "exponent = " + std::to_string(exponent) + "\n" + keys +
           "[variable.trail]\npath = \"QDZ1\"\nlower = 0.01\nupper = 0.3\ninitial = 0.05\n";
  }
  static inline const std::string kStages =
      "[stage.force]\nfree = [\"stiffness\", \"grip\"]\nexperiments = [\"light\"]\n"
      "[stage.moment]\nfree = [\"trail\"]\nexperiments = [\"arm\"]\n";

  Study study_of(const std::string& keys, const std::string& last, int exponent = 2) {
    return read("exponent = " + std::to_string(exponent) + "\n" + more(keys, exponent) + kStages +
                last);
  }

  struct Told {
    std::vector<OwnStage> own;
    double force = 0.0;  // error of the side force at the result of the fit
    std::vector<std::string> words;
    Study as_last;
  };
  Told told_by(const Study& study) {
    std::filesystem::remove(folder_ / "study.latsch");
    fit_all(study);
    const Journal journal = Journal::read(study.run.journal);
    const StagesRun stages = recorded_stages(study, journal);
    const auto best = best_trial(stages.study, journal);
    const Comparison force =
        compare(study.experiments[0], study.experiments, *evaluator(study)(best->point));
    return {stages.fits.back().own,
            own_measure(study.experiments[0], force),
            spoiled_experiments(stages, journal),
            stages.study};
  }
};

TEST_F(OwnStages, AnExperimentThatTheLastStageSpoilsIsNamedWithBothErrors) {
  const Told told = told_by(study_of("", "[stage.all]\n"));
  ASSERT_EQ(told.own.size(), 2u);
  EXPECT_EQ(told.own[0].stage, "force");
  EXPECT_EQ(told.own[1].stage, "moment");
  EXPECT_GT(told.force, 1.5 * told.own[0].error);
  EXPECT_THAT(told.words,
              ElementsAre(testing::AllOf(HasSubstr("light is worse"), HasSubstr("stage force"))));
}

TEST_F(OwnStages, NoiseOfTheOwnStageKeepsWhatItHad) {
  const Told told = told_by(study_of("noise = \"own_stage\"\n", "[stage.all]\n"));
  EXPECT_LE(told.force, 1.05 * told.own[0].error);
  EXPECT_TRUE(told.words.empty());
  EXPECT_NEAR(told.as_last.experiments[0].noise->relative, told.own[0].rms, 1e-12);
}

// Here the target is the mean of the errors, not of their squares, so the result fits only the
// experiment with the larger weight.
TEST_F(OwnStages, AMeasureOfAnotherExponentIsToldAsWell) {
  std::string text = "exponent = 1\n" + more("", 1) + kStages + "[stage.all]\n";
  const std::string arm = "[experiment.arm]\n";
  text.insert(text.find(arm) + arm.size(), "weight = 100\n");
  const Told told = told_by(read(text));
  EXPECT_GT(told.force, 1.05 * told.own[0].error);
  EXPECT_THAT(told.words,
              ElementsAre(HasSubstr("light is worse than after an earlier stage: mean")));
}

TEST_F(OwnStages, StatedNoiseThatIsNotExceededIsNoFault) {
  const Told told = told_by(study_of("noise = \"60 %\"\n", "[stage.all]\n"));
  EXPECT_GT(told.force, 1.05 * told.own[0].error);
  EXPECT_TRUE(told.words.empty());
}

TEST_F(OwnStages, ALastStageMayNameItsExperimentsAndVariables) {
  const Told told =
      told_by(study_of("", "[stage.last]\nfree = [\"trail\"]\nexperiments = [\"arm\"]\n"));
  // no variable that is free changes the side force
  EXPECT_NEAR(told.force, told.own[0].error, 1e-12);
  EXPECT_TRUE(told.words.empty());
  EXPECT_EQ(told.as_last.experiments[0].objective.weight, 0.0);
  EXPECT_EQ(told.as_last.free, std::vector<int>{2});
}

// An experiment that is not fitted in the last stage may become worse because of the variables that
// are free in that stage.
TEST_F(OwnStages, WhatDoesNotCountInTheLastStageIsToldToo) {
  const Told told = told_by(study_of("", "[stage.last]\nexperiments = [\"arm\"]\n"));
  EXPECT_GT(told.force, 1.5 * told.own[0].error);
  EXPECT_THAT(told.words, ElementsAre(HasSubstr("light is worse")));
}

TEST_F(OwnStages, TrialsForIntervalsLeaveHeldVariablesWhereTheyAre) {
  for (const char* method : {"levenberg_marquardt", "gss"}) {
    std::filesystem::remove(folder_ / "study.latsch");
    std::filesystem::remove(RefitTrials::file(folder_ / "study.latsch"));
    const Study study =
        read("exponent = 2\n" + more("", 2) + kStages +
             "[stage.last]\nfree = [\"stiffness\", \"grip\"]\n[optimizer]\nmethod = \"" + method +
             "\"\n");
    fit_all(study);
    Journal journal = Journal::open(study.run.journal, identity(study));
    const Study last = with_estimated_noise(study, journal);
    const DesignPoint best = best_trial(last, journal)->point;
    const long before = journal.size();
    InlineExecutor executor(evaluator(last));
    const auto what = identify(last, best, Depth::profiles, executor, journal, {});
    ASSERT_TRUE(what && *what) << method;
    long number = 0, taken = 0;
    const auto is_held = [&](const Trial& trial) {
      ++taken;
      EXPECT_EQ(trial.point.values[2], best.values[2]) << method;
    };
    journal.for_each([&](const Trial& trial) {
      if (number++ >= before) is_held(trial);
    });
    const auto refits = RefitTrials::file(study.run.journal);
    if (std::filesystem::exists(refits)) Journal::read(refits).for_each(is_held);
    EXPECT_GT(taken, 0) << method;
    const Confidence& c = (*what)->identification.confidence();
    EXPECT_EQ(c.intervals[2].lower, c.intervals[2].upper);
    EXPECT_EQ((*what)->identification.profiles().size(), 2u);
    // The result is the same as without the third variable.
    EXPECT_EQ(c.singular_values.size(), 2);
    EXPECT_TRUE(c.covariance.row(2).isZero() && c.covariance.col(2).isZero());
    EXPECT_GT(c.covariance(0, 0), 0.0);
  }
}

}  // namespace
}  // namespace latsch::correlation
