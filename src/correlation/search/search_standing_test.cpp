// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/search_standing.h"

#include <gtest/gtest.h>

#include "correlation/search/study_reuse_testing.h"
#include "correlation/study_report/fitted_model.h"
#include "correlation/target/best_trial.h"

namespace latsch::correlation {
namespace {

class SearchStanding : public FittedStudy {
 protected:
  std::string why(const Study& study) {
    return why_no_best(study, Journal::read(study.run.journal, identity(study)));
  }
  std::optional<RatedTrial> best(const Study& study) {
    return best_trial(study, Journal::read(study.run.journal, identity(study)));
  }
  /// Replaces the forces in the measurement by those of another tire. The tests stay the same, so
  /// the journal still belongs to the study.
  void edit_measurement() {
    const Study study = read("");
    Channels measured;
    measured.add({"Fy", "N", (*evaluator(study)({{0.9, -35.0}}))["steady/Fy"]});
    write("measured.csv", formats::csv_text(measured));
  }
  /// Removes the marks from a journal, so that it is as an older version of the program wrote it.
  void make_old(const Study& study) {
    const auto trials = Journal::read(study.run.journal).trials();
    std::filesystem::remove(study.run.journal);
    Journal::open(study.run.journal, identity(study)).append(trials);
  }
};

TEST_F(SearchStanding, ABestPointOfOtherDataIsNone) {
  const Study before = read("");
  fit_all(before);
  ASSERT_TRUE(best(before));
  EXPECT_EQ(why(before), "");
  edit_measurement();
  const Study after = read("");
  EXPECT_EQ(identity(after), identity(before));
  EXPECT_FALSE(best(after));
  EXPECT_NE(why(after).find("no search has run on the study as it stands"), std::string::npos);
  EXPECT_NE(why(after).find("Next: latsch run"), std::string::npos);
  EXPECT_THROW(fitted_model(after, {"1", "today"}), InputError);
  const TrialCounts counts = count_trials(after, Journal::read(after.run.journal));
  EXPECT_EQ(counts.foreign, counts.trials);
  fit_all(after);
  EXPECT_EQ(why(after), "");
  ASSERT_TRUE(best(after));
  EXPECT_NEAR(best(after)->point.values[0], 0.9, 1e-3);
  EXPECT_TRUE(fitted_model(after, {"1", "today"}).is_fitted);
}

TEST_F(SearchStanding, OfASearchThatWasKilledOnlyItsOwnTrialsAreTheBestSoFar) {
  fit_all(read(""));
  const long old = Journal::read(folder_ / "study.latsch").size();
  edit_measurement();
  const Study after = read("");
  evaluated_ = 0;
  ASSERT_EQ(fit_all(after, 1, 3).back().run.end, RunEnd::stopped);  // the last was not yet observed
  const Journal journal = Journal::read(after.run.journal);
  ASSERT_GT(journal.size(), old);
  ASSERT_TRUE(best(after));
  EXPECT_GE(best(after)->row, old);
  EXPECT_EQ(count_trials(after, journal).foreign, old);
}

TEST_F(SearchStanding, OfStagesOnlyTheLastEndsTheSearch) {
  const std::string stages =
      "[stage.coarse]\nstep_tolerance = 0.02\n[stage.fine]\nstep_tolerance = 0.0005\n";
  fit_all(read(stages));
  EXPECT_EQ(why(read(stages)), "");
  edit_measurement();
  EXPECT_NE(why(read(stages)), "");
  fit_all(read(stages));
  EXPECT_EQ(why(read(stages)), "");
}

TEST_F(SearchStanding, AnOlderJournalIsReplayed) {
  const Study before = read("");
  fit_all(before);
  make_old(before);
  EXPECT_EQ(why(before), "");
  EXPECT_TRUE(fitted_model(before, {"1", "today"}).is_fitted);
  edit_measurement();
  const Study after = read("");
  EXPECT_NE(why(after).find("it is not known whether a search has run"), std::string::npos);
  EXPECT_THROW(fitted_model(after, {"1", "today"}), InputError);
  fit_all(after);
  EXPECT_EQ(why(after), "");
}

TEST_F(SearchStanding, TrialsTakenOverFromAnotherJournalAreNotItsOwn) {
  fit_all(read(""));
  std::filesystem::rename(folder_ / "study.latsch", folder_ / "other.latsch");
  edit_measurement();
  const Study after = read("[optimizer]\nstart = \"journal\"\nstart_journal = \"other.latsch\"\n");
  evaluated_ = 0;
  ASSERT_EQ(fit_all(after, 1, 1).back().run.end, RunEnd::stopped);
  const Journal journal = Journal::read(after.run.journal);
  const long taken = Journal::read(folder_ / "other.latsch").size();
  EXPECT_EQ(count_trials(after, journal).foreign, taken);
  EXPECT_EQ(count_trials(after, journal).own(), journal.size() - taken);
}

TEST_F(SearchStanding, WhatChangesNoTargetChangesNoKey) {
  const Study study = read("");
  EXPECT_EQ(read("[optimizer]\nmax_steps = 3\n[run]\nworkers = 2\n").target_key, study.target_key);
  EXPECT_NE(read("weight = 2\n").target_key, study.target_key);
  edit_measurement();
  EXPECT_NE(read("").target_key, study.target_key);
}

}  // namespace
}  // namespace latsch::correlation
