// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/identifiability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/scratch_folder_testing.h"
#include "correlation/analysis/measurement_gains.h"
#include "correlation/analysis/refined_shift.h"
#include "correlation/observable/force_curve.h"
#include "correlation/study/spring_testing.h"
#include "correlation/study_report/report_identifiability.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/predictions.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "evaluation/executors/inline_executor.h"
#include "evaluation/executors/simulated_executor.h"

namespace latsch::correlation {
namespace {

std::shared_ptr<const Observable> force_curve(const std::string& test,
                                              std::vector<double> deflections,
                                              std::vector<double> forces) {
  return std::make_shared<ForceCurve>(
      test,
      LoadDeflectionCurve{Abscissa::deflection, std::move(deflections), std::move(forces), {}});
}

/// Two springs in series are pressed at two deflections, each measured to 1 %.
Study springs_study() {
  StudyExperiment press;
  press.name = "press";
  press.observable = force_curve("press", {0.01, 0.02}, {20.0, 40.0});
  press.noise = {.relative = 0.01};
  StudyExperiment alone = press;
  alone.name = "alone";
  alone.observable = force_curve("alone", {0.01, 0.02}, {40.0, 80.0});
  Study study{"study.toml",
              "springs",
              "springs.toml",
              Document::parse("a = 1", "springs.toml"),
              DesignSpace({{"a", {"a"}, 1e3, 1e4, 4e3}, {"b", {"a"}, 1e3, 1e4, 4e3}}),
              {press, alone},
              {},
              100,
              std::nullopt,
              {}};
  study.specimens = specimens_of(*experiment::spring_language().kinds.front());
  return study;
}

Result<Channels> springs(const DesignPoint& point) {
  const double a = point.values[0], b = point.values[1], k = a * b / (a + b);
  Channels channels;
  channels.add({"press/force", "N", {k * 0.01, k * 0.02}});
  channels.add({"alone/force", "N", {a * 0.01, a * 0.02}});
  return channels;
}

TEST(Residuals, AreRelativeErrorsInUnitsOfTheirNoise) {
  const Study s = springs_study();
  const Score score = *residual_objective(s)(*springs({{5e3, 5e3}}));
  ASSERT_EQ(score.residuals.size(), 4u);
  EXPECT_NEAR(score.residuals[0], (20.0 - 25.0) / 20.0 / 0.01, 1e-9);
  EXPECT_NEAR(score.residuals[2], (40.0 - 50.0) / 40.0 / 0.01, 1e-9);
  EXPECT_EQ(residual_sigma(s), 1.0);
  EXPECT_EQ(residual_rows(s)[3].experiment, 1);
  EXPECT_EQ(residual_rows(s)[3].name, "20 mm");
}

// The residuals of the fit and those with which the intervals are computed differ only by a common
// factor, for experiments with different noise, weights and numbers of values.
TEST(Residuals, OfTheFitAndOfTheIntervalsAreInProportion) {
  for (const bool stated : {true, false}) {
    Study s = springs_study();
    s.experiments[0].noise = {.relative = 0.02, .absolute = 1.0};
    s.experiments[1].noise = {.absolute = 2.0};
    s.experiments[1].objective.weight = 3.0;
    for (StudyExperiment& experiment : s.experiments) {
      experiment.objective.exponent = 2.0;
      if (!stated) experiment.noise.reset();
    }
    s.experiments[0].observable = force_curve("press", {0.01}, {20.0});
    const auto springs_of_one = [](const DesignPoint& point) {
      Channels channels;
      const double a = point.values[0], b = point.values[1];
      channels.add({"press/force", "N", {a * b / (a + b) * 0.01}});
      channels.add({"alone/force", "N", {a * 0.01, a * 0.02}});
      return channels;
    };
    const Channels channels = springs_of_one({{5e3, 4e3}});
    const Score fit = *objective(s)(channels), intervals = *residual_objective(s)(channels);
    ASSERT_EQ(fit.residuals.size(), 3u);
    for (size_t k = 1; k < 3; ++k) {
      EXPECT_NEAR(fit.residuals[k] / fit.residuals[0],
                  intervals.residuals[k] / intervals.residuals[0],
                  1e-12);
    }
    double sum = 0.0;
    for (const double r : fit.residuals) sum += r * r;
    EXPECT_NEAR(sum, fit.value, 1e-14);
  }
}

// A prior of 4000 +- 400 for the variable a, in addition to four measured values, adds one residual
// to both the fit and the intervals, with the same factor as the others.
TEST(Residuals, APriorIsAMeasurementOfTheVariable) {
  Study s = springs_study();
  std::vector<DesignVariable> variables = s.space.variables();
  variables[0].prior = Prior{4e3, 400.0};
  s.space = DesignSpace(variables);
  const DesignPoint point{{5e3, 5e3}};
  const Score fit = *objective(s)(point, *springs(point)),
              intervals = *residual_objective(s)(point, *springs(point));
  ASSERT_EQ(fit.residuals.size(), 5u);
  EXPECT_NEAR(intervals.residuals[4], 2.5, 1e-12);
  EXPECT_NEAR(fit.residuals[4] / fit.residuals[0], 2.5 / intervals.residuals[0], 1e-9);
  EXPECT_EQ(residual_rows(s)[4].experiment, -1);
}

// Springs in series have the same total stiffness for many pairs of stiffnesses; only the prior of
// one of them determines both.
TEST(Identifiability, APriorRepairsAValley) {
  const ScratchFolder folder;
  Study s = springs_study();
  s.experiments.resize(1);
  std::vector<DesignVariable> variables = s.space.variables();
  variables[0].prior = Prior{4e3, 100.0};
  s.space = DesignSpace(variables);
  Journal journal = Journal::open(folder / "springs.latsch", {{"model", "springs"}});
  InlineExecutor executor(springs);
  const auto result = identify(s, s.space.initial(), Depth::profiles, executor, journal, {});
  ASSERT_TRUE(result && *result);
  for (const TargetProfile& profile : (*result)->identification.profiles()) {
    EXPECT_EQ(profile.verdict, Verdict::identifiable);
  }
  const Interval a = (*result)->identification.confidence().intervals[0];
  EXPECT_NEAR(9e3 * (a.upper - a.lower), 2 * 1.96 * 100.0, 2.0);
}

// A search that ended early is continued, and every display shows the best trial of the journal.
TEST(Identifiability, ABetterPointFoundOnTheWayIsTheOneThatIsReported) {
  const ScratchFolder folder;
  Study s = springs_study();
  for (StudyExperiment& experiment : s.experiments) experiment.objective.exponent = 2.0;
  s.run.journal = folder / "springs.latsch";
  Journal journal = Journal::open(s.run.journal, {{"model", "springs"}});
  InlineExecutor executor(springs);
  const auto result = identify(s, {{3.7e3, 4.6e3}}, Depth::profiles, executor, journal, {});
  ASSERT_TRUE(result && *result);
  EXPECT_NEAR((*result)->best.values[0], 4e3, 20.0);
  EXPECT_NEAR((*result)->best.values[1], 4e3, 40.0);
  EXPECT_EQ((*result)->best, best_trial(s, journal)->point);
  for (int i = 0; i < 2; ++i) {
    const Interval shown = reported_interval(s, **result, i);
    const double u = s.space.to_unit((*result)->best)[i];
    EXPECT_LE(shown.lower, u);
    EXPECT_GE(shown.upper, u);
    const TargetProfile& profile = (*result)->identification.profiles()[i];
    EXPECT_LE(profile.interval.lower, u);
    EXPECT_GE(profile.interval.upper, u);
  }
  const auto read = recorded_identifiability(s, journal);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->best, (*result)->best);
  EXPECT_EQ(read->identification.profiles()[0].interval.upper,
            (*result)->identification.profiles()[0].interval.upper);
}

// A search that ended by its limit of steps is not continued implicitly: the intervals of twelve
// parameters of a ring took 285 trials after a search of 24 steps.
TEST(Identifiability, OfAnUnfinishedSearchStaysWhereItIs) {
  const DesignPoint point{{3.7e3, 4.6e3}};
  const auto trials = [&](Depth depth) {
    const ScratchFolder folder;
    Study s = springs_study();
    for (StudyExperiment& experiment : s.experiments) experiment.objective.exponent = 2.0;
    s.run.journal = folder / "springs.latsch";
    Journal journal = Journal::open(s.run.journal, {{"model", "springs"}});
    InlineExecutor executor(springs);
    const auto result = identify(s, point, depth, executor, journal, {});
    EXPECT_TRUE(result && *result);
    if (depth == Depth::at_the_point) {
      EXPECT_EQ((*result)->point, point);
      EXPECT_EQ((*result)->best, best_trial(s, journal)->point);
      const auto all = remarks(s, **result);
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const std::string& remark) {
        return remark.find("ended early") != std::string::npos;
      }));
    }
    return journal.size();
  };
  EXPECT_LE(trials(Depth::at_the_point), 1 + 2 * 6);
  EXPECT_GT(trials(Depth::intervals), 1 + 2 * 6);
}

