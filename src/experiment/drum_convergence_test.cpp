// SPDX-License-Identifier: Apache-2.0
#include "experiment/drum_convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::experiment {
namespace {

Document example_ring() {
  return Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                        "studies/ring_tires/passenger_205_55R16.toml");
}

DrumTest test_with(double step) {
  return {.speed = 30.0 / 3.6,
          .load = 3500.0,
          .run_in = 0.08,
          .duration = 0.128,
          .lead = 0.04,
          .step = step,
          .sample_step = 1e-3,
          .cleat = DrumCleat{.height = 0.01, .length = 0.02, .bevel = 0.003}};
}

// The integration is of order 2, and over a cleat still: half the step changes a quarter.
TEST(DrumConvergence, AStepChangesFourTimesLessWhenHalved) {
  const Document ring = example_ring();
  double change[2] = {};
  for (int i = 0; i < 2; ++i) {
    const auto found =
        drum_convergence(*find_tire_kind("ring_tire"), ring, test_with(5e-4 / (1 + i)));
    ASSERT_TRUE(found) << found.failure().reason;
    ASSERT_EQ(found->size(), 6u);
    EXPECT_EQ(found->at(2).name, "Fz");
    EXPECT_EQ(found->at(2).unit, "N");
    EXPECT_GT(found->at(2).about_mean, 100.0);
    EXPECT_GT(found->at(2).by_segments, 0.0);
    change[i] = found->at(2).by_step;
  }
  EXPECT_GT(change[0], 2.8 * change[1]);
  EXPECT_LT(change[0], 5.7 * change[1]);
}

}  // namespace
}  // namespace latsch::experiment
