// SPDX-License-Identifier: Apache-2.0
// Tests an identification of a study whose recordings contain derivatives: how its trials are
// stored, and that it continues after a stop as if there had been none.
#include "correlation/analysis/refit_trials.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "base/random.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/identification_start.h"
#include "correlation/search/study_reuse_testing.h"
#include "correlation/target/best_trial.h"

namespace latsch::correlation {
namespace {

class RefitTrialsOfStudy : public FittedStudy {
 protected:
  /// Returns a study of a curve to which a wave of 30 N is added, and of its mean, which is wrong
  /// by 100 N.
  Study two_experiments(const std::string& noise_of_mean = "300 N") {
    std::vector<double> Fy = (*evaluator(read(""))({{1.3, -22.0}}))["steady/Fy"];
    double mean = 0.0;
    for (const double force : Fy) mean += force / static_cast<double>(Fy.size());
    RandomStream random(4, 1);
    for (double& force : Fy) force += 20.0 * random.normal();
    Channels measured;
    measured.add({"Fy", "N", Fy});
    write("measured.csv", formats::csv_text(measured));
    return read(
        fmt::format("exponent = 2\nnoise = \"20 N\"\n[experiment.one]\nkind = \"values\"\n"
                    "channel = \"steady/Fy\"\nvalue = \"{} N\"\nof = \"mean\"\n"
                    "scale = \"100 N\"\nnoise = \"{}\"\nexponent = 2\n",
                    mean + 100.0,
                    noise_of_mean));
  }

  /// Returns the profiles around a point of the journal; nullopt if it was stopped after so many
  /// trials.
  std::optional<Identifiability> identified(const Study& study,
                                            const DesignPoint& best,
                                            int workers = 1,
                                            long stopped_after = 1'000'000) {
    Journal journal = Journal::open(study.run.journal, identity(study));
    RunOptions options;
    options.stop_patience = 0.0;
    const long before = evaluated_;
    options.stop_requested = [&] { return evaluated_ - before >= stopped_after; };
    options.on_progress = [&](const RunProgress& progress) { last_ = progress; };
    const Evaluator model = evaluator(study);
    const Evaluator counted = [&, model](const DesignPoint& point) {
      ++evaluated_;
      return model(point);
    };
    std::unique_ptr<Executor> executor;
    if (workers == 1)
      executor = std::make_unique<InlineExecutor>(counted);  // a stop leaves no partial trial
    else
      executor = std::make_unique<ThreadExecutor>([&] { return counted; }, workers);
    auto result = identify(study, best, Depth::profiles, *executor, journal, options);
    if (!result) return std::nullopt;
    EXPECT_TRUE(*result);
    return std::move(**result);
  }

  /// Reads the trials in the file beside the journal.
  static std::vector<Trial> refits(const Study& study) {
    return Journal::read(RefitTrials::file(study.run.journal)).trials();
  }

  static void expect_same(const Identifiability& a, const Identifiability& b) {
    EXPECT_EQ(a.point.bits(), b.point.bits());
    const auto &p = a.identification.profiles(), &q = b.identification.profiles();
    ASSERT_EQ(p.size(), q.size());
    ASSERT_GT(p.size(), 0u);
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_EQ(p[i].interval.lower, q[i].interval.lower);
      EXPECT_EQ(p[i].interval.upper, q[i].interval.upper);
      ASSERT_EQ(p[i].points.size(), q[i].points.size());
      for (std::size_t k = 0; k < p[i].points.size(); ++k)
        EXPECT_EQ(p[i].points[k].S, q[i].points[k].S) << i << ", " << k;
    }
    ASSERT_TRUE(a.cross_validation && b.cross_validation);
    const auto &c = a.cross_validation->left_out(), &d = b.cross_validation->left_out();
    ASSERT_EQ(c.size(), d.size());
    for (std::size_t i = 0; i < c.size(); ++i) EXPECT_EQ(c[i].predicted, d[i].predicted);
  }

