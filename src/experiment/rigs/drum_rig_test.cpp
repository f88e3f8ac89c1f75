// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/drum_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::experiment {
namespace {

ring_tire::RingParameters passenger_tire() {
  const auto file =
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/ring_tires/passenger_205_55R16.toml";
  return ring_tire::read_ring_tire(Document::read(file).root());
}

ring_tire::RingTire tire_on_drum() { return ring_tire::RingTire(passenger_tire()); }

DrumTest quick_test() {
  return {.speed = 30.0 / 3.6,
          .load = 3500.0,
          .run_in = 0.12,
          .duration = 0.2,
          .lead = 0.05,
          .cleat = Cleat{.height = 0.01, .length = 0.02, .bevel = 0.003}};
}

TEST(DrumTest, AFreeWheelRollsUnderItsLoadAndFeelsTheCleatWhenItIsBelow) {
  ring_tire::RingTire tire = tire_on_drum();
  const auto channels = run(tire, quick_test());
  ASSERT_TRUE(channels) << channels.failure().reason;
  const auto& time = (*channels)["time"];
  const auto& Fz = (*channels)["Fz"];
  const auto& My = (*channels)["My"];
  ASSERT_EQ(time.size(), 400u);
  // Before the cleat the force is the load, apart from dynamic stiffening and the effect of speed,
  // and there is nearly no torque.
  double before = 0.0, torque = 0.0;
  for (std::size_t i = 0; i < 60; ++i) {
    before += Fz[i] / 60.0;
    torque += My[i] / 60.0;
  }
  EXPECT_NEAR(before, 3500.0, 0.08 * 3500.0);
  EXPECT_NEAR(torque, 0.0, 10.0);
  const auto most = std::max_element(Fz.begin(), Fz.end());
  EXPECT_GT(*most, before + 300.0);
  EXPECT_NEAR(time[static_cast<std::size_t>(most - Fz.begin())], 0.0, 0.04);
}

// The geometry of the tire is the same after a rotation by each of its 80 segments, so the passages
// over the cleat are the same as well.
TEST(DrumTest, ATurnByASegmentChangesNothing) {
  constexpr double kSegment = 2.0 * M_PI / 80.0;
  DrumTest test = quick_test();
  ring_tire::RingTire tire = tire_on_drum();
  const auto one = run(tire, test);
  test.passages = 2;
  test.wheel_step = kSegment;
  const auto same = run(tire, test);
  test.wheel_step = 0.5 * kSegment;
  const auto other = run(tire, test);
  ASSERT_TRUE(one && same && other);
  const auto distance = [&](const Channels& channels) {
    double most = 0.0;
    for (std::size_t i = 0; i < (*one)["Fx"].size(); ++i)
      most = std::max(most, std::abs(channels["Fx"][i] - (*one)["Fx"][i]));
    return most;
  };
  EXPECT_LT(distance(*same), 0.1);
  // At other angles of the wheel a single passage differs; averaging over passages removes this
  // dependence.
  EXPECT_GT(distance(*other), 1.0);
}

// A passage of a wheel that starts at another angle equals the one that the test simulates, so
// passages may be simulated in parallel.
TEST(DrumTest, PassagesAreThoseOfWheelsThatStartTurnedOn) {
  DrumTest test = quick_test();
  test.passages = 2;
  test.wheel_step = 0.02;
  ring_tire::RingTire tire = tire_on_drum();
  const auto both = run(tire, test);
  test.passages = 1;
  const auto first = run(tire, test);
  test.wheel_start = 0.02;
  const auto second = run(tire, test);
  ASSERT_TRUE(both && first && second);
  EXPECT_NE((*first)["Fx"], (*second)["Fx"]);
  for (const char* name : {"Fx", "Fz", "My"}) {
    for (std::size_t i = 0; i < (*both)[name].size(); ++i)
      ASSERT_EQ((*both)[name][i], ((*first)[name][i] + (*second)[name][i]) / 2.0) << name << i;
  }
}

// A light wheel oscillates at about 400 Hz against so stiff a belt. If the wheel moved first, by
// the force of the previous step, and the tire responded afterwards, the oscillation would grow
// without limit within 12 ms.
TEST(DrumTest, ASidewallTwentyTimesAsStiffRolls) {
  ring_tire::RingParameters stiff = passenger_tire();
  for (ring_tire::SidewallElement* of :
       {&stiff.sidewall.radial, &stiff.sidewall.tangential, &stiff.sidewall.lateral})
    of->stiffness *= 20.0, of->damping *= 20.0;
  ring_tire::RingTire tire(stiff);
  DrumTest test = quick_test();
  test.wheel_inertia = 0.3;
  const auto channels = run(tire, test);
  ASSERT_TRUE(channels) << channels.failure().reason;
  const auto& speed = (*channels)["wheel_speed"];
  const double rolling = speed.front();
  EXPECT_NEAR(rolling * tire.free_radius(), test.speed, 0.02 * test.speed);
  // The wheel returns to its speed after the cleat: no oscillation grows.
  for (std::size_t i = speed.size() - 100; i < speed.size(); ++i)
    EXPECT_NEAR(speed[i], rolling, 0.01 * rolling) << i;
}

TEST(DrumTest, IsReadWithItsUnits) {
  const auto document = Document::parse(
      "kind = \"drum_cleat\"\nspeed = \"36 km/h\"\nload = \"4 kN\"\ncamber = \"2 deg\"\n"
      "drum_diameter = \"2.5 m\"\n[cleat]\nheight = \"15 mm\"\nlength = \"30 mm\"\n",
      "test.toml");
  const DrumTest test = read_drum_test(document.root());
  EXPECT_DOUBLE_EQ(test.speed, 10.0);
  EXPECT_DOUBLE_EQ(*test.load, 4000.0);
  EXPECT_NEAR(test.camber, 2.0 * M_PI / 180.0, 1e-15);
  EXPECT_DOUBLE_EQ(test.cleat->height, 0.015);
}

}  // namespace
}  // namespace latsch::experiment
