// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/model_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "correlation/comparison/comparison_effects.h"

namespace latsch::correlation {
namespace {

numerics::Density density(const std::vector<double>& values) {
  numerics::Density density;
  for (std::size_t k = 0; k < values.size(); ++k) {
    density.frequency.push_back(10.0 * static_cast<double>(k));
    density.value.push_back(values[k]);
  }
  return density;
}

// If a density is twice the reference its distance is 1; if it is equal, 0.
TEST(ModelComparison, DistanceIsRelativeAndOfTheBandAlone) {
  const auto S = density({9.0, 1.0, 2.0, 5.0, 9.0});
  const auto doubled = density({-9.0, 2.0, 4.0, 10.0, -9.0});
  EXPECT_DOUBLE_EQ(psd_distance(doubled, S, {10.0, 30.0}), 1.0);
  EXPECT_DOUBLE_EQ(psd_distance(S, S, {0.0, 40.0}), 0.0);
  // The distance is (4 - 2)/2 on the only line.
  EXPECT_DOUBLE_EQ(psd_distance(doubled, S, {15.0, 25.0}), 1.0);
}

// The distances are built as 5 - 3 first - 1 second + 0.5 if both factors are changed or neither.
// The computed effects must return these numbers; the interaction is half of the difference from
// the sum of both effects.
TEST(ModelComparison, EffectsOfATwoByTwoAreThoseItWasMadeOf) {
  const auto e = effects_of({{{5.0, 4.0}, {2.0, 1.5}}});
  EXPECT_DOUBLE_EQ(e.first, -2.75);
  EXPECT_DOUBLE_EQ(e.second, -0.75);
  EXPECT_DOUBLE_EQ(e.interaction, 0.25);
  EXPECT_EQ(e.first_is_larger, 1.0);
  const auto additive = effects_of({{{5.0, 1.0}, {4.0, 0.0}}});
  EXPECT_DOUBLE_EQ(additive.first, -1.0);
  EXPECT_DOUBLE_EQ(additive.second, -4.0);
  EXPECT_DOUBLE_EQ(additive.interaction, 0.0);
  EXPECT_EQ(additive.first_is_larger, 0.0);
}

}  // namespace
}  // namespace latsch::correlation