// The springs of the refined model have 2 % more force, whatever their stiffness, so its values are
// 2 % lower. The interval holds both values, each with its noise, and every display finds it in the
// journals.
TEST(Identifiability, IntervalsReachToTheNumbersOfTheRefinedModel) {
  const ScratchFolder folder;
  Study s = springs_study();
  for (StudyExperiment& experiment : s.experiments) experiment.objective.exponent = 2.0;
  s.run.journal = folder / "springs.latsch";
  s.refinement = Refinement{{{"a", 2.0}}};
  Journal journal = Journal::open(s.run.journal, {{"model", "springs"}});
  InlineExecutor executor(springs);
  auto result = identify(s, {{4e3, 4e3}}, Depth::intervals, executor, journal, {});
  ASSERT_TRUE(result && *result);
  Identifiability& what = **result;
  EXPECT_FALSE(what.refined_shift);
  EXPECT_NE(remarks(s, what).back().find("the effect of mesh"), std::string::npos);
  const Interval own = reported_interval(s, what, 0);

  InlineExecutor finer([](const DesignPoint& point) {
    return springs({{1.02 * point.values[0], 1.02 * point.values[1]}});
  });
  ASSERT_TRUE(evaluate_refined(s, what.point, finer, {}));
  what.refined_shift = refined_shift(s, what.identification);
  ASSERT_TRUE(what.refined_shift);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(
        9e3 * (*what.refined_shift)[i], -80.0, 0.1);  // differences are accurate to a thousandth
  EXPECT_EQ(shift_text(s, what, 0).substr(0, 2), "-8");
  const Interval shown = reported_interval(s, what, 0);
  EXPECT_NEAR(9e3 * (own.lower - shown.lower), 80.0, 0.5);
  EXPECT_EQ(shown.upper, own.upper);
  EXPECT_NE(remarks(s, what).back().find("more than the noise in a:"), std::string::npos);
  const auto read = recorded_identifiability(s, journal);
  ASSERT_TRUE(read);
  EXPECT_EQ(reported_interval(s, *read, 0).lower, shown.lower);
}

