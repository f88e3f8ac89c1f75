// SPDX-License-Identifier: Apache-2.0
// Tests the effects of imbalance and run-out on a ring: in the air against closed forms, on the
// road against the tire's own stiffness.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/motion_slopes_testing.h"
#include "models/ring_tire/ring/ring_modes.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/ring_tire/ring/standing_modes.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// Returns the hub forces over one revolution of the wheel, with `per_turn` steps, after `turns`
/// other revolutions.
std::vector<HubForces> over_a_turn(
    const RingParameters& ring, double height, double spin_rate, double turns, int per_turn) {
  RingTire tire(ring, {.tolerance = 1e-6});
  const road::PlaneRoad road;
  WheelMotion motion;
  motion.center.z() = height;
  motion.velocity.x() = height > 0.5 ? 0.0 : 0.309 * spin_rate;
  motion.spin_rate = spin_rate;
  EXPECT_TRUE(tire.settle(motion, road, 0.0));
  const double h = 2.0 * pi / spin_rate / per_turn;
  const int before = static_cast<int>(std::lround(turns * per_turn));
  std::vector<HubForces> forces;
  for (int i = 1; i <= before + per_turn; ++i) {
    motion.center.x() = i * h * motion.velocity.x();
    motion.spin = i * 2.0 * pi / per_turn;
    const auto hub = tire.advance(motion, road, i * h, h);
    EXPECT_TRUE(hub) << hub.failure().reason;
    if (!hub) break;
    if (i > before) forces.push_back(*hub);
  }
  return forces;
}

/// Returns the n-th harmonic of a force component over the spin angle: the complex amplitude c in
/// Re(c exp(-i n spin)).
std::complex<double> harmonic(const std::vector<HubForces>& forces, int axis, int n) {
  std::complex<double> sum = 0.0;
  const double count = static_cast<double>(forces.size());
  for (std::size_t i = 0; i < forces.size(); ++i)
    sum += forces[i].force[axis] * std::polar(1.0, 2.0 * pi * n * (i + 1.0) / count);
  return (n == 0 ? 1.0 : 2.0) / count * sum;
}

/// Returns a ring whose carcass is so stiff that the belt moves with the rim.
RingParameters on_a_stiff_carcass() {
  RingParameters ring = passenger_ring();
  for (SidewallElement* e :
       {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral}) {
    e->stiffness *= 300.0;
    e->damping *= 100.0;
  }
  return ring;
}

// The centrifugal force m r ω² acts along the radius of the mass. At spin 0 the mass is at its
// angle, counted from the lowest point toward the front; from there it moves down and to the rear.
// All other harmonics are zero. If gravity is included, the weight of the mass and its moment about
// the axle are added.
TEST(Uniformity, AnImbalanceInTheAirPullsAtTheHubByItsCentrifugalForce) {
  RingParameters ring = on_a_stiff_carcass();
  ring.uniformity.imbalance = 0.05;
  ring.uniformity.imbalance_angle = 0.7;
  const double rate = 30.0, force = 0.05 * ring.belt.radius * rate * rate;
  for (const double gravity : {0.0, 9.81}) {
    ring.belt.gravity = gravity;
    const auto forces = over_a_turn(ring, 1.0, rate, 3.0, 400);
    // direction of the force: x is sin(φ - spin), z is -cos(φ - spin)
    const std::complex<double> x = harmonic(forces, 0, 1), z = harmonic(forces, 2, 1);
    const std::complex<double> i(0.0, 1.0), turn = std::polar(1.0, 0.7);
    EXPECT_LT(std::abs(x - force * -i * turn), 1e-3 * force) << gravity;
    EXPECT_LT(std::abs(z - -force * turn), 1e-3 * force) << gravity;
    for (int axis = 0; axis < 3; ++axis)
      for (int n = 2; n < 6; ++n) EXPECT_LT(std::abs(harmonic(forces, axis, n)), 1e-5 * force);
    EXPECT_NEAR(harmonic(forces, 2, 0).real(), -gravity * (ring.belt.mass + 0.05), 1e-3 * force);
    RingTire still(ring);
    WheelMotion motion;
    motion.center.z() = 1.0;
    const auto hub = still.settle(motion, road::PlaneRoad(), 0.0);
    ASSERT_TRUE(hub);
    EXPECT_NEAR(hub->moment.y(), 0.05 * gravity * ring.belt.radius * std::sin(0.7), 1e-3);
  }
}

