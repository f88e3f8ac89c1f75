// SPDX-License-Identifier: Apache-2.0
// The proof that a model is one file and a line: a spring nobody here knows goes through all that a
// study can do, with a language that has nothing else.
#include <gtest/gtest.h>

#include <cmath>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/search/study_fit.h"
#include "correlation/study/plausibility.h"
#include "correlation/study/spring_testing.h"
#include "correlation/study/study.h"
#include "correlation/study/variables.h"
#include "correlation/study_report/study_report.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/twin.h"
#include "evaluation/executors/inline_executor.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch::correlation {
namespace {

class AnyModel : public testing::Test {
 protected:
  AnyModel() {
    write_text_file(folder_ / "spring.toml",
                    "kind = \"spring\"\nstiffness = \"20 N/mm\"\ndamping = \"300 N s/m\"\n");
    write_text_file(
        folder_ / "slow.toml",
        "kind = \"pull\"\nspeed = \"0 m/s\"\ntravels = [\"2 mm\", \"5 mm\", \"9 mm\"]\n");
    write_text_file(
        folder_ / "fast.toml",
        "kind = \"pull\"\nspeed = \"0.4 m/s\"\ntravels = [\"2 mm\", \"5 mm\", \"9 mm\"]\n");
    write_text_file(folder_ / "study.toml", R"(
model = "spring.toml"
[test.slow]
file = "slow.toml"
[test.fast]
file = "fast.toml"
[variable.stiffness]
path = "stiffness"
lower = "5 N/mm"
upper = "60 N/mm"
initial = "9 N/mm"
[variable.damping]
path = "damping"
lower = "50 N s/m"
upper = "900 N s/m"
initial = "700 N s/m"
[experiment.slowly]
kind = "curve"
x = "slow/travel"
y = "slow/force"
measurement = "slowly.csv"
[experiment.swiftly]
kind = "curve"
x = "fast/travel"
y = "fast/force"
measurement = "swiftly.csv"
[experiment.alone]
kind = "curve"
y = "fast/force"
measurement = "alone.csv"
use = "predict"
[experiment.last]
kind = "values"
channel = "slow/force"
of = "last"
value = "180 N"
[experiment.each]
kind = "values"
channel = "fast/force"
values = ["160 N", "220 N", "300 N"]
use = "predict"
[doe]
design = "full_factorial"
levels = 3
)");
    for (const char* file : {"slowly.csv", "swiftly.csv", "alone.csv"})
      write_text_file(folder_ / file, "travel [m],force [N]\n0.002,1\n0.005,1\n0.009,1\n");
    const auto written = write_twin(read());  // 20 N/mm and 300 N s/m
    EXPECT_TRUE(written) << (written ? "" : written.failure().reason);
  }
  Study read() const {
    return read_study(
        folder_ / "study.toml", Measurements::required, experiment::spring_language());
  }

  ScratchFolder folder_;
};

TEST_F(AnyModel, IsFittedResumedIdentifiedPredictedAndReported) {
  const Study study = read();
  EXPECT_TRUE(implausible(study).empty());
  Journal journal = Journal::open(study.run.journal, identity(study));
  InlineExecutor executor(evaluator(study));
  const Fit found = fit(study, executor, journal, {});
  ASSERT_NE(found.run.best(), nullptr);
  EXPECT_NEAR(found.run.best()->point.values[0], 20e3, 1.0);
  EXPECT_NEAR(found.run.best()->point.values[1], 300.0, 0.1);

  const long trials = journal.size();
  EXPECT_EQ(fit(study, executor, journal, {}).run.best()->point, found.run.best()->point);
  EXPECT_EQ(journal.size(), trials);  // resumed with none

  EXPECT_EQ(run_doe(plan(*study.doe, study.space), executor, journal, {}), RunEnd::converged);
  EXPECT_EQ(journal.size(), trials + 9);

  const auto known =
      identify(study, found.run.best()->point, Depth::intervals, executor, journal, {});
  ASSERT_TRUE(known && *known);
  EXPECT_FALSE(std::isnan(reported_interval(study, **known, 0).lower));

  const auto page = study_report(study, journal);
  ASSERT_TRUE(page) << page.failure().reason;
  EXPECT_EQ(page->curves.size(), 5u);
  EXPECT_EQ(page->experiments[2].name, "alone");
  EXPECT_LT(page->experiments[2].mean_error, 1e-4);
  EXPECT_EQ(page->experiments[4].values, 3);
  EXPECT_LT(page->experiments[4].largest_error, 1e-4);  // 20 N/mm x + 300 N s/m 0.4 m/s

  const experiment::SpecimenKind& kind = *study.specimens->kind();
  EXPECT_NE(kind.text(at(study.model, study.space, found.run.best()->point)).find("stiffness"),
            std::string::npos);
}

TEST_F(AnyModel, ATestItCannotDoIsRefusedWithThoseThatCan) {
  write_text_file(folder_ / "slow.toml", "kind = \"drum_cleat\"\nspeed = \"3 m/s\"\n");
  try {
    read();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected \"pull\""), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace latsch::correlation
