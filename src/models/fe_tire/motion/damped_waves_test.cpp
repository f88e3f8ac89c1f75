// SPDX-License-Identifier: Apache-2.0
// Damped modes of a tire that spins: at rest those of the standing mesh, and on tire B with few
// columns what spin does to them.
#include <gtest/gtest.h>

#include <cmath>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/motion/damped_tire.h"

namespace latsch::fe_tire {
namespace {

TireDescription damped_wave_tire() {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.cord_model = CordModel::rebar;
  tire.section.meridional = 13;
  tire.section.sectors = 40;
  tire.section.sector_zones.clear();
  for (Rubber& rubber : tire.rubbers) rubber.prony = *constant_loss_factor(0.15, 1.0, 1000.0);
  return tire;
}

TEST(DampedWaves, AtRestAreTheDampedModesOfTheTire) {
  constexpr int kCount = 9;
  const TireDescription tire = damped_wave_tire();
  const LossMaterials losses = build_losses(tire);
  FeTire fe(tire);
  const Inflated inflated = *fe.inflate(2.6e5);
  DampedTire damped(fe, losses);
  const auto standing = damped.modes(inflated, kCount);
  const auto waves = damped.modes(inflated, Rim{}, kCount);
  ASSERT_TRUE(standing) << standing.failure().reason;
  ASSERT_TRUE(waves) << waves.failure().reason;
  ASSERT_EQ(waves->size(), static_cast<std::size_t>(kCount));
  for (int k = 0; k < kCount; ++k) {
    EXPECT_NEAR((*waves)[k].mode.frequency / (*standing)[k].mode.frequency, 1.0, 1e-4) << k;
    EXPECT_NEAR((*waves)[k].damping / (*standing)[k].damping, 1.0, 2e-3) << k;
  }
}

// The decay of a wave is the same on the tire and in axes that stand; of a pair the wave against
// the spin has the lower frequency and so, with the same loss, more damping.
TEST(DampedWaves, OfAPairDifferInDamping) {
  const TireDescription tire = damped_wave_tire();
  const LossMaterials losses = build_losses(tire);
  FeTire fe(tire);
  SpinningTire spinning(fe);
  const auto state = spinning.inflate(*fe.inflate(2.6e5), 50.0);
  ASSERT_TRUE(state) << state.failure().reason;
  const auto elastic = spinning.modes(*state, {}, 12);
  const auto waves = DampedTire(fe, losses).modes(*state, Rim{}, 12);
  ASSERT_TRUE(waves) << waves.failure().reason;
  int pairs = 0;
  for (const DecayingWave& with : *waves) {
    EXPECT_GT(with.damping, 0.0) << with.mode.label();
    if (with.mode.sense != Sense::with) continue;
    for (const DecayingWave& against : *waves) {
      if (against.mode.sense != Sense::against || against.mode.n != with.mode.n ||
          against.mode.type != with.mode.type || against.mode.order != with.mode.order)
        continue;
      ++pairs;
      EXPECT_GT(with.mode.frequency, against.mode.frequency) << with.mode.label();
      EXPECT_LT(with.damping, against.damping) << with.mode.label();
    }
  }
  EXPECT_GE(pairs, 2);
}

}  // namespace
}  // namespace latsch::fe_tire