// The two ends of an interval such as "25 .. 25" would not reveal its width, so more digits are
// printed.
TEST(Identifiability, TheEndsOfANarrowIntervalDiffer) {
  const DesignSpace space({{"a", {"a"}, 10.0, 60.0, 20.0}});
  const auto share = [](double value) { return (value - 10.0) / 50.0; };
  const auto text = [&](double lower, double upper) {
    return interval_text(space, 0, Interval{share(lower), share(upper)});
  };
  EXPECT_EQ(text(24.9998, 25.0003), "24.9998 .. 25.0003");
  EXPECT_EQ(text(24.0, 26.0), "24 .. 26");
}

// One fit ended at 73.039 N/mm^2 on a processor with one set of SIMD instructions and at 72.983
// N/mm^2 with another; its interval is 47 .. 114 N/mm^2. Only the first two digits are meaningful.
TEST(Identifiability, ValuesHaveTheDigitsThatTheirIntervalLeaves) {
  const DesignSpace space({{"E", {"E"}, 10e6, 150e6, 25e6, Scale::logarithmic, "N/mm^2"},
                           {"t", {"t"}, -1.0, 1.0, 0.1},
                           {"k", {"k"}, 1e3, 1e4, 2e3}});
  const auto text = [&](int i, double value, double lower, double upper) {
    const auto u = [&](double at) {
      DesignPoint point = space.initial();
      point.values[i] = at;
      return space.to_unit(point)[i];
    };
    const Interval interval{u(lower), u(upper)};
    return value_text(space, i, value, interval) + ", " + interval_text(space, i, interval);
  };
  EXPECT_EQ(text(0, 73.039e6, 46.629e6, 114.41e6), "73 N/mm^2, 47 .. 114 N/mm^2");
  EXPECT_EQ(text(0, 72.983e6, 46.613e6, 114.38e6), "73 N/mm^2, 47 .. 114 N/mm^2");
  EXPECT_EQ(text(0, 119.87e6, 20e6, 149e6), "120 N/mm^2, 20 .. 149 N/mm^2");
  EXPECT_EQ(text(2, 1987.3, 1700.0, 2300.0), "1990, 1700 .. 2300");  // not 1.99e+03
  EXPECT_EQ(text(0, 73.03912e6, 73.036e6, 73.042e6), "73.0391 N/mm^2, 73.036 .. 73.042 N/mm^2");
  EXPECT_EQ(text(1, 0.0, -0.012, 0.012), "0, -0.012 .. 0.012");
  EXPECT_EQ(text(1, 0.001, -0.5, 0.5), "0.001, -0.5 .. 0.5");
}