// A small mass m changes the frequency of a mode of unit modal mass by the relative amount -m/2
// times the square of the mode's shape at the mass.
TEST(Uniformity, AnImbalanceLowersTheModesThatMoveIt) {
  RingParameters ring = passenger_ring();
  const auto lateral = [&] {
    RingTire tire(ring);
    WheelMotion motion;
    motion.center.z() = 1.0;
    EXPECT_TRUE(tire.settle(motion, road::PlaneRoad(), 0.0));
    const auto modes = standing_modes(tire, 12);
    EXPECT_TRUE(modes);
    for (const StandingMode& mode : *modes)
      if (mode.lateral && mode.n == 0) return mode.frequency;
    return 0.0;
  };
  const double without = lateral();
  ring.uniformity.imbalance = 1e-3;
  EXPECT_NEAR(
      lateral() / without - 1.0, -0.5 * 1e-3 / ring.belt.mass, 0.01 * 1e-3 / ring.belt.mass);
}

// In slow rolling, a tread that is thicker by a compresses the tire by a more. The radial force
// variation is the run-out times the stiffness of the rolling tire. It is reduced, because a patch
// of half length l averages over a part of the wave: by the factor sin(n l/R)/(n l/R), that is by 2
// % at n = 1 and by 8 % at n = 2. The maximum occurs when the thickest point is at the bottom.
TEST(Uniformity, RadialRunOutOnTheRoadIsFeltByTheStiffness) {
  RingParameters ring = passenger_ring();
  ring.nodes = 60;
  ring.tread.blocks = 8;
  const double height = RingTire(ring).free_radius() - 0.015, a = 2e-4, rate = 4.0;
  const auto load = [&](double at) {
    return harmonic(over_a_turn(ring, at, rate, 1.0, 900), 2, 0).real();
  };
  const double stiffness = (load(height - a) - load(height + a)) / (2.0 * a);
  EXPECT_GT(stiffness, 1e5);
  for (const int n : {1, 2}) {
    ring.uniformity.radial_runout.assign(static_cast<std::size_t>(n), {});
    ring.uniformity.radial_runout.back() = {.amplitude = a, .angle = 1.0};
    const auto forces = over_a_turn(ring, height, rate, 1.0, 900);
    const double ratio = std::abs(harmonic(forces, 2, n)) / (stiffness * a);
    EXPECT_GT(ratio, n == 1 ? 0.96 : 0.88) << n;
    EXPECT_LT(ratio, 1.005) << n;
    EXPECT_NEAR(std::arg(harmonic(forces, 2, n) * std::polar(1.0, -1.0 * n)), 0.0, 0.05) << n;
    EXPECT_LT(std::abs(harmonic(forces, 2, 3 - n)), 0.02 * stiffness * a) << n;
    EXPECT_LT(std::abs(harmonic(forces, 1, n)), 1e-3) << n;
  }
}

