// SPDX-License-Identifier: Apache-2.0
// Tests the limits that a study states before it runs: those of a tire's file hold in every trial,
// unless the study varies one of them.
#include "correlation/target/test_limits.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/kinds/sparse_tir_testing.h"

namespace latsch::correlation {
namespace {

class LimitsOfTests : public testing::Test {
 protected:
  LimitsOfTests() {
    write_text_file(folder_ / "tire.tir",
                    experiment::sparse_tir(experiment::kSideForce) +
                        "[VERTICAL_FORCE_RANGE]\nFZMIN = 100\nFZMAX = 4500\n");
    write_text_file(folder_ / "run.csv",
                    "Fz [N],alpha [deg],Fy [N]\n3000,1,-1000\n4000,1,-1200\n5000,1,-1400\n"
                    "6000,1,-1500\n");
  }
  /// Returns the sentences of a study with two experiments on one test and this variable.
  std::string told(const std::string& variable) {
    write_text_file(folder_ / "study.toml",
                    "model = \"tire.tir\"\n[measurement.run]\nfile = \"run.csv\"\naxes = "
                    "\"iso\"\n[test.steady]\nkind = \"steady_states\"\nstates = {from = "
                    "\"measurement.run\"}\n" +
                        variable +
                        "[experiment.side]\nkind = \"curve\"\ny = \"steady/Fy\"\nmeasurement = "
                        "\"run\"\n");
    const Study study = read_study(folder_ / "study.toml", experiment::language());
    std::string all;
    for (const std::string& one : limits_of_tests(study)) all += one + "\n";
    return all;
  }

  ScratchFolder folder_;
};

constexpr const char* kVariedStiffness =
    "[variable.PKY1]\npath = \"PKY1\"\nlower = -30\nupper = -5\ninitial = -15\n";

TEST_F(LimitsOfTests, CountTheStatesBeyondEachRange) {
  const std::string text = told(kVariedStiffness);
  EXPECT_NE(text.find("test steady: 2 of 4 states lie outside of the ranges"), text.npos) << text;
  EXPECT_NE(text.find("Fz above FZMAX = 4500 N in 2, up to 6000 N"), text.npos) << text;
  EXPECT_EQ(text.find("in trials with"), text.npos) << text;
}

// The best trial may have any of these ranges; the others limited more states, or fewer.
TEST_F(LimitsOfTests, AreThoseAtBothBoundsIfTheStudyVariesARange) {
  const std::string text = told(
      "[variable.most]\npath = \"FZMAX\"\nlower = \"3.5 kN\"\nupper = \"8 kN\"\ninitial = "
      "\"5.5 kN\"\n");
  EXPECT_NE(text.find("test steady: 1 of 4 states lie outside"), text.npos) << text;
  EXPECT_NE(text.find("test steady, in trials with most at its lower bound: 3 of 4 states lie "
                      "outside"),
            text.npos)
      << text;
  EXPECT_NE(text.find("FZMAX = 3500 N in 3, up to 6000 N"), text.npos) << text;
  EXPECT_EQ(text.find("upper bound"), text.npos) << text;
}

}  // namespace
}  // namespace latsch::correlation
