// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/mat_runs.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace latsch::formats {
namespace {

MatVariable vector_of(const std::string& name, std::size_t count, double value = 1.0) {
  return {name, {1, count}, std::vector<double>(count, value), "", false};
}

MatVariable text_of_mat(const std::string& name, const std::string& text) {
  return {name, {1, text.size()}, {}, text, true};
}

MatFile two_runs() {
  MatFile file;
  file.file = "two.mat";
  for (const char* run : {"run1", "runs(2)"}) {
    for (const char* channel : {"SA", "FZ"}) {
      const std::string path = std::string(run) + "." + channel;
      file.variables.push_back(vector_of(path + ".data", 3));
      file.variables.push_back(text_of_mat(path + ".unit", *channel == 'S' ? "deg" : "N"));
    }
  }
  return file;
}

TEST(MatRuns, AreTheStructsWithSeveralKnownChannels) {
  MatFile file = two_runs();
  file.variables.push_back(vector_of("calibration.FZ", 5));  // a single channel is not a recording
  EXPECT_EQ(runs_in(file), (std::vector<std::string>{"run1", "runs(2)"}));
}

TEST(MatRuns, AreReadUnderTheNamesInTheirStruct) {
  const auto named = run_of(two_runs(), "runs(2)").named_channels();
  ASSERT_EQ(named.columns.size(), 2u);
  EXPECT_EQ(named.columns[1].name, "FZ");
  EXPECT_EQ(named.columns[1].unit, "N");
  EXPECT_EQ(named.channels["FZ"], (std::vector<double>{1.0, 1.0, 1.0}));
}

TEST(MatRuns, AnAbsentStructIsRefusedWithTheOthers) {
  try {
    run_of(two_runs(), "run");
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("has no struct \"run\""), text.npos) << text;
    EXPECT_NE(text.find("\"run1\""), text.npos) << text;
  }
}

TEST(MatConstants, AreTheSameInAllSamplesIfTheyHaveAUnit) {
  MatFile file;
  file.variables = {vector_of("SA", 4),
                    vector_of("FZ", 4),
                    vector_of("P.value", 1, 82.7),
                    text_of_mat("P.unit", "kPa"),
                    vector_of("N", 1, 60.0)};  // without a unit it may be a number of samples
  EXPECT_EQ(spread_constants({}, file), (std::set<std::string>{"P"}));
  const auto named = file.named_channels();
  EXPECT_EQ(named.channels["P"], (std::vector<double>(4, 82.7e3)));
  EXPECT_EQ(named.channels.find("N"), nullptr);
}

TEST(MatConstants, AreNoneBesideAVectorOfTheSameChannel) {
  MatFile file;
  file.variables = {vector_of("FZ", 4), vector_of("P", 4), vector_of("pressure", 1, 82.7)};
  EXPECT_TRUE(spread_constants({}, file).empty());
  EXPECT_EQ(spread_constants({{"FZ", "N"}, {"P", "kPa"}}, file).size(), 0u);
}

}  // namespace
}  // namespace latsch::formats
