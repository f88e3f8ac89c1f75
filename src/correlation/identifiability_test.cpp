// SPDX-License-Identifier: Apache-2.0
#include "correlation/identifiability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "correlation/measurement_gains.h"
#include "correlation/predictions.h"
#include "correlation/report_identifiability.h"
#include "correlation/residuals.h"
#include "evaluation/inline_executor.h"
#include "evaluation/scratch_folder_testing.h"
#include "evaluation/simulated_executor.h"

namespace latsch::correlation {
namespace {

/// Two springs in series pressed at two deflections, each measured to 1 %.
Study study() {
  StudyExperiment press;
  press.name = "press";
  press.load_case.test =
      experiment::LoadDeflection{.deflections = {0.01, 0.02}, .loaded_radii = {}};
  press.forces = {20.0, 40.0};
  press.noise = 0.01;
  StudyExperiment alone = press;
  alone.name = "alone";
  alone.forces = {40.0, 80.0};
  return {"study.toml",
          "springs",
          "springs.toml",
          Document::parse("a = 1", "springs.toml"),
          DesignSpace({{"a", {"a"}, 1e3, 1e4, 4e3}, {"b", {"a"}, 1e3, 1e4, 4e3}}),
          {press, alone},
          {},
          100,
          std::nullopt,
          {}};
}

Result<Channels> springs(const DesignPoint& point) {
  const double a = point.values[0], b = point.values[1], k = a * b / (a + b);
  Channels channels;
  channels.add({"press/force", "N", {k * 0.01, k * 0.02}});
  channels.add({"alone/force", "N", {a * 0.01, a * 0.02}});
  return channels;
}

TEST(Residuals, AreRelativeErrorsInUnitsOfTheirNoise) {
  const Study s = study();
  const Score score = *residual_objective(s)(*springs({{5e3, 5e3}}));
  ASSERT_EQ(score.residuals.size(), 4u);
  EXPECT_NEAR(score.residuals[0], (20.0 - 25.0) / 20.0 / 0.01, 1e-9);
  EXPECT_NEAR(score.residuals[2], (40.0 - 50.0) / 40.0 / 0.01, 1e-9);
  EXPECT_EQ(residual_sigma(s), 1.0);
  EXPECT_EQ(residual_rows(s)[3].experiment, 1);
  EXPECT_EQ(residual_rows(s)[3].name, "20 mm");
}

TEST(Residuals, WithoutNoiseWeightsSayHowFarAValueCanBeTrusted) {
  Study s = study();
  for (StudyExperiment& experiment : s.experiments) experiment.noise.reset();
  s.experiments[0].objective.weight = 4.0;
  const Score score = *residual_objective(s)(*springs({{5e3, 5e3}}));
  EXPECT_NEAR(score.residuals[0], 2.0 * (20.0 - 25.0) / 20.0, 1e-12);
  EXPECT_NEAR(score.residuals[2], (40.0 - 50.0) / 40.0, 1e-12);
  EXPECT_FALSE(residual_sigma(s));
}

// Values of 1 %, two of each spring arrangement: a is known to 1 % / sqrt(2) in linear
// approximation; 1 / k = 1 / a + 1 / b, so with a = b the relative error of b is that of
// 2 dk / k - da / a: sqrt(5) times as large.
TEST(Identifiability, OfAStudyFindsTheIntervalsAndReadsThemBackFromTheJournal) {
  const ScratchFolder folder;
  Study s = study();
  Journal journal = Journal::open(folder / "springs.latsch", {{"model", "springs"}});
  InlineExecutor executor(springs);
  const auto result = identify(s, s.space.initial(), Depth::profiles, executor, journal, {});
  ASSERT_TRUE(result && *result);
  const Identification& found = (*result)->identification;
  const double range = 9e3, a = 1.96 * 0.01 / std::sqrt(2.0) * 4e3 / range;
  const double at = (4e3 - 1e3) / range;
  // Forward differences of 1 % of the range see the curvature of k: half a percent of slope each.
  EXPECT_NEAR(found.confidence().intervals[0].upper - at, a, 0.03 * a);
  EXPECT_NEAR(found.confidence().intervals[1].upper - at, std::sqrt(5.0) * a, 0.05 * a);
  for (const Profile& profile : found.profiles()) {
    EXPECT_EQ(profile.verdict, Verdict::identifiable);
  }
  ASSERT_EQ((*result)->cross_validation->left_out().size(), 2u);

  const long trials = journal.size();
  const auto again = identify(s, s.space.initial(), Depth::profiles, executor, journal, {});
  EXPECT_EQ(journal.size(), trials);
  const auto read = recorded_identifiability(s, journal);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->identification.profiles().size(), 2u);
  EXPECT_EQ(read->identification.profiles()[0].interval.upper, found.profiles()[0].interval.upper);
}

// Both springs together are measured, each alone is not. The valley in (a, b) is repaired by the
// experiment on a, were it measured, and not by measuring both together once more.
TEST(Identifiability, RanksTheExperimentThatRepairsTheValleyFirst) {
  const ScratchFolder folder;
  Study s = study();
  s.run.journal = folder / "springs.latsch";
  s.experiments[1].fitted = false;
  Journal journal = Journal::open(s.run.journal, {{"model", "springs"}});
  InlineExecutor executor(springs);
  const auto result = identify(s, s.space.initial(), Depth::intervals, executor, journal, {});
  ASSERT_TRUE(result && *result);
  EXPECT_GT((*result)->identification.confidence().deviation(1), 1.0);  // the valley

  const auto points = difference_points(s.space, (*result)->point);
  EXPECT_FALSE(predicted_channels(s, points));
  InlineExecutor all(springs);
  ASSERT_TRUE(predict(s, points, all, {}));
  const auto gains = prediction_gains(s, **result, *predicted_channels(s, points));
  ASSERT_EQ(gains.size(), 1u);
  EXPECT_EQ(gains[0].measurement, "alone");
  EXPECT_GT(gains[0].shrinkage, 10 * repetition_gains(s, **result)[0].shrinkage);
  EXPECT_LT(gains[0].after, 0.1 * gains[0].before);

  const auto page = identifiability_of(s, journal);
  ASSERT_TRUE(page);
  EXPECT_EQ(page->gains[0].measurement, "alone");
  EXPECT_EQ(page->intervals[0], "anywhere between the bounds");
}

TEST(Identifiability, HasTheSameBitsForAnyNumberOfWorkers) {
  const Study s = study();
  std::vector<ProfilePoint> first;
  for (int workers : {1, 2, 4, 8}) {
    const ScratchFolder folder;
    Journal journal = Journal::open(folder / "springs.latsch", {{"model", "springs"}});
    SimulatedExecutor executor(springs, {.workers = workers, .seed = 7});
    RunOptions options;
    options.commit_in_background = false;
    const auto result = identify(s, s.space.initial(), Depth::profiles, executor, journal, options);
    ASSERT_TRUE(result && *result);
    const auto& points = (*result)->identification.profiles()[1].points;
    if (workers == 1) first = points;
    ASSERT_EQ(points.size(), first.size());
    for (size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(points[k].u, first[k].u);
      EXPECT_EQ(points[k].S, first[k].S);
    }
  }
}

}  // namespace
}  // namespace latsch::correlation
