// SPDX-License-Identifier: Apache-2.0
// Studies of tires that roll: variables, tests and predictions in this process.
#include <gtest/gtest.h>

#include <fstream>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/study/study.h"
#include "correlation/study/variables.h"
#include "correlation/target/predictions.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/twin.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "formats/tables/csv_table.h"

namespace latsch::correlation {
namespace {

constexpr const char* kRollingStudy = R"(
[model]
kind = "magic_formula"
file = "tire.tir"
[test.steady]
file = "steady.toml"
[test.standing]
file = "standing.toml"
[variable.grip]
path = "PDY1"
lower = 0.5
upper = 2
initial = 1
[variable.stiffness]
path = "VERTICAL_STIFFNESS"
lower = "100 N/mm"
upper = "300 N/mm"
initial = "190 N/mm"
[experiment.side_force]
kind = "curve"
y = "steady/Fy"
measurement = "measured.csv"
[experiment.load]
kind = "curve"
x = "standing/deflection"
y = "standing/force"
measurement = "standing.csv"
use = "predict"
)";

class RollingStudy : public testing::Test {
 protected:
  RollingStudy() {
    write("tire.tir", experiment::sparse_tir(experiment::kSideForce));
    write("states.csv", "Fz [N],alpha [deg]\n4000,4\n4000,-4\n2000,2\n");
    write("steady.toml", "kind = \"steady_states\"\nstates = \"states.csv\"\n");
    write("standing.toml", "kind = \"static_stiffness\"\ndeflections = [\"10 mm\", \"20 mm\"]\n");
    write("measured.csv", "Fy [N]\n-3000\n3000\n-1000\n");
    write("standing.csv", "deflection [mm],force [N]\n10,1900\n20,3800\n");
    write("study.toml", kRollingStudy);
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  Study read() { return read_study(folder_ / "study.toml", experiment::language()); }
  std::string complaint(const std::string& from, const std::string& to) {
    std::string text = kRollingStudy;
    text.replace(text.find(from), from.size(), to);
    write("study.toml", text);
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
};

TEST_F(RollingStudy, ATrialRunsOnlyTheTestsThatFittedExperimentsNeed) {
  const Study study = read();
  EXPECT_EQ(tests_asked_for(study), std::vector<std::string>{"steady"});
  const auto channels = evaluator(study)(study.space.initial());
  ASSERT_TRUE(channels) << channels.failure().reason;
  EXPECT_TRUE(channels->find("steady/Fy"));
  EXPECT_FALSE(channels->find("standing/force"));
  const auto all = simulate_all(study, study.space.initial());
  ASSERT_TRUE(all);
  EXPECT_TRUE(all->find("standing/force"));
}

TEST_F(RollingStudy, AVariableMovesTheNumberOfItsPath) {
  const Study study = read();
  DesignPoint point = study.space.initial();
  point.values[1] = 2.5e5;
  const auto channels = simulate_all(study, point);
  ASSERT_TRUE(channels);
  EXPECT_NEAR((*channels)["standing/force"][0], 2.5e5 * 0.01, 1.0);  // Q_FZ2 = 0: a straight line
}

TEST_F(RollingStudy, NumbersWithUsualBoundsNeedNoMoreThanTheirNames) {
  std::string text = kRollingStudy;
  write("study.toml", "vary = [\"PCY1\", \"PKY2\"]\n" + text);
  const Study study = read();
  ASSERT_EQ(study.space.size(), 4);
  const DesignVariable& shape = study.space[2];
  EXPECT_EQ(shape.name, "PCY1");
  EXPECT_EQ(shape.paths, std::vector<std::string>{"PCY1"});
  EXPECT_EQ(shape.lower, 1.0);
  EXPECT_EQ(shape.initial, study.model.get("PCY1"));
  const auto refused = [&](const std::string& vary, const std::string& part) {
    write("study.toml", vary + text);
    try {
      read();
      ADD_FAILURE() << vary;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_EQ(error.place().line, 1);
    }
  };
  refused("vary = [\"FNOMIN\"]\n", "no usual bounds");
  refused("vary = [\"PCY9\"]\n", "no number at path");
  refused("vary = [\"PCY1\", \"PCY1\"]\n", "twice");
}

// The measurement was computed with a grip of 1.2, so at this value all residuals vanish.
TEST_F(RollingStudy, TheTargetVanishesAtTheValuesTheMeasurementCameFrom) {
  Study study = read();
  DesignPoint truth = study.space.initial();
  truth.values[0] = 1.2;
  const auto measured = evaluator(study)(truth);
  ASSERT_TRUE(measured);
  Channels table;
  table.add({"Fy", "N", (*measured)["steady/Fy"]});
  write("measured.csv", formats::csv_text(table));
  study = read();
  const auto at_truth = objective(study)(*evaluator(study)(truth));
  const auto at_start = objective(study)(*evaluator(study)(study.space.initial()));
  ASSERT_TRUE(at_truth && at_start);
  EXPECT_LT(at_truth->value, 1e-12);
  EXPECT_GT(at_start->value, 0.01);
}

TEST_F(RollingStudy, TheJournalKnowsModelTestsAndStates) {
  const StudyIdentity before = identity(read());
  write("measured.csv", "Fy [N]\n-3100\n3100\n-1100\n");
  EXPECT_EQ(identity(read()), before);  // a changed measurement needs no new trial
  write("states.csv", "Fz [N],alpha [deg]\n4000,5\n4000,-4\n2000,2\n");
  EXPECT_NE(identity(read()), before);
}

// Such a measurement is refused at once, because otherwise every trial of a run would fail.
TEST_F(RollingStudy, AMeasurementThatReachesBeyondItsTestIsRefusedBeforeTheFirstTrial) {
  const auto says = [&](const std::string& part) {
    try {
      read();
      ADD_FAILURE() << part;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  write("standing.csv", "deflection [mm],force [N]\n10,1900\n25,3800\n");
  says(
      "experiment.load.measurement reaches from 0.01 to 0.025 m, but the test \"standing\" from "
      "0.01 to 0.02");
  write("standing.csv", "deflection [mm],force [N]\n10,1900\n20,3800\n");
  write("measured.csv", "Fy [N]\n-3000\n3000\n");
  says("has 2 values, but the test \"steady\" gives 3");
}

TEST_F(RollingStudy, TheJournalKnowsTheVersionOfTheModel) {
  const Study study = read();
  StudyIdentity before = identity(study);
  for (IdentityPart& part : before)
    if (part.name == kModelVersionPart) part.text = "magic_formula 1\n";
  const auto what = difference(before, identity(study));
  ASSERT_TRUE(what);
  EXPECT_NE(what->find("model version"), std::string::npos) << *what;
}

TEST_F(RollingStudy, PredictionsAreTrialsOfTheirOwn) {
  const Study study = read();
  EXPECT_NE(identity(with_predictions(study)), identity(study));
}

// A force is compared in the frame of its measurement, because the difference between two frames is
// not small.
TEST_F(RollingStudy, AMeasurementInOtherAxesThanTheTestIsRefused) {
  write("sweep.toml",
        "kind = \"slip_sweep\"\nspeed = \"40 km/h\"\nload = \"4 kN\"\n"
        "alpha = [\"-6 deg\", \"6 deg\"]\nduration = \"10 ms\"\nsample_step = \"5 ms\"\n");
  write("axes.csv", "time [s],FyW [N],FYC [N]\n0.46,-3000,-3000\n");
  write("other.csv", "time [s],FYC [N]\n0.46,-3000\n");
  const std::string steady = "[test.steady]\nfile = \"steady.toml\"\n";
  const auto with = [&](const std::string& measurement, const std::string& more) {
    std::string text = kRollingStudy;
    const std::string experiment = "y = \"steady/Fy\"\nmeasurement = \"measured.csv\"\n";
    text.replace(
        text.find(experiment),
        experiment.size(),
        "x = \"sweep/time\"\ny = \"sweep/Fy\"\nmeasurement = \"" + measurement + "\"\n" + more);
    text.replace(text.find(steady), steady.size(), "[test.sweep]\nfile = \"sweep.toml\"\n");
    write("study.toml", text);
    try {
      read();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(with("axes.csv", ""), "");
  EXPECT_EQ(with("axes.csv", "frame = \"W\"\n"), "");
  EXPECT_NE(with("other.csv", "").find("or frame = \"C\" into [test.sweep] or its file"),
            std::string::npos);
  EXPECT_NE(with("other.csv", "frame = \"W\"\n").find("has the column \"FYC\""), std::string::npos);
}

TEST_F(RollingStudy, ATwinIsWrittenButNotOverTheStatesOfATest) {
  ASSERT_TRUE(write_twin(read()));
  EXPECT_NEAR(
      formats::CsvTable::read(folder_ / "standing.csv").numbers("force", "N")[1], 3800, 1e-6);
  const auto at_truth = simulate_all(read(), read().space.initial());
  const Study written = read();
  EXPECT_EQ(compare(written.experiments[0], written.experiments, *at_truth).largest_error, 0.0);

  std::string text = kRollingStudy;
  text.replace(text.find("\"measured.csv\""), 14, "\"states.csv\"");
  const std::string states = "Fz [N],alpha [deg],Fy [N]\n4000,4,-1\n4000,-4,1\n2000,2,-1\n";
  write("states.csv", states);
  write("study.toml", text);
  EXPECT_THROW((void)write_twin(read()), InputError);
  EXPECT_EQ(read_text_file(folder_ / "states.csv"), states);
}

// A load-deflection experiment is available for every model that can run it, not only for finite
// elements.
TEST_F(RollingStudy, IsPressedOnTheGroundAsAnyTireIs) {
  const std::string press =
      "[experiment.press]\nkind = \"load_deflection\"\nmeasurement = \"standing.csv\"\n";
  write("study.toml", kRollingStudy + press);
  const Study study = read();
  const auto channels = simulate_all(study, study.space.initial());
  ASSERT_TRUE(channels) << channels.failure().reason;
  const Comparison comparison = compare(study.experiments.back(), study.experiments, *channels);
  EXPECT_EQ(comparison.errors.size(), 2u);
  EXPECT_NEAR(comparison.mean_error, 0.0, 1e-9);  // 190 N/mm, as measured
  EXPECT_EQ(tests_asked_for(study), (std::vector<std::string>{"steady", "press"}));
  // A rolling tire's recording has no contact patch, so its values are shown as not known.
  const auto& observable = *study.experiments.back().observable;
  EXPECT_NE(observable.table(*channels, comparison).find(" - "), std::string::npos);

  write("study.toml", kRollingStudy + press + "friction = 0.8\n");
  try {
    read();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("takes friction"), std::string::npos) << error.what();
  }
}

TEST_F(RollingStudy, ComplaintsSayWhereAndWhatIsExpected) {
  EXPECT_NE(complaint("\"magic_formula\"", "\"mf\"").find("\"ring_tire\""), std::string::npos);
  EXPECT_NE(complaint("[experiment.side", "[experiments.side")
                .find("unknown table [experiments], did you mean \"experiment\"?"),
            std::string::npos);
  EXPECT_NE(complaint("steady/Fy\"", "steady/FY\"").find("steady/Fy"), std::string::npos);
  EXPECT_NE(complaint("file = \"steady.toml\"", "file = \"stead.toml\"").find("does not exist"),
            std::string::npos);
  const std::string text = kRollingStudy;
  const auto from = text.find("[test.steady]"), to = text.find("[variable.grip]");
  const std::string missing = complaint(text.substr(from, to - from), "");
  EXPECT_NE(missing.find("[test] is missing"), std::string::npos) << missing;
  // the model's file states the value
  EXPECT_EQ(complaint(text.substr(0, from), "\nmodel = \"tire.tir\"\n"), "");
  EXPECT_NE(missing.find("[test.cleat]\n    file = \"cleat.toml\""), std::string::npos) << missing;
  EXPECT_NE(complaint("\"PDY1\"", "\"PDY11\"").find("PDY1"), std::string::npos);
  EXPECT_NE(complaint("\"100 N/mm\"", "\"-100 N/mm\"").find("does not accept"), std::string::npos);
  EXPECT_NE(complaint("\"magic_formula\"", "\"rigid_ring\"")
                .find("for a model that has steady states, which a rigid ring does not"),
            std::string::npos);
}

}  // namespace
}  // namespace latsch::correlation