// A report may be drawn after any interruption, also when a better point was found but its
// derivatives are not known yet. The start is chosen so that better points lie on both sides of it.
TEST(Identifiability, ReadAtAnyMomentItBelongsToAPointWhoseDerivativesAreKnown) {
  Study s = springs_study();
  s.experiments.resize(1);
  const auto bump = [](const DesignPoint& point) -> Result<Channels> {
    double force = 30.0;
    for (const double x : point.values) force -= 1e4 * std::pow((x - 4e3) / 9e3, 2);
    Channels channels;
    channels.add({"press/force", "N", {force, 2.0 * force}});
    return channels;
  };
  int read = 0;
  for (const int until : {3, 6, 10, 14}) {
    const ScratchFolder folder;
    s.run.journal = folder / "bump.latsch";
    Journal journal = Journal::open(s.run.journal, {{"model", "bump"}});
    int evaluated = 0;
    InlineExecutor executor([&](const DesignPoint& point) {
      ++evaluated;
      return bump(point);
    });
    RunOptions options;
    options.stop_patience = 0.0;
    options.stop_requested = [&] { return evaluated >= until; };
    identify(s, s.space.initial(), Depth::profiles, executor, journal, options);
    const auto what = recorded_identifiability(s, journal);
    if (!what) continue;
    ++read;
    ASSERT_TRUE(what->identification.is_linearized()) << until;
    const auto& confidence = what->identification.confidence();
    EXPECT_EQ(what->identification.linearization().J.rows(), confidence.noise.size()) << until;
    EXPECT_FALSE(repetition_gains(s, *what).empty()) << until;
  }
  EXPECT_GT(read, 0);
}

// Values of 10 N and 1000 N are each known to 1 N, so the large one is a hundred times as exact in
// relative terms.
TEST(Residuals, NoiseWeightsTheFit) {
  Study s = springs_study();
  s.experiments.resize(1);
  s.experiments[0].noise = {.absolute = 1.0};
  s.experiments[0].observable = force_curve("press", {0.01, 0.02}, {10.0, 1000.0});
  Channels channels;
  channels.add({"press/force", "N", {11.0, 1001.0}});
  const Score score = *objective(s)(channels);
  EXPECT_NEAR(score.residuals[0], score.residuals[1], 1e-15);  // one deviation each
}

TEST(Residuals, FarOffValuesCountLessWithARobustLoss) {
  const RobustLoss huber{Loss::huber, 2.0}, cauchy{Loss::cauchy, 2.0};
  EXPECT_NEAR(huber(1.5), 1.5, 1e-15);
  EXPECT_NEAR(huber(-8.0), -2.0 * std::sqrt(2.0 * 4.0 - 1.0), 1e-12);  // the square grows as |x|
  EXPECT_NEAR(cauchy(8.0), 2.0 * std::sqrt(std::log(17.0)), 1e-12);
  Study s = springs_study();
  s.experiments[0].loss = huber;
  Channels channels = *springs({{4e3, 4e3}});
  const Score before = *residual_objective(s)(channels);
  EXPECT_NEAR(before.residuals[0], 0.0, 1e-9);
}

TEST(Residuals, WithoutNoiseWeightsSayHowFarAValueCanBeTrusted) {
  Study s = springs_study();
  for (StudyExperiment& experiment : s.experiments) experiment.noise.reset();
  s.experiments[0].objective.weight = 4.0;
  const Score score = *residual_objective(s)(*springs({{5e3, 5e3}}));
  EXPECT_NEAR(score.residuals[0], 2.0 * (20.0 - 25.0) / 20.0, 1e-12);
  EXPECT_NEAR(score.residuals[2], (40.0 - 50.0) / 40.0, 1e-12);
  EXPECT_FALSE(residual_sigma(s));
}

