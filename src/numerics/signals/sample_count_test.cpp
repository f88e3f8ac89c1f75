// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/sample_count.h"

#include <gtest/gtest.h>

#include <limits>

namespace latsch::numerics {
namespace {

TEST(SampleCount, IsRounded) {
  EXPECT_EQ(sample_count(0.2, 1000.0), 200);
  EXPECT_EQ(sample_count(0.0014, 1000.0), 1);
  EXPECT_EQ(sample_count(0.0016, 1000.0), 2);
  EXPECT_EQ(sample_count(0.0, 1000.0), 0);
}

// 4294968 s at 1000 samples per second are 2^32 + 704 samples; a conversion to a 32-bit integer
// would keep only the 704.
TEST(SampleCount, IsLargeForATimeThatNoIntegerHolds) {
  for (const double seconds : {1e6, 2147484.0, 4294968.0, 1e16, 1e300})
    EXPECT_EQ(sample_count(seconds, 1000.0), kMostSampleCount) << seconds;
  EXPECT_EQ(sample_count(std::numeric_limits<double>::max(), 1e9), kMostSampleCount);
  EXPECT_GT(std::numeric_limits<int>::max() - 4 * kMostSampleCount, 0);
}

}  // namespace
}  // namespace latsch::numerics