  RunProgress last_;
};

TEST_F(RefitTrialsOfStudy, TheJournalHoldsWholeTrialsOfTheCenterAlone) {
  const Study study = two_experiments();
  const auto whole = identified(study, {{1.3, -22.0}});
  ASSERT_TRUE(whole);
  const long journal = Journal::read(study.run.journal).size();
  EXPECT_LE(journal, 20) << "the point, and steps to better ones";
  const auto kept = refits(study);
  EXPECT_EQ(journal + std::ssize(kept), evaluated_);
  ASSERT_GT(kept.size(), 20u);
  for (const Trial& trial : kept) {
    ASSERT_TRUE(trial.outcome.result);
    const Channel& reduced = trial.outcome.result->all().front();
    // Profiles: the triangle of [J r] in two variables. Cross-validation: that of the curve, and
    // the one row of the value.
    EXPECT_TRUE(reduced.values.size() == 6u || reduced.values.size() == 6u + 3u);
    EXPECT_TRUE(reduced.slopes.empty());
  }
  EXPECT_EQ(last_.known, last_.planned) << "all rounds are counted, and the end is foreseen";
}

// Reduced residuals have the same sums of squares and products. Profiles and predictions of
// experiments that are left out therefore agree with those from differences, which store whole
// recordings.
TEST_F(RefitTrialsOfStudy, GiveTheProfilesThatWholeRecordingsGive) {
  const Study study = two_experiments();
  const auto reduced = identified(study, {{1.3, -22.0}});
  Study plain = study;
  plain.asks_slopes = false;
  plain.run.journal = folder_ / "plain.latsch";
  const auto whole = identified(plain, {{1.3, -22.0}});
  ASSERT_TRUE(reduced && whole);
  EXPECT_FALSE(std::filesystem::exists(RefitTrials::file(plain.run.journal)));
  for (std::size_t i = 0; i < 2; ++i) {
    const TargetProfile &p = reduced->identification.profiles()[i],
                        &q = whole->identification.profiles()[i];
    const double width = q.interval.upper - q.interval.lower;
    EXPECT_EQ(p.verdict, Verdict::identifiable);
    EXPECT_EQ(q.verdict, Verdict::identifiable);
    // Both results have the tolerance of refits, 2 % of a threshold, which is 1 % of half the
    // interval.
    EXPECT_NEAR(p.interval.lower, q.interval.lower, 0.01 * width);
    EXPECT_NEAR(p.interval.upper, q.interval.upper, 0.01 * width);
    const LeftOut &a = reduced->cross_validation->left_out()[i],
                  &b = whole->cross_validation->left_out()[i];
    EXPECT_NEAR(a.fitted, b.fitted, 0.01 * b.fitted);
    EXPECT_NEAR(a.predicted, b.predicted, 0.02 * b.predicted);
  }
}

// The identification starts at a point that is not the best, so refits find better ones, and the
// best trial of the journal changes before the identification continues.
TEST_F(RefitTrialsOfStudy, AStopAnywhereCostsNoTrialAndNoBit) {
  const DesignPoint beside{{1.29, -21.5}};
  const Study study = two_experiments();
  const auto reference = identified(study, beside);
  ASSERT_TRUE(reference);
  const long trials = evaluated_;
  for (const int workers : {1, 2}) {
    for (const long after : {1L, 3L, 7L, 20L, trials / 2, trials - 2}) {
      Study again = study;
      again.run.journal = folder_ / fmt::format("w{}_{}.latsch", workers, after);
      evaluated_ = 0;
      ASSERT_FALSE(identified(again, beside, workers, after)) << after;
      DesignPoint best = beside;
      {
        const Journal journal = Journal::read(again.run.journal);
        if (const auto now = best_trial(again, journal)) best = now->point;
      }
      const auto resumed = identified(again, best, workers);
      ASSERT_TRUE(resumed);
      expect_same(*reference, *resumed);
      std::set<std::string> points;
      Journal::read(again.run.journal).for_each([&](const Trial& trial) {
        EXPECT_TRUE(points.insert(trial.point.bits()).second);
      });
      std::map<std::string, int> kept;
      for (const Trial& trial : refits(again))
        for (const Channel& channel : trial.outcome.result->all())
          EXPECT_EQ(++kept[channel.name + trial.point.bits()], 1);
      if (workers == 1) {
        EXPECT_EQ(evaluated_, trials) << "stopped after " << after;
      }
      const Journal journal = Journal::read(again.run.journal);
      const auto read = recorded_identifiability(again, journal);
      ASSERT_TRUE(read);
      expect_same(*reference, *read);
    }
  }
}

// If the identification is repeated, it needs no new trial; a better trial from another search
// makes it start again.
TEST_F(RefitTrialsOfStudy, TheMarkHoldsUntilABetterTrialComesFromElsewhere) {
  const DesignPoint beside{{1.29, -21.5}}, better{{1.3, -22.0}};
  const Study study = two_experiments();
  ASSERT_TRUE(identified(study, beside));
  evaluated_ = 0;
  Journal journal = Journal::open(study.run.journal, identity(study));
  const DesignPoint best = best_trial(study, journal)->point;
  EXPECT_NE(best, beside);
  EXPECT_EQ(identification_start(study, journal, best, Depth::profiles), beside);
  journal.append({better, evaluate(evaluator(study), better)});
  EXPECT_EQ(identification_start(study, journal, better, Depth::profiles), better);
  EXPECT_EQ(identification_start(study, journal, best, Depth::intervals), best)
      << "no intervals were asked for";
}

// The target is no sum of squares here, so profiles visit points with a lower target. The lowest of
// these becomes the best trial of the journal, as if all trials were stored whole.
TEST_F(RefitTrialsOfStudy, ABetterTargetOnTheWayIsKeptWhole) {
  Channels measured;
  std::vector<double> Fy = (*evaluator(read(""))({{1.3, -22.0}}))["steady/Fy"];
  for (std::size_t i = 0; i < Fy.size(); ++i) Fy[i] *= i % 2 == 0 ? 1.15 : 0.85;
  measured.add({"Fy", "N", Fy});
  write("measured.csv", formats::csv_text(measured));
  const Study study = read(
      "[experiment.again]\nkind = \"curve\"\ny = \"steady/Fy\"\n"
      "measurement = \"measured.csv\"\n");
  const DesignPoint found = fit_all(study).back().run.best()->point;
  std::optional<RatedTrial> best;
  for (const int workers : {1, 2}) {
    Study again = study;
    again.run.journal = folder_ / fmt::format("{}.latsch", workers);
    ASSERT_TRUE(identified(again, found, workers));
    const auto now = best_trial(again, Journal::read(again.run.journal));
    ASSERT_TRUE(now);
    EXPECT_NE(now->point, found);
    if (best) {
      EXPECT_EQ(now->point.bits(), best->point.bits());
    }
    best = now;
    evaluated_ = 0;
    ASSERT_TRUE(identified(again, now->point, workers));
    EXPECT_EQ(evaluated_, 0) << "it goes on where it began";
  }
}

// Other weights give other residuals, so trials stored for the earlier weights are not read.
TEST_F(RefitTrialsOfStudy, BelongToTheirResiduals) {
  const DesignPoint point{{1.3, -22.0}};
  ASSERT_TRUE(identified(two_experiments(), point));
  const long first = evaluated_;
  const Study other = two_experiments("100 N");
  evaluated_ = 0;
  const auto resumed = identified(other, point);
  ASSERT_TRUE(resumed);
  EXPECT_GT(evaluated_, first / 2);
  Study fresh = other;
  fresh.run.journal = folder_ / "fresh.latsch";
  const auto reference = identified(fresh, point);
  ASSERT_TRUE(reference);
  expect_same(*reference, *resumed);
}

// The file is a cache: without it, or with one of another study, the trials are run again.
TEST_F(RefitTrialsOfStudy, MayBeDeletedOrBeOfAnotherStudy) {
  const DesignPoint point{{1.3, -22.0}};
  const Study study = two_experiments();
  const auto reference = identified(study, point);
  const auto file = RefitTrials::file(study.run.journal);
  for (const bool foreign : {false, true}) {
    std::filesystem::remove(file);
    if (foreign) Journal::open(file, {{"model", "another"}});
    {
      const Journal journal = Journal::read(study.run.journal);
      const auto read = recorded_identifiability(study, journal);
      ASSERT_TRUE(read);
      EXPECT_TRUE(read->identification.profiles().empty());
      EXPECT_EQ(refit_trial_count(journal), 0);
    }
    const auto again = identified(study, point);
    ASSERT_TRUE(reference && again);
    expect_same(*reference, *again);
  }
}

// A variable that is held constant has no column in the stored Jacobian, whether this is reduced or
// not.
TEST_F(RefitTrialsOfStudy, AVariableThatMayNotMoveKeepsItsBits) {
  Study study = two_experiments();
  const DesignPoint point{{1.3, -22.0}};
  study.free = {1};
  study.held_at = point;
  const auto result = identified(study, point);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->identification.profiles().size(), 1u);
  for (const Trial& trial : refits(study)) EXPECT_EQ(trial.point.values[0], 1.3);
}

}  // namespace
}  // namespace latsch::correlation