// The stiffness k of both springs in series, 1 / k = 1 / a + 1 / b, and that of a alone are
// measured twice each to 1 %. In linear approximation a is known to 1 % / sqrt(2). With a = b the
// relative error of b is that of 2 dk / k - da / a: sqrt(5) times as large.
TEST(Identifiability, OfAStudyFindsTheIntervalsAndReadsThemBackFromTheJournal) {
  const ScratchFolder folder;
  Study s = springs_study();
  Journal journal = Journal::open(folder / "springs.latsch", {{"model", "springs"}});
  InlineExecutor executor(springs);
  const auto result = identify(s, s.space.initial(), Depth::profiles, executor, journal, {});
  ASSERT_TRUE(result && *result);
  const Identification& found = (*result)->identification;
  const double range = 9e3, a = 1.96 * 0.01 / std::sqrt(2.0) * 4e3 / range;
  const double at = (4e3 - 1e3) / range;
  // Central differences over steps of 1 % of the range do not detect the curvature of k.
  EXPECT_NEAR(found.confidence().intervals[0].upper - at, a, 0.002 * a);
  EXPECT_NEAR(found.confidence().intervals[1].upper - at, std::sqrt(5.0) * a, 0.004 * a);
  for (const TargetProfile& profile : found.profiles()) {
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

// Only the springs in series are measured. Measuring a alone would resolve the valley in (a, b);
// measuring both in series once more would not.
TEST(Identifiability, RanksTheExperimentThatRepairsTheValleyFirst) {
  const ScratchFolder folder;
  Study s = springs_study();
  s.run.journal = folder / "springs.latsch";
  s.experiments[1].fitted = false;
  Journal journal = Journal::open(s.run.journal, {{"model", "springs"}});
  InlineExecutor executor(springs);
  const auto result = identify(s, s.space.initial(), Depth::intervals, executor, journal, {});
  ASSERT_TRUE(result && *result);
  // standard deviation in the direction of the valley of the objective
  EXPECT_GT((*result)->identification.confidence().deviation(1), 1.0);

  const auto points = prediction_points(s, **result);
  EXPECT_FALSE(predicted_channels(s, points));
  InlineExecutor all(springs);
  ASSERT_TRUE(predict(s, points, all, {}));
  const auto gains = prediction_gains(s, **result, *predicted_channels(s, points));
  ASSERT_EQ(gains.size(), 1u);
  EXPECT_EQ(gains[0].measurement, "alone");
  EXPECT_GT(gains[0].shrinkage, 10 * repetition_gains(s, **result)[0].shrinkage);
  EXPECT_LT(gains[0].after, 0.1 * gains[0].before);

  const auto recorded = recorded_identifiability(s, journal);
  ASSERT_TRUE(recorded);
  const report::IdentifiabilityPage page = identifiability_page(s, *recorded, {});
  EXPECT_EQ(page.gains[0].measurement, "alone");
  EXPECT_EQ(page.intervals[0], "anywhere between the bounds");
  EXPECT_EQ(page.interval_sources[0], "bounds");
}

// With a ripple of 1 % and 150 waves over the range, differences over a hundredth of the range
// mostly show the ripple. The gain of the predicted experiment must use the step lengths found for
// the fitted one.
TEST(Identifiability, RippleLeavesTheGainOfAPredictedExperimentAlone) {
  double shrinkage[2];
  for (const bool is_rippled : {false, true}) {
    const ScratchFolder folder;
    Study s = springs_study();
    s.run.journal = folder / "springs.latsch";
    s.experiments[1].fitted = false;
    const auto model = [is_rippled](const DesignPoint& point) {
      const double ripple = is_rippled ? 0.01 * std::sin(0.105 * point.values[0]) : 0.0;
      const double a = point.values[0], b = point.values[1], k = a * b / (a + b);
      Channels channels;
      channels.add({"press/force", "N", {k * 0.01 * (1 + ripple), k * 0.02 * (1 - ripple)}});
      channels.add({"alone/force", "N", {a * 0.01 * (1 - ripple), a * 0.02 * (1 + ripple)}});
      return Result<Channels>(channels);
    };
    Journal journal = Journal::open(s.run.journal, {{"model", "springs"}});
    InlineExecutor executor(model);
    const auto result = identify(s, s.space.initial(), Depth::intervals, executor, journal, {});
    ASSERT_TRUE(result && *result);
    const auto points = prediction_points(s, **result);
    InlineExecutor all(model);
    ASSERT_TRUE(predict(s, points, all, {}));
    shrinkage[is_rippled] =
        prediction_gains(s, **result, *predicted_channels(s, points))[0].shrinkage;
  }
  EXPECT_NEAR(shrinkage[1], shrinkage[0], 0.3 * shrinkage[0]);
}

TEST(Identifiability, HasTheSameBitsForAnyNumberOfWorkers) {
  const Study s = springs_study();
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