// A belt with lateral run-out has no stress. In rolling, each of its points lands at its lateral
// position and stays there, so the lateral force is nearly zero. But in each revolution the load
// acts first on the left and then on the right of the wheel's plane. This causes a moment about the
// forward axis: Fz times the run-out, plus the lateral force times the height of the axle.
TEST(Uniformity, LateralRunOutStandsFreeAndCarriesTheLoadFromSideToSide) {
  RingParameters ring = passenger_ring();
  ring.nodes = 60;
  ring.tread.blocks = 8;
  ring.uniformity.lateral_runout = {{.amplitude = 1e-3, .angle = 0.4}};
  RingTire tire(ring);
  WheelMotion motion;
  motion.center.z() = 1.0;
  const auto hub = tire.settle(motion, road::PlaneRoad(), 0.0);
  ASSERT_TRUE(hub);
  EXPECT_LT(hub->force.norm() + hub->moment.norm(), 1e-6);
  const NodeValues knots = at_knots(tire.positions());
  for (int k = 0; k < ring.nodes; ++k)
    EXPECT_NEAR(knots(1, k), 1e-3 * std::cos(2.0 * pi * k / ring.nodes - 0.4), 1e-9) << k;
  EXPECT_LT(tire.energy(), 1e-9);
  const double height = tire.free_radius() - 0.015;
  const auto whole = over_a_turn(ring, height, 10.0, 2.0, 600);
  ring.uniformity.lateral_runout[0].amplitude = 0.5e-3;
  const auto half = over_a_turn(ring, height, 10.0, 2.0, 600);
  // Returns the hub moments in place of the forces, to find the harmonics of the moment about the
  // forward axis.
  const auto moment = [](std::vector<HubForces> forces) {
    for (HubForces& hub : forces) hub.force = hub.moment;
    return harmonic(forces, 0, 1);
  };
  const std::complex<double> side = harmonic(whole, 1, 1);
  const std::complex<double> expected =
      std::polar(1e-3 * harmonic(whole, 2, 0).real(), 0.4) + height * side;
  EXPECT_LT(std::abs(side), 1.0);
  // The tolerance allows for the averaging of 2 % of the wave in the patch, and for the compliance
  // of the carcass.
  EXPECT_LT(std::abs(moment(whole) - expected), 0.05 * std::abs(expected));
  EXPECT_LT(std::abs(moment(half) - 0.5 * moment(whole)), 0.005 * std::abs(expected));
}

// Modes of the unloaded ring do not include imbalance and run-out, so they must be those of a
// uniform ring.
TEST(Uniformity, UnloadedModesAreThoseOfTheEvenRing) {
  const RingParameters even = passenger_ring();
  RingParameters uneven = even;
  uneven.uniformity = {.imbalance = 0.1,
                       .imbalance_angle = 0.0,
                       .radial_runout = {{1e-3, 0.0}},
                       .lateral_runout = {{1e-3, 0.0}}};
  const auto a = unloaded_modes(even, 3), b = unloaded_modes(uneven, 3);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].frequency, b[i].frequency);
}

// Derivatives of a step over a cleat, with and without bent cross-sections, must include imbalance
// and run-out. Steps and statics are solved with the usual tolerances.
TEST(Uniformity, SlopesOfATrialKnowAllOfIt) {
  RingParameters ring = passenger_ring();
  ring.nodes = 60;
  ring.tread.blocks = 8;
  ring.belt.gravity = 9.81;
  ring.belt.damping_time = 1e-4;
  ring.uniformity = {.imbalance = 0.05,
                     .imbalance_angle = 0.2,
                     .radial_runout = {{5e-4, 0.3}, {2e-4, 1.0}},
                     .lateral_runout = {{5e-4, 0.1}}};
  const auto cleat = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  for (const double across : {0.0, 8.0}) {
    ring.belt.bending_across = across;
    RingTire tire(ring);
    const auto at = [&](double time) {
      WheelMotion motion;
      motion.center = {15.0 * time, 0.1 * time, tire.free_radius() - 0.02 - 0.2 * time};
      motion.velocity = {15.0, 0.1, -0.2};
      motion.spin_rate = 48.0;
      motion.spin = motion.spin_rate * time;
      motion.carrier = Eigen::AngleAxisd(0.03, Vector3d::UnitX()).toRotationMatrix();
      return motion;
    };
    ASSERT_TRUE(tire.settle(at(0.0), cleat, 0.0));
    for (int i = 1; i <= 27; ++i) ASSERT_TRUE(tire.advance(at(i * 4e-4), cleat, i * 4e-4, 4e-4));
    const double time = 27 * 4e-4 + 2e-4;
    EXPECT_LT(
        slopes_off_differences(ring, kUntilRounding, tire.state(), at(time), cleat, time, 2e-4),
        1e-5)
        << across;
  }
}

}  // namespace
}  // namespace latsch::ring_tire
