// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/filler_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

/// Returns a side force as a rig writes it: a sweep with noise, none of which repeats.
std::vector<double> sweep(double amplitude) {
  std::vector<double> values;
  for (int i = 0; i < 200; ++i)
    values.push_back(amplitude * std::sin(0.07 * i) + 0.01 * amplitude * std::sin(12.9898 * i * i));
  return values;
}

TEST(FillerNumbers, UsualFillersAreCertainBesideOtherValues) {
  for (const double filler : {-9999.0,
                              9999.0,
                              99999.0,
                              -99999.9,
                              32767.0,
                              -32768.0,
                              65535.0,
                              1e30,
                              -1e31,
                              3.4e38,
                              8388607.0,
                              -8888.0,
                              2147483647.0}) {
    std::vector<double> values = sweep(2000.0);
    for (const int i : {3, 4, 5, 77}) values[static_cast<std::size_t>(i)] = filler;
    const auto found = filler_numbers(values, true);
    ASSERT_EQ(found.size(), 1u) << filler;
    EXPECT_EQ(found[0].number, filler);
    EXPECT_EQ(found[0].samples, (std::vector<std::size_t>{3, 4, 5, 77}));
    EXPECT_TRUE(found[0].is_certain) << filler;
  }
}

// -999 N is within the range of the channel; only the jump to it shows what it is.
TEST(FillerNumbers, AFillerWithinTheRangeIsFoundByItsJump) {
  std::vector<double> values = sweep(2000.0);
  // at these samples the sweep is close to its largest value
  for (std::size_t i = 20; i < 23; ++i) values[i] = -999.0;
  const auto found = filler_numbers(values, true);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_certain);
}

TEST(FillerNumbers, MeasuredValuesAreNone) {
  EXPECT_TRUE(filler_numbers(sweep(2000.0), true).empty());
  EXPECT_TRUE(filler_numbers(sweep(20000.0), true).empty());
  std::vector<double> index;
  for (int i = 0; i < 12000; ++i) index.push_back(i);  // passes 999, 7777, 8888, 9999
  EXPECT_TRUE(filler_numbers(index, false).empty());
  std::vector<double> levels;
  for (int i = 0; i < 60; ++i) levels.push_back(i / 20 == 0 ? 500.0 : i / 20 == 1 ? 999.0 : 1500.0);
  EXPECT_TRUE(filler_numbers(levels, false).empty());
  EXPECT_TRUE(filler_numbers(std::vector<double>(50, 83.0), false).empty());
  EXPECT_TRUE(filler_numbers({500.0, 999.0}, false).empty());
  EXPECT_TRUE(filler_numbers({}, true).empty());
  EXPECT_TRUE(filler_numbers({std::nan(""), std::nan("")}, true).empty());
}

TEST(FillerNumbers, ARepeatedEndFarFromAllOthersIsPossible) {
  std::vector<double> values = sweep(2000.0);
  for (std::size_t i = 60; i < 66; ++i) values[i] = -12345.6;
  const auto found = filler_numbers(values, false);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].is_certain);
  EXPECT_EQ(found[0].samples.size(), 6u);
}

TEST(FillerNumbers, ASaturatedForceIsPossible) {
  std::vector<double> values = sweep(2000.0);
  for (double& value : values) value = std::min(value, 1500.0);
  const auto found = filler_numbers(values, true);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].number, 1500.0);
  EXPECT_NE(found[0].reason.find("saturates"), std::string::npos);
  EXPECT_TRUE(filler_numbers(values, false).empty());
}

TEST(FillerNumbers, RunsAreShort) {
  EXPECT_EQ(runs_in_words({12}), "12");
  EXPECT_EQ(runs_in_words({12, 13, 40, 41, 42, 43}), "12, 13, 40 to 43");
  std::vector<long> many;
  for (long i = 0; i < 40; i += 2) many.push_back(i);
  EXPECT_EQ(runs_in_words(many), "0, 2, 4, 6, 8, 10, 12, 14 and 12 more");
}

}  // namespace
}  // namespace latsch
