// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/missed_values.h"

#include <gtest/gtest.h>

#include "base/scratch_folder_testing.h"
#include "correlation/analysis/measurement_gains.h"
#include "correlation/observable/force_curve.h"
#include "correlation/study/spring_testing.h"
#include "correlation/target/predictions.h"
#include "evaluation/executors/inline_executor.h"

namespace latsch::correlation {
namespace {

/// Two springs a, b in series are pressed at two deflections, and a alone, measured to 1 %.
class MissedValues : public ::testing::Test {
 protected:
  void measure(std::vector<double> pressed, std::vector<double> alone) {
    add("press", std::move(pressed));
    add("alone", std::move(alone));
  }

  void add(const char* name, std::vector<double> forces) {
    StudyExperiment experiment;
    experiment.name = name;
    experiment.observable = std::make_shared<ForceCurve>(
        name, LoadDeflectionCurve{Abscissa::deflection, {0.01, 0.02}, std::move(forces), {}});
    experiment.noise = {.relative = 0.01};
    study_.experiments.push_back(std::move(experiment));
  }

  static Result<Channels> springs(const DesignPoint& point) {
    const double a = point.values[0], b = point.values[1], k = a * b / (a + b);
    Channels channels;
    channels.add({"press/force", "N", {k * 0.01, k * 0.02}});
    channels.add({"alone/force", "N", {a * 0.01, a * 0.02}});
    return channels;
  }

  Identifiability at(const DesignPoint& point) {
    study_.specimens = specimens_of(*experiment::spring_language().kinds.front());
    study_.run.journal = folder_ / "springs.latsch";
    Journal journal = Journal::open(study_.run.journal, {{"model", "springs"}});
    InlineExecutor executor(springs);
    return **identify(study_, point, Depth::at_the_point, executor, journal, {});
  }

  std::vector<std::string> sentences(const Identifiability& what) {
    std::vector<std::string> all;
    for (const MissedValue& one : missed_values(study_, what))
      all.push_back(one.in_words(study_.space));
    return all;
  }

  ScratchFolder folder_;
  Study study_{"study.toml",
               "springs",
               "springs.toml",
               Document::parse("a = 1", "springs.toml"),
               DesignSpace({{"a", {"a"}, 1e3, 1e4, 4e3}, {"b", {"a"}, 1e3, 1e4, 4e3}}),
               {},
               {},
               100,
               std::nullopt,
               {}};
};

// Measured are 100 N, simulated 80 N; a tenth of the range of a, 900 N/m, changes the force by 18
// N. If a were 1000 N/m stiffer, the value at 10 mm would be 50 N instead of 40 N; the springs in
// series would change by half of that.
TEST_F(MissedValues, TellWhatWouldMendThemAndWhatPays) {
  measure({20.0, 40.0}, {40.0, 100.0});
  EXPECT_EQ(sentences(at({{4e3, 4e3}})),
            std::vector<std::string>{
                "alone, 20 mm is 20.0 % too low: a moves it most, by 18 % for a tenth of its "
                "range; corrected by it alone, alone, 10 mm would be 25.0 % too high"});
}

TEST_F(MissedValues, WithinThreeTimesTheirNoiseAreNone) {
  measure({20.0, 40.0}, {40.0, 81.0});
  EXPECT_TRUE(sentences(at({{4e3, 4e3}})).empty());
  for (StudyExperiment& experiment : study_.experiments) experiment.noise = {.relative = 0.004};
  EXPECT_EQ(sentences(at({{4e3, 4e3}})).size(), 1u);
  study_.experiments[1].loss = {Loss::huber, 1.345};
  EXPECT_TRUE(sentences(at({{4e3, 4e3}})).empty());
}

// A force of 500 N would need a stiffness a outside of its bounds.
TEST_F(MissedValues, BeyondTheBoundsOfTheVariableAreToldSo) {
  measure({20.0, 40.0}, {40.0, 500.0});
  EXPECT_EQ(
      sentences(at({{4e3, 4e3}})),
      std::vector<std::string>{"alone, 20 mm is 84.0 % too low: a moves it most, by 4 % for a "
                               "tenth of its range, and cannot correct it within its bounds"});
}

// The force of spring a alone does not depend on b, so b can be corrected without increasing any
// other error.
TEST_F(MissedValues, CanBeMendedForNothing) {
  measure({20.0, 40.0}, {40.0, 80.0});
  const auto found = missed_values(study_, at({{4e3, 2e3}}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].variable, 1);
  EXPECT_FALSE(found[0].payer);  // the other value of the curve improves, too
  EXPECT_NE(found[0].in_words(study_.space).find("would harm no other value"), std::string::npos);
}

// With 4000 and 5000 N/m in series, dk/da = (5/9)^2. Predictions are simulated when the gains are
// requested.
TEST_F(MissedValues, OfPredictionsAreToldAsSoonAsTheyAreSimulated) {
  measure({30.0, 200.0 / 4.5}, {40.0, 80.0});
  study_.experiments[0].fitted = false;
  const Identifiability what = at({{4e3, 5e3}});
  EXPECT_TRUE(sentences(what).empty());
  InlineExecutor executor(springs);
  ASSERT_TRUE(predict(study_, prediction_points(study_, what), executor, {}));
  const auto found = missed_values(study_, what);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].fitted);
  EXPECT_EQ(found[0].missed.name, "press, 10 mm");
  EXPECT_NEAR(found[0].missed.error, 200.0 / 9.0 / 30.0 - 1.0, 1e-9);
  EXPECT_EQ(found[0].variable, 0);
  // the derivatives come from one-sided differences
  EXPECT_NEAR(found[0].effect, 0.01 / 30.0 * 25.0 / 81.0 * 9e3, 0.02);
  ASSERT_TRUE(found[0].payer);
  EXPECT_EQ(found[0].payer->name.substr(0, 5), "alone");
  EXPECT_NE(found[0].in_words(study_.space).find("(it is not fitted)"), std::string::npos);
}

}  // namespace
}  // namespace latsch::correlation
