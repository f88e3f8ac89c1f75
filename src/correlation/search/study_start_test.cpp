// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_start.h"

#include <gmock/gmock.h>

#include "correlation/search/stage_runs.h"
#include "correlation/search/study_reuse_testing.h"
#include "correlation/target/best_trial.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch::correlation {
namespace {

class StudyStart : public FittedStudy {
 protected:
  static inline const std::string kDesign = R"([doe]
design = "latin_hypercube"
points = 30
)";
  /// A method without derivatives needs so many trials that the run can be killed and that trials
  /// run ahead of the search.
  static inline const std::string kSearch = "[optimizer]\nmethod = \"residual_trust_region\"\n";

  void evaluate_design(const Study& study, int workers = 1) {
    Journal journal = Journal::open(study.run.journal, identity(study));
    ThreadExecutor executor([&] { return evaluator(study); }, workers);
    ASSERT_EQ(run_doe(plan(*study.doe, study.space), executor, journal), RunEnd::converged);
  }
  double best_of_journal(const Study& study) {
    const Objective target = objective(study);
    double best = 1e9;
    Journal::read(study.run.journal).for_each([&](const Trial& trial) {
      if (trial.outcome.result) best = std::min(best, target(*trial.outcome.result)->value);
    });
    return best;
  }
  std::string complaint(const std::string& more) {
    try {
      read(more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(StudyStart, TheBestTrialOfTheJournalIsTheFirstStepAndItsNeighborsAreKnown) {
  const Study blind = read(kSearch + kDesign + "[run]\njournal = \"blind.latsch\"\n");
  const auto from_values = fit_all(blind);
  const long alone = evaluated_;
  const Study study = read(kSearch + "start = \"journal\"\n" + kDesign);
  evaluate_design(study);
  const double best = best_of_journal(study);
  evaluated_ = 0;
  const auto fits = fit_all(study);
  EXPECT_EQ(fits[0].run.steps.front().outcome->value, best);
  EXPECT_LT(fits[0].run.best()->outcome->value, 1e-5);
  EXPECT_LT(evaluated_, alone);
}

TEST_F(StudyStart, TheFirstPointIsThatOfTheFirstStepUnlessAJournalDecides) {
  const Study study = read(kDesign);
  EXPECT_EQ(first_point(study), fit_all(study)[0].run.steps.front().point);
  EXPECT_EQ(first_point(read(kSearch + "start = \"journal\"\n" + kDesign)), std::nullopt);
}

// Bounds may be narrowed after a run. A trial of the journal outside of the new bounds is then no
// result.
TEST_F(StudyStart, TheBestTrialLiesInTheBoundsAsTheyAreWritten) {
  Study study = read(kDesign);
  fit_all(study);
  const Journal journal = Journal::read(study.run.journal);
  const RatedTrial best = *best_trial(study, journal);
  std::vector<DesignVariable> narrow = study.space.variables();
  narrow[0].upper = best.point.values[0] - 1e-6;
  narrow[0].initial = narrow[0].lower;
  study.space = DesignSpace(narrow);
  const auto inside = best_trial(study, journal);
  ASSERT_TRUE(inside);
  EXPECT_LT(inside->point.values[0], best.point.values[0]);
  EXPECT_GT(inside->target, best.target);
}

TEST_F(StudyStart, AJournalWithoutTheFirstPointKnowsNoStep) {
  const Study study = read(kDesign);
  evaluate_design(study);
  const Journal journal = Journal::read(study.run.journal);
  for (const Trial& trial : journal.trials()) EXPECT_NE(trial.point, first_point(study));
  EXPECT_TRUE(recorded_stages(study, journal).fits.empty());
}

TEST_F(StudyStart, WhatWasKnownAtTheStartIsKnownAfterAKillToo) {
  const std::string text = kSearch + "start = \"journal\"\n" + kDesign;
  const Study study = read(text);
  evaluate_design(study);
  const auto whole = fit_all(study);
  std::filesystem::remove(study.run.journal);
  evaluate_design(study);
  evaluated_ = 0;
  EXPECT_EQ(fit_all(study, 1, 2)[0].run.end, RunEnd::stopped);
  evaluated_ = 0;
  expect_same(fit_all(study), whole);
  evaluated_ = 0;
  expect_same(fit_all(study), whole);  // a second run on the finished journal
  EXPECT_EQ(evaluated_, 0);
  const auto drawn = recorded_stages(study, Journal::read(study.run.journal)).fits;
  expect_same(drawn, whole);
}

TEST_F(StudyStart, NeitherTheWorkersOfTheDesignNorThoseOfTheSearchChangeABit) {
  for (const char* start : {"journal", "basins"}) {
    const Study study =
        read(kSearch + "start = \"" + std::string(start) + "\"\nstarts = 2\n" + kDesign);
    std::vector<Fit> first;
    for (const int workers : {1, 3}) {
      std::filesystem::remove(study.run.journal);
      evaluate_design(study, workers);
      auto fits = fit_all(study, workers);
      if (first.empty())
        first = std::move(fits);
      else
        expect_same(fits, first);
    }
  }
}

// A trial that ran ahead of a search may be better than all requested ones, but it is no result,
// because the number of such trials depends on the number of workers.
TEST_F(StudyStart, NeitherResultsNorTheNextSearchSeeWhatNobodyAskedFor) {
  const std::string few = kSearch + "max_steps = 6\n";
  const std::string next = kSearch + "start = \"journal\"\nmax_steps = 20\n";
  std::set<std::string> first_points;
  std::vector<Fit> first_next;
  for (const int workers : {1, 3, 5}) {
    const Study study = read(few);
    std::filesystem::remove(study.run.journal);
    evaluated_ = 0;
    fit_all(study, workers);
    if (workers > 1) {
      EXPECT_GT(evaluated_, 6) << "nothing ran ahead";
    }
    std::set<std::string> points;
    for (const RatedTrial& trial : rated_trials(study, Journal::read(study.run.journal))) {
      points.insert(trial.point.bits());
    }
    auto fits = fit_all(read(next), workers);
    if (workers == 1) {
      first_points = points;
      first_next = std::move(fits);
    } else {
      EXPECT_EQ(points, first_points) << workers;
      expect_same(fits, first_next);
    }
  }
}

TEST_F(StudyStart, ThePointsOfBasinsAreEvaluatedWhereTheyAreMissing) {
  const Study study = read(kSearch + "start = \"basins\"\n" + kDesign);
  const auto fits = fit_all(study);
  EXPECT_GE(evaluated_, 30);
  EXPECT_LT(fits[0].run.best()->outcome->value, 1e-5);
  EXPECT_EQ(fits[0].run.steps.front().outcome->value, [&] {
    double best = 1e9;
    const auto points = plan(*study.doe, study.space).points;
    for (const auto& p : points) {
      best = std::min(best, objective(study)(*evaluator(study)(p))->value);
    }
    return best;
  }());
}

TEST_F(StudyStart, AnotherJournalOfTheSameModelIsTakenOver) {
  const Study old = read(kDesign + "[run]\njournal = \"old.latsch\"\n");
  evaluate_design(old);
  const Study study =
      read(kSearch + "start = \"journal\"\nstart_journal = \"old.latsch\"\n", "new.toml");
  const auto whole = fit_all(study);
  EXPECT_EQ(whole[0].run.steps.front().outcome->value, best_of_journal(old));
  std::filesystem::remove(old.run.journal);  // needed only once
  expect_same(fit_all(study), whole);
}

TEST_F(StudyStart, AJournalOfAnotherModelIsRefusedByName) {
  const Study old = read(kDesign + "[run]\njournal = \"old.latsch\"\n");
  evaluate_design(old);
  write("tire.tir", experiment::sparse_tir(experiment::kSideForce) + "PKY4 = 2.1\n");
  const Study study = read(kSearch + "start = \"journal\"\nstart_journal = \"old.latsch\"\n");
  try {
    fit_all(study);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("\"model\" differs"));
  }
}

TEST_F(StudyStart, FailedAndForeignPointsOfAJournalDoNotDisturb) {
  const Study wide = read(kDesign);
  {
    Journal journal = Journal::open(wide.run.journal, identity(wide));
    for (int i = 0; i < 40; ++i) {
      const double x = 0.5 + 0.03 * i;
      journal.append({{{x, -20.0 - 0.1 * i}}, {.result = Failure{"no license"}}});
    }
    journal.append(
        {{{9.0, -22.0}},
         {.result = evaluator(wide)({{1.9, -22.0}}).ok() ? evaluator(wide)({{1.9, -22.0}})
                                                         : Failure{""}}});  // outside of the bounds
  }
  const auto fits = fit_all(read(kSearch + "start = \"journal\"\n"));
  EXPECT_LT(fits[0].run.best()->outcome->value, 1e-5);
}

TEST_F(StudyStart, ComplaintsSayWhatIsMissing) {
  EXPECT_THAT(complaint(kSearch + "start = \"basins\"\n"), testing::HasSubstr("no [doe]"));
  EXPECT_THAT(complaint(kSearch + "starts = 2\n"), testing::HasSubstr("starts is given without"));
  EXPECT_THAT(complaint(kSearch + "start = \"journal\"\nstart_journal = \"none.latsch\"\n"),
              testing::HasSubstr("does not exist"));
  EXPECT_THAT(complaint(kSearch + "start = \"jurnal\"\n"), testing::HasSubstr("journal"));
}

}  // namespace
}  // namespace latsch::correlation
