// SPDX-License-Identifier: Apache-2.0
// Studies with an outside program as the model.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "base/scratch_folder_testing.h"
#include "correlation/study/study.h"
#include "correlation/target/study_trials.h"

namespace latsch::correlation {
namespace {

const std::string kSimulatorStudy = R"(
[simulator]
command = ["/bin/sh", "{study}/program.sh"]
inputs = ["in.txt"]
[simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["t [s]", "z [mm]"]
[variable.k]
lower = "1 N/mm"
upper = "9 N/mm"
initial = "2 N/mm"
[experiment.step]
kind = "curve"
x = "out/t"
y = "out/z"
measurement = "measured.csv"
)";

class SimulatorStudy : public testing::Test {
 protected:
  void SetUp() override {
    write("study.toml", kSimulatorStudy);
    write("in.txt", "{k}\n");
    write("program.sh",
          "read k < in.txt; printf 't [s],z [mm]\\n0,0\\n1,%s\\n2,4\\n' $k > out.csv");
    write("measured.csv", "t [s],z [mm]\n0.5,1.5\n2,4\n");
  }
  void write(const char* name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  Study read() { return read_study(folder_ / "study.toml", experiment::language()); }

  void refused(const std::string& from, const std::string& to, const std::string& part) {
    std::string text = kSimulatorStudy;
    text.replace(text.find(from), from.size(), to);
    write("study.toml", text);
    try {
      read();
      FAIL() << to;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  ScratchFolder folder_;
};

// On the line from (0, 0) to (1, k), z(0.5) = k / 2: the measured 1.5 mm needs k = 3, and the scale
// is 4 mm. With one experiment of two values, each residual is sqrt(1/2) times the difference.
TEST_F(SimulatorStudy, ResidualsAreThoseOfTheInterpolatedCurve) {
  const Study study = read();
  const auto channels = evaluator(study)({{2000.0}});
  ASSERT_TRUE(channels.ok()) << channels.failure().reason;
  const auto score = objective(study)(*channels);
  ASSERT_TRUE(score.ok());
  ASSERT_EQ(score->residuals.size(), 2u);
  EXPECT_NEAR(score->residuals[0], std::sqrt(0.5) * (1.5 - 1.0) / 4.0, 1e-14);
  EXPECT_NEAR(score->residuals[1], 0.0, 1e-14);
  EXPECT_NEAR(score->value, 0.0625, 1e-14);
}

// A recording that ends before the measurement gives no target. The trial itself remains valid: if
// the measurement is shortened, the trial has a target.
TEST_F(SimulatorStudy, ARecordThatEndsTooEarlyHasNoTarget) {
  write("measured.csv", "t [s],z [mm]\n0.5,1.5\n3,4\n");
  const Study study = read();
  const auto channels = evaluator(study)({{2000.0}});
  ASSERT_TRUE(channels.ok()) << channels.failure().reason;
  const auto score = objective(study)(*channels);
  ASSERT_FALSE(score.ok());
  EXPECT_EQ(score.failure().cause, Cause::bad_output);
  EXPECT_NE(score.failure().reason.find("reaches from 0 to 2 s, but was measured at 3 s"),
            std::string::npos)
      << score.failure().reason;
  write("measured.csv", "t [s],z [mm]\n0.5,1.5\n2,4\n");
  EXPECT_TRUE(objective(read())(*channels).ok());
}

// The program sums its time steps, so its last time differs by rounding from the end of the
// measurement.
TEST_F(SimulatorStudy, AnEndIsReachedWithinRounding) {
  const auto score_at = [&](const char* last) {
    write("measured.csv", std::string("t [s],z [mm]\n0.5,1.5\n") + last + ",4\n");
    const Study study = read();
    const auto channels = evaluator(study)({{2000.0}});
    const auto score = objective(study)(*channels);
    return score.ok() ? score->value : -1.0;
  };
  const double at_end = score_at("2");
  EXPECT_GE(at_end, 0.0);
  EXPECT_EQ(score_at("2.000000000000002"), at_end);
  EXPECT_EQ(score_at("2.000001"), -1.0);
}

TEST_F(SimulatorStudy, AVariableMayBeAPlainNumber) {
  std::string text = kSimulatorStudy;
  const std::string with_units = "lower = \"1 N/mm\"\nupper = \"9 N/mm\"\ninitial = \"2 N/mm\"";
  text.replace(text.find(with_units), with_units.size(), "lower = 1\nupper = 9\ninitial = 2");
  write("study.toml", text);
  EXPECT_EQ(read().space[0].unit, "1");
  EXPECT_EQ(read().space[0].initial, 2.0);
}

TEST_F(SimulatorStudy, TheJournalOfAnotherProgramIsNotReused) {
  const StudyIdentity before = identity(read());
  write("in.txt", "{k:%.3f}\n");
  EXPECT_TRUE(difference(before, identity(read())));
  write("in.txt", "{k}\n");
  EXPECT_FALSE(difference(before, identity(read())));
}

// The script may be in any folder; only its content matters.
TEST_F(SimulatorStudy, AProgramThatChangedMakesAnotherIdentityAndSaysWhichFileItIs) {
  const StudyIdentity before = identity(read());
  write("program.sh", "read k < in.txt; printf 't [s],z [mm]\\n0,0\\n2,%s\\n' $k > out.csv");
  const auto what = difference(before, identity(read()));
  ASSERT_TRUE(what);
  EXPECT_NE(what->find("program files"), std::string::npos) << *what;
  EXPECT_NE(what->find("{study}/program.sh"), std::string::npos) << *what;
  EXPECT_TRUE(is_same_but_for_versions(before, identity(read())));
}

TEST_F(SimulatorStudy, WhatMakesNoSenseIsRefusedInWords) {
  refused("\"in.txt\"", "\"absent.txt\"", "absent.txt");
  refused("[variable.k]", "[variable.k2]", "names no variable of the study, did you mean \"k2\"");
  refused("\"out/z\"", "\"out/w\"", "there are \"out/t\" or \"out/z\"");
  refused("t [s]", "t [parsnip]", "expected a name and a unit");
  refused(
      "reader = \"table\"", "reader = \"pattern\"\npattern = '(\\S+'", "not a regular expression");
  refused("reader = \"table\"", "reader = \"pattern\"\npattern = '(.)'", "1 groups");
  refused(
      "reader = \"table\"", "reader = \"columns\"\ncolumns = [1]", "are 1, expected one for each");
  refused("kind = \"curve\"", "kind = \"modes\"", "curve");
  refused("command = [\"/bin/sh\", \"{study}/program.sh\"]", "command = []", "expected a program");
  refused("command =", "comand =", "command");
  refused("inputs =", "timeout = \"5 N\"\ninputs =", "timeout is \"5 N\"");
}

}  // namespace
}  // namespace latsch::correlation
