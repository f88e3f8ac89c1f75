// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_stages.h"

#include <gmock/gmock.h>

#include "correlation/analysis/pareto_front.h"
#include "correlation/search/stage_runs.h"
#include "correlation/search/study_reuse_testing.h"

namespace latsch::correlation {
namespace {

class StudyStages : public FittedStudy {
 protected:
  static inline const std::string kStages = R"(
[stage.coarse]
model.PKY2 = 1.6
step_tolerance = 0.02
[stage.narrow]
bounds = 0.3
step_tolerance = 0.02
[stage.fine]
bounds = 0.1
step_tolerance = 0.0005
)";
  std::string complaint(const std::string& more) {
    try {
      read(more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(StudyStages, EachBeginsWhereTheOneBeforeEndedAndTheLastHasTheModelAsItIs) {
  const Study study = read(kStages);
  const auto fits = fit_all(study);
  ASSERT_EQ(fits.size(), 3u);
  for (int k : {1, 2}) {
    EXPECT_EQ(fits[k].run.steps.front().point, fits[k - 1].run.best()->point);
  }
  EXPECT_GT(fits[0].run.best()->outcome->value, 1e-4);  // another model leaves an error
  const DesignPoint found = fits[2].run.best()->point;
  EXPECT_NEAR(found.values[0], 1.3, 1e-3);
  EXPECT_NEAR(found.values[1], -22.0, 0.05);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "study.coarse.latsch"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "study.narrow.latsch"));  // no new model
  EXPECT_EQ(Journal::read(folder_ / "study.latsch", identity(study)).identity(), identity(study));
}

TEST_F(StudyStages, BoundsAreNarrowAroundTheBestPoint) {
  const Study study = read(kStages);
  const Study fine = stage(study, 2, DesignPoint{{1.3, -22.0}});
  EXPECT_NEAR(fine.space[0].upper - fine.space[0].lower, 0.15, 1e-12);
  EXPECT_EQ(fine.space.initial(), (DesignPoint{{1.3, -22.0}}));
  EXPECT_EQ(fine.optimizer.residual_trust_region.step_tolerance, 0.0005);
  EXPECT_EQ(stage(study, 0).model.get("PKY2"), 1.6);
  EXPECT_EQ(stage_called(study, "coarse").run.journal, folder_ / "study.coarse.latsch");
}

TEST_F(StudyStages, AKillInAnyStageChangesNoBit) {
  const Study study = read(kStages);
  const auto whole = fit_all(study);
  const long all = evaluated_;
  for (const long killed_after : {2L, all / 2, all - 2}) {
    for (const char* journal : {"study.latsch", "study.coarse.latsch"}) {
      std::filesystem::remove(folder_ / journal);
    }
    evaluated_ = 0;
    EXPECT_EQ(fit_all(study, 1, killed_after).back().run.end, RunEnd::stopped);
    evaluated_ = 0;
    expect_same(fit_all(study), whole);
    EXPECT_LE(evaluated_, all - killed_after + 1);  // nothing finished is repeated
  }
  expect_same(recorded_stages(study, Journal::read(study.run.journal)).fits, whole);
}

TEST_F(StudyStages, WorkersChangeNoBit) {
  const Study study = read(kStages);
  const auto one = fit_all(study);
  for (const char* journal : {"study.latsch", "study.coarse.latsch"}) {
    std::filesystem::remove(folder_ / journal);
  }
  expect_same(fit_all(study, 4), one);
}

// The side force alone determines grip and stiffness. The next stage determines the trail, on which
// the side force does not depend.
TEST_F(StudyStages, MoveTheirVariablesToTheirExperimentsAlone) {
  const std::string more =
      "[experiment.arm]\nkind = \"curve\"\ny = \"steady/Mz\"\nmeasurement = \"arm.csv\"\n"
      "exponent = 2\n"
      "[variable.trail]\npath = \"QDZ1\"\nlower = 0.01\nupper = 0.3\ninitial = 0.05\n"
      "[stage.force]\nfree = [\"stiffness\", \"grip\"]\nexperiments = [\"light\"]\n"
      "[stage.moment]\nfree = [\"trail\"]\nexperiments = [\"arm\"]\n[stage.all]\n";
  std::string torques = "Mz [N m]\n";
  for (int i = -12; i <= 12; ++i) torques += std::to_string(i) + "\n";
  write("arm.csv", torques);
  const DesignPoint truth{{1.3, -22.0, 0.12}};
  Channels measured;
  measured.add({"Mz", "N m", (*evaluator(read("exponent = 2\n" + more))(truth))["steady/Mz"]});
  write("arm.csv", formats::csv_text(measured));
  for (const char* method : {"auto", "residual_trust_region", "gss"}) {
    std::filesystem::remove(folder_ / "study.latsch");
    const Study study =
        read("exponent = 2\n" + more + "[optimizer]\nmethod = \"" + method + "\"\n");
    const auto fits = fit_all(study);
    ASSERT_EQ(fits.size(), 3u) << method;
    for (const auto& step : fits[0].run.steps) EXPECT_EQ(step.point.values[2], 0.05);
    const DesignPoint force = fits[0].run.best()->point, moment = fits[1].run.best()->point;
    for (const auto& step : fits[1].run.steps) {
      EXPECT_EQ(step.point.values[0], force.values[0]);
      EXPECT_EQ(step.point.values[1], force.values[1]);
    }
    EXPECT_NEAR(force.values[0], 1.3, 0.01) << method;
    EXPECT_NEAR(moment.values[2], 0.12, 0.001) << method;
    EXPECT_NEAR(fits[2].run.best()->point.values[2], 0.12, 0.001) << method;
    evaluated_ = 0;
    expect_same(fits, fit_all(study));
    EXPECT_EQ(evaluated_, 0) << method;  // one journal
  }
}

TEST_F(StudyStages, ARunThatIsHopelessSaysWhy) {
  const Study study = read("");
  Journal journal = Journal::open(study.run.journal, identity(study));
  InlineExecutor executor(
      [](const DesignPoint&) -> Result<Channels> { return Failure{"no license for 3 seats"}; });
  const Fit ended = fit(study, executor, journal, {});
  EXPECT_EQ(ended.hopeless, "no license for 3 seats");
  EXPECT_LE(journal.size(), 15);
  EXPECT_EQ(recorded_fit(study, journal)->hopeless, ended.hopeless);
}

TEST_F(StudyStages, ComplaintsNameTheStage) {
  const auto says = [&](const std::string& text, const char* part) {
    EXPECT_THAT(complaint(text), testing::HasSubstr(part)) << text;
  };
  says("[stage.a]\nmodel.PKY2 = 1.6\n", "in the last stage");
  says("[stage.a]\nmodel.PKX = 1.6\n[stage.b]\nbounds = 0.2\n", "no number of the model");
  says("[stage.a]\nmodel.PDY1 = 1.6\n[stage.b]\n", "a variable of the study");
  says("[stage.a]\nbounds = 0.2\n[stage.b]\n", "first stage");
  says("[stage.a]\n[stage.b]\nbounds = 2\n", "bounds");
  says("[stage.a]\nfree = [\"gripp\"]\n[stage.b]\n", "did you mean \"grip\"");
  says("[stage.a]\nfree = []\n[stage.b]\n", "empty");
  says("[stage.a]\nfree = [\"grip\", \"grip\"]\n[stage.b]\n", "twice");
  says("[stage.a]\nexperiments = [\"heavy\"]\n[stage.b]\n", "expected some of \"light\"");
  says("noise = \"own_stage\"\n", "no stage before the last one");
  says("noise = \"own_stage\"\n[stage.a]\n", "no stage before the last one");
  says("noise = \"own_stage\"\n[stage.a]\nmodel.PKY2 = 1.6\n[stage.b]\n",
       "has the unchanged model");
  says("[stage.a]\nrestart = 2\n[stage.b]\n", "unknown key");
  says("[stage.a]\nmethod = \"gss\"\nrestarts = 2\n[stage.b]\n", "restarts belongs to");
}

TEST_F(StudyStages, AFrontOfTwoExperimentsFollowsFromTheTrialsThereAre) {
  write("low.csv", [&] {
    const Study plain = read("");
    Channels measured;
    measured.add({"Fy", "N", (*evaluator(plain)({{1.0, -22.0}}))["steady/Fy"]});
    return formats::csv_text(measured);
  }());
  const std::string other = R"([experiment.heavy]
kind = "curve"
y = "steady/Fy"
measurement = "low.csv"
)";
  const Study study = read(other + "[doe]\nlevels = 7\n");
  {
    Journal journal = Journal::open(study.run.journal, identity(study));
    InlineExecutor executor(evaluator(study));
    run_doe(plan(*study.doe, study.space), executor, journal);
  }
  const Journal journal = Journal::read(study.run.journal, identity(study));
  const ParetoFront equal = pareto_front(study, journal, "light", "heavy");
  EXPECT_EQ(equal.front.size() + equal.others.size(), 49u);
  ASSERT_GE(equal.front.size(), 2u);
  for (std::size_t i = 1; i < equal.front.size(); ++i) {
    EXPECT_GT(equal.front[i].a, equal.front[i - 1].a);
    EXPECT_LT(equal.front[i].b, equal.front[i - 1].b);
  }
  for (const auto& trial : equal.others) {  // compares with the definition, trial by trial
    EXPECT_TRUE(std::any_of(equal.front.begin(), equal.front.end(), [&](const auto& f) {
      return f.a <= trial.a && f.b <= trial.b;
    }));
  }
  // Weights select a point on the front but do not change the front itself.
  const Study light = read("weight = 50\n" + other + "[doe]\nlevels = 7\n");
  const ParetoFront tilted = pareto_front(light, journal, "light", "heavy");
  EXPECT_EQ(tilted.front.size(), equal.front.size());
  EXPECT_EQ(tilted.best.point, tilted.front.front().point);
  EXPECT_THAT(pareto_page(light, tilted), testing::HasSubstr("<svg"));
  EXPECT_THROW(pareto_front(study, journal, "light", "dark"), InputError);
}

}  // namespace
}  // namespace latsch::correlation
