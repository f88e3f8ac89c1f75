// SPDX-License-Identifier: Apache-2.0
// Tests how much energy the belt's damping (30) dissipates in a moving tire.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_modes.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/plane_road.h"

namespace latsch::ring_tire {
namespace {

/// Returns a ring without losses other than the belt's damping; `time` is the damping time in s.
RingParameters losing_in_the_belt(double time) {
  RingParameters ring = passenger_ring();
  for (SidewallElement* e :
       {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral})
    e->damping = 0.0;
  ring.sidewall.torsion_damping = 0.0;
  ring.belt.bending_in_plane = 40.0;
  ring.belt.damping_time = time;
  return ring;
}

// A tire in the air is given velocities in the shape of a mode. After the time t it has lost the
// share 1 - exp(-2 D ω t) of this energy.
TEST(BeltLoss, AStruckTireLosesTheEnergyThatItsModesDampingSays) {
  const RingParameters ring = losing_in_the_belt(2e-5);
  for (const int n : {3, 6}) {
    const RingMode mode = find_mode(unloaded_modes(ring, n), n, false);
    RingTire tire(ring, {.dissipation = 0.0, .tolerance = 1e-6});
    WheelMotion motion;
    motion.center.z() = 1.0;
    ASSERT_TRUE(tire.settle(motion, road::PlaneRoad(), 0.0));
    const double rest = tire.energy();
    RingState state = tire.state();
    const NodeAngles angles(ring.nodes);
    for (int k = 0; k < ring.nodes; ++k) {
      const double phi = 2.0 * std::numbers::pi * k / ring.nodes, speed = 0.02;
      state.rate.col(k).head<3>() +=
          speed * (mode.shape[0] * std::cos(n * phi) * angles.radial(tire.rim(), k) -
                   mode.shape[1] * std::sin(n * phi) * angles.tangential(tire.rim(), k));
    }
    tire.restore(state);
    const double struck = tire.energy() - rest;
    const double periods = 8.0, h = 1.0 / mode.frequency / 400.0;
    for (int i = 1; i <= std::lround(periods * 400.0); ++i)
      ASSERT_TRUE(tire.advance(motion, road::PlaneRoad(), i * h, h));
    const double kept = std::exp(-4.0 * std::numbers::pi * mode.damping * periods);
    EXPECT_LT(kept, 0.9);
    // The tolerance is 1 % of the exponent. The mode shape is valid to first order only, and it is
    // given at the nodes instead of the belt's knots.
    EXPECT_NEAR(std::log((tire.energy() - rest) / struck), std::log(kept), -0.01 * std::log(kept));
  }
}

// The wheel spins in the air or rolls on the ground. In the air there must be no drag; on the
// ground the drag must grow with the damping time.
TEST(BeltLoss, RollsAgainstItsOwnBendingAlone) {
  const auto drag = [&](double time, bool loaded) {
    RingParameters ring = losing_in_the_belt(time);
    if (!loaded)  // lets initial vibrations decay
      for (SidewallElement* e :
           {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral})
        e->damping = 1000.0;
    RingTire tire(ring, {.tolerance = 1e-6});
    const road::PlaneRoad road;
    WheelMotion motion;
    motion.center.z() = tire.free_radius() - (loaded ? 0.02 : -0.1);
    motion.velocity.x() = 10.0;
    motion.spin_rate = 10.0 / 0.309;
    EXPECT_TRUE(tire.settle(motion, road, 0.0));
    const double h = 5e-4;
    double sum = 0.0;
    for (int i = 1; i <= 600; ++i) {
      motion.center.x() += h * motion.velocity.x();
      motion.spin += h * motion.spin_rate;
      const auto hub = tire.advance(motion, road, i * h, h);
      EXPECT_TRUE(hub);
      if (i > 400) sum -= hub->force.x() * motion.velocity.x() + hub->moment.y() * motion.spin_rate;
    }
    return sum / 200.0;  // W
  };
  // The drag that remains without damping is caused by the time steps.
  EXPECT_NEAR(drag(5e-4, false), drag(0.0, false), 1e-6);
  const double none = drag(0.0, true), some = drag(2e-4, true), more = drag(4e-4, true);
  EXPECT_GT(some - none, 5.0);
  EXPECT_NEAR((more - none) / (some - none), 2.0, 0.2);
}

}  // namespace
}  // namespace latsch::ring_tire
