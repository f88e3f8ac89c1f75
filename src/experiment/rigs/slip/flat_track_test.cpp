// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/flat_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::experiment {
namespace {

ring_tire::RingTire tire_on_track() {
  const auto file =
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/ring_tires/passenger_205_55R16.toml";
  auto ring = ring_tire::read_ring_tire(Document::read(file).root());
  ring.tread.blocks = 6;
  return ring_tire::RingTire(ring);
}

// The wheel slides to its left (α > 0): the road pushes it to the right, with a trail that turns it
// into its velocity; the greatest force is friction times load.
TEST(SlipSweep, SideForceGrowsWithTheAngleAndEndsAtFriction) {
  ring_tire::RingTire tire = tire_on_track();
  const auto channels = run(tire, SlipSweep{.alpha_to = 0.25, .duration = 0.6});
  ASSERT_TRUE(channels) << channels.failure().reason;
  const auto& alpha = (*channels)["alpha"];
  const auto& Fy = (*channels)["Fy"];
  const auto& Fz = (*channels)["Fz"];
  const auto at = [&](double angle) {
    std::size_t i = 0;
    while (alpha[i] < angle) ++i;
    return i;
  };
  EXPECT_LT(Fy[at(0.06)], -500.0);  // lags the sweep by the relaxation length
  EXPECT_LT(Fy[at(0.12)], Fy[at(0.06)]);
  const std::size_t last = alpha.size() - 1;
  EXPECT_GT(-Fy[last] / Fz[last], 0.8);
  EXPECT_LT(-Fy[last] / Fz[last], 1.4);
  EXPECT_GT((*channels)["Mz"][at(0.02)], 0.0);
}

// The free wheel of a tire with long relaxation swings beyond the run-in; slips count from the
// speed at which it comes to rest, so a steered wheel does not brake.
TEST(SlipSweep, TheWheelRollsFreelyBeforeTheSweep) {
  const SpecimenKind& kind = *language().find_kind("magic_formula");
  const auto specimen = kind.build(kind.read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                             "studies/tire_model_comparison/magic_formula.tir"));
  const auto tire = specimen->find<Rolls>()->tire();
  const SlipSweep sweep{.speed = 60.0 / 3.6, .alpha_from = -2e-3, .alpha_to = 2e-3};
  const auto channels = run(*tire, sweep);
  ASSERT_TRUE(channels) << channels.failure().reason;
  for (const double Fx : (*channels)["Fx"]) EXPECT_NEAR(Fx, 0.0, 1.0);
  EXPECT_NEAR((*channels)["time"].front(), 1.5 * sweep.run_in + sweep.step, 1e-9);
}

TEST(SlipSweep, BrakingForceEndsAtFriction) {
  ring_tire::RingTire tire = tire_on_track();
  const auto channels = run(tire, SlipSweep{.kappa_to = -0.4, .duration = 0.5});
  ASSERT_TRUE(channels) << channels.failure().reason;
  const auto& Fx = (*channels)["Fx"];
  const auto& Fz = (*channels)["Fz"];
  EXPECT_NEAR(Fx.front(), 0.0, 150.0);
  EXPECT_LT(Fx.back() / Fz.back(), -0.7);
  EXPECT_GT(Fx.back() / Fz.back(), -1.4);
}

// Only a few blocks support the axle, and they are barely in contact.
TEST(SlipSweep, TheAxleFollowsALoadOfOneNewton) {
  ring_tire::RingTire tire = tire_on_track();
  const SlipSweep sweep{.load = 1.0, .alpha_to = 0.02, .duration = 0.5};
  const auto channels = run(tire, sweep);
  ASSERT_TRUE(channels) << channels.failure().reason;
  const auto& Fz = (*channels)["Fz"];
  for (std::size_t i = Fz.size() / 2; i < Fz.size(); ++i) EXPECT_NEAR(Fz[i], sweep.load, 0.1) << i;
}

}  // namespace
}  // namespace latsch::experiment
