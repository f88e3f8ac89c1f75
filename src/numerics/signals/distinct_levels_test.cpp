// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/distinct_levels.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace latsch::numerics {
namespace {

constexpr LevelResolution kPressure{1.5e3, 20e3};  // Pa

/// Returns a signal that rests at each of the set points, with noise of the given standard
/// deviation, and moves slowly from each to the next.
std::vector<double> held(const std::vector<double>& points, double deviation, int samples) {
  std::mt19937 chance(3);
  std::normal_distribution<double> normal;  // without the deviation, which may be 0 here alone
  std::vector<double> all;
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (int i = 0; i < samples; ++i) all.push_back(points[k] + deviation * normal(chance));
    for (int i = 0; k + 1 < points.size() && i < samples / 100; ++i)
      all.push_back(points[k] + (points[k + 1] - points[k]) * i * 100.0 / samples);
  }
  return all;
}

TEST(DistinctLevels, AreTheSetPointsOfARigWhateverItsNoise) {
  for (const double deviation : {0.0, 100.0, 500.0, 1500.0}) {
    const DistinctLevels two = distinct_levels(held({69e3, 83e3}, deviation, 1500), kPressure);
    EXPECT_EQ(two.count(), 2) << deviation;
    EXPECT_NEAR(two.values.front(), 69e3, 300.0);
    EXPECT_NEAR(two.values.back(), 83e3, 300.0);
    EXPECT_EQ(distinct_levels(held({69e3, 83e3, 97e3}, deviation, 900), kPressure).count(), 3);
    EXPECT_EQ(distinct_levels(held({83e3}, deviation, 900), kPressure).count(), 1) << deviation;
  }
}

TEST(DistinctLevels, UnequalSharesAndAnyOrderCount) {
  std::vector<double> values = held({69e3}, 400.0, 3000);
  for (const double more : held({97e3}, 400.0, 90)) values.push_back(more);
  std::reverse(values.begin(), values.end());
  EXPECT_EQ(distinct_levels(values, kPressure).count(), 2);
}

// The pressure of a tire that warms up rises: this is one level, not a sweep.
TEST(DistinctLevels, ADriftIsOneLevelAndASweepIsMany) {
  std::vector<double> drift, sweep;
  for (int i = 0; i < 3000; ++i) {
    drift.push_back(80e3 + 4e3 * i / 3000.0);
    sweep.push_back(60e3 + 60e3 * i / 3000.0);
  }
  EXPECT_EQ(distinct_levels(drift, kPressure).count(), 1);
  EXPECT_TRUE(distinct_levels(sweep, kPressure).is_swept);
  EXPECT_GT(distinct_levels(sweep, kPressure).count(), 100);
}

TEST(DistinctLevels, WhatIsNotFiniteOrNotThereHasNone) {
  EXPECT_EQ(distinct_levels({}, kPressure).count(), 0);
  EXPECT_EQ(distinct_levels({NAN, INFINITY}, kPressure).count(), 0);
  EXPECT_EQ(distinct_levels({83e3, NAN, 83e3}, kPressure).count(), 1);
  // The values are far beyond the range that can be resolved.
  EXPECT_EQ(distinct_levels({0.0, 1e12}, kPressure).count(), 2);
}

}  // namespace
}  // namespace latsch::numerics
