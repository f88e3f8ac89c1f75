// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/refinement.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/scratch_folder_testing.h"
#include "correlation/study/spring_testing.h"
#include "correlation/target/study_trials.h"

namespace latsch::correlation {
namespace {

const std::string kPulledStudy = R"(
model = "spring.toml"
[test.fast]
file = "fast.toml"
[variable.stiffness]
path = "stiffness"
lower = "5 N/mm"
upper = "60 N/mm"
initial = "10 N/mm"
[experiment.pulled]
kind = "curve"
x = "fast/travel"
y = "fast/force"
measurement = "pulled.csv"
)";

const std::string kProgramStudy = R"(
[simulator]
command = ["/bin/sh", "{study}/coarse.sh"]
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
[refined.simulator]
command = ["/bin/sh", "{study}/fine.sh"]
inputs = ["in.txt"]
[refined.simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["t [s]", "z [mm]"]
)";

class RefinedStudy : public testing::Test {
 protected:
  void SetUp() override {
    write("spring.toml", "kind = \"spring\"\nstiffness = \"20 N/mm\"\ndamping = \"300 N s/m\"\n");
    const std::string pull = "kind = \"pull\"\ntravels = [\"2 mm\", \"5 mm\"]\nspeed = ";
    write("fast.toml", pull + "\"0.4 m/s\"\n");
    write("fine.toml", pull + "\"0.5 m/s\"\n");
    write("pulled.csv", "travel [m],force [N]\n0.002,160\n0.005,220\n");
  }
  void write(const char* name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  Study read(const std::string& text) {
    write("study.toml", text);
    return read_study(folder_ / "study.toml", experiment::spring_language());
  }
  std::string complaint(const std::string& more) {
    try {
      read(kPulledStudy + more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  static std::vector<double> recorded(const Study& study, double value, const char* channel) {
    const auto channels = evaluator(study)({{value}});
    EXPECT_TRUE(channels.ok());
    return channels ? (*channels)[channel] : std::vector<double>{};
  }

  ScratchFolder folder_;
};

// The force is 10 N/mm times travel plus damping times speed.
TEST_F(RefinedStudy, HasOtherNumbersAndTestsBesideTheVariables) {
  const Study study = read(kPulledStudy +
                           "[refined]\nmodel.damping = \"200 N s/m\"\n"
                           "[refined.test.fast]\nfile = \"fine.toml\"\n");
  EXPECT_EQ(recorded(study, 1e4, "fast/force"), (std::vector<double>{20 + 120, 50 + 120}));
  const Study finer = refined(study);
  EXPECT_EQ(recorded(finer, 1e4, "fast/force"), (std::vector<double>{20 + 100, 50 + 100}));
  EXPECT_EQ(in_words(*study.refinement), "damping = 200; tests fast");
  EXPECT_EQ(finer.run.journal, folder_ / "study.refined.latsch");
  EXPECT_NE(identity(finer), identity(study));
}

// No step of a search depends on the refinement, so the study keeps its journal.
TEST_F(RefinedStudy, IsNoPartOfTheSearch) {
  const Study plain = read(kPulledStudy);
  const Study study = read(kPulledStudy + "[refined.test.fast]\nfile = \"fine.toml\"\n");
  EXPECT_FALSE(plain.refinement);
  EXPECT_EQ(identity(study), identity(plain));
  EXPECT_EQ(study.search_key, plain.search_key);
}

TEST_F(RefinedStudy, OfAnOutsideProgramIsAnother) {
  write("in.txt", "{k}\n");
  write("coarse.sh", "read k < in.txt; printf 't [s],z [mm]\\n0,0\\n1,%s\\n' $k > out.csv");
  write("fine.sh", "read k < in.txt; printf 't [s],z [mm]\\n0,1\\n1,%s\\n' $k > out.csv");
  write("measured.csv", "t [s],z [mm]\n0.5,1.5\n1,4\n");
  const Study study = read(kProgramStudy);
  EXPECT_EQ(recorded(study, 2000.0, "out/z"), (std::vector<double>{0.0, 2e-3}));
  EXPECT_EQ(recorded(refined(study), 2000.0, "out/z"), (std::vector<double>{1e-3, 2e-3}));
}

TEST_F(RefinedStudy, SaysWhatIsWrongInIt) {
  const auto expect = [&](const std::string& more, const std::string& part) {
    const std::string said = complaint(more);
    EXPECT_NE(said.find(part), std::string::npos) << said;
  };
  expect("[refined]\n", "changes nothing");
  expect("[refined]\nmodel.stiffness = \"5 N/mm\"\n", "a variable of the study");
  expect("[refined]\nmodel.damper = \"5 N s/m\"\n", "leads to no number");
  expect("[refined]\nmodel.damping = \"-5 N s/m\"\n", "not accepted");
  expect("[refined.test.fats]\nfile = \"fine.toml\"\n", "did you mean \"fast\"");
  expect("[refined.test.fast]\nfile = \"finest.toml\"\n", "does not exist");
  expect("[refined.simulator]\ncommand = [\"sh\"]\n", "this study has a model");
  expect("[refined]\nmodel.damping = \"5 N s/m\"\nspeed = 3\n", "unknown key \"refined.speed\"");
}

}  // namespace
}  // namespace latsch::correlation
