// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/drum_convergence.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "experiment/language.h"

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
          .cleat = Cleat{.height = 0.01, .length = 0.02, .bevel = 0.003}};
}

// Tire and wheel are integrated with order 2, also over a cleat: half the step changes a quarter as
// much, along the road and upward, if steps are shorter than the time in which a block comes down.
TEST(DrumConvergence, AStepChangesFourTimesLessWhenHalved) {
  const Document ring = example_ring();
  std::vector<ChannelConvergence> runs[2];
  for (int i = 0; i < 2; ++i) {
    const auto found =
        drum_convergence(*language().find_kind("ring_tire"), ring, test_with(1.25e-4 / (1 + i)));
    ASSERT_TRUE(found) << found.failure().reason;
    ASSERT_EQ(found->size(), 6u);
    runs[i] = *found;
  }
  for (const auto& [index, name] : {std::pair{0, "Fx"}, {2, "Fz"}}) {
    const ChannelConvergence &coarse = runs[0][index], &fine = runs[1][index];
    EXPECT_EQ(coarse.name, name);
    EXPECT_EQ(coarse.unit, "N");
    EXPECT_GT(coarse.about_mean, 100.0);
    EXPECT_GT(coarse.by_segments, 0.0);
    EXPECT_GT(coarse.by_step, 2.8 * fine.by_step) << name;
    EXPECT_LT(coarse.by_step, 5.7 * fine.by_step) << name;
  }
}

}  // namespace
}  // namespace latsch::experiment
