// SPDX-License-Identifier: Apache-2.0
// Tests the derivatives ∂force/∂motion against central differences of steps that are solved down to
// rounding.
#include "models/ring_tire/ring/motion_slopes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/motion_slopes_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

constexpr double kRollingSpeed = 15.0;

RingParameters plain() {
  RingParameters ring = passenger_ring();
  ring.nodes = 60;
  ring.tread.blocks = 8;
  ring.tread.crown_radius = 0.7;
  ring.tread.damping_time = 1e-4;
  return ring;
}

RingParameters remembering() {
  RingParameters ring = plain();
  ring.sidewall.radial.dynamic_stiffening = 0.2;
  ring.sidewall.tangential.dynamic_stiffening = 0.05;
  ring.sidewall.radial.friction_stiffening = 0.1;
  ring.sidewall.radial.friction_force = 500.0;
  ring.sidewall.lateral.friction_stiffening = 0.1;
  ring.sidewall.lateral.friction_force = 200.0;
  return ring;
}

RingParameters bent(RingParameters ring) {
  ring.belt.bending_across = 8.0;
  return ring;
}

/// Motion of a rolling wheel with slips, for a tire with a given free radius.
struct SlippingWheel {
  double slip = 0.0, camber = 0.0, steer = 0.0, yaw_rate = 0.0, surface = 0.0;

  WheelMotion at(double free_radius, double time) const {
    WheelMotion motion;
    const double speed = kRollingSpeed - surface;
    motion.center = {speed * time, 0.1 * time, free_radius - 0.02 - 0.2 * time};
    motion.velocity = {speed, 0.1, -0.2};
    motion.spin_rate = (1.0 + slip) * kRollingSpeed / 0.308;
    motion.spin = motion.spin_rate * time;
    motion.angular_velocity.z() = yaw_rate;
    motion.carrier = (Eigen::AngleAxisd(steer + yaw_rate * time, Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(camber, Vector3d::UnitX()))
                         .toRotationMatrix();
    return motion;
  }
};

/// Returns the largest difference between derivatives and central differences for one step after
/// several others, relative to the largest value in the column.
double deviation(const RingParameters& ring,
                 const road::Road& road,
                 const SlippingWheel& rolling,
                 int steps,
                 double step,
                 double largest_step = 2e-3) {
  constexpr double kBefore = 4e-4;  // s, length of the preceding steps
  RingTire tire(ring);
  EXPECT_TRUE(tire.settle(rolling.at(tire.free_radius(), 0.0), road, 0.0));
  for (int i = 1; i <= steps; ++i)
    EXPECT_TRUE(
        tire.advance(rolling.at(tire.free_radius(), i * kBefore), road, i * kBefore, kBefore));
  const double time = steps * kBefore + step;
  RingSettings settings = kUntilRounding;
  settings.largest_step = largest_step;
  return slopes_off_differences(
      ring, settings, tire.state(), rolling.at(tire.free_radius(), time), road, time, step);
}

constexpr double kTolerance = 1e-5;

TEST(MotionSlopes, RollingFreely) {
  EXPECT_LT(deviation(plain(), road::PlaneRoad(), {}, 30, 5e-4), kTolerance);
}

TEST(MotionSlopes, SlippingWithCamberAndSteer) {
  const SlippingWheel braking{.slip = -0.08, .camber = 0.06, .steer = 0.05, .yaw_rate = 0.3};
  EXPECT_LT(deviation(plain(), road::PlaneRoad(), braking, 30, 5e-4), kTolerance);
}

TEST(MotionSlopes, OnTheEdgeOfACleat) {
  const auto cleat = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  const SlippingWheel tilted{.slip = -0.02, .camber = 0.03, .steer = 0.02};
  for (const int steps : {22, 27, 33})
    EXPECT_LT(deviation(plain(), cleat, tilted, steps, 5e-4), kTolerance) << steps;
}

TEST(MotionSlopes, OnAKerb) {
  const auto kerb = road::kerb_road(
      {.shape = road::Kerb::Shape::triangle, .height = -0.025, .start = {0.05, -0.4}});
  for (const int steps : {20, 40})
    EXPECT_LT(deviation(plain(), kerb, {.slip = 0.01, .camber = 0.02}, steps, 2e-4), kTolerance)
        << steps;
}

TEST(MotionSlopes, OnADrum) {
  const road::DrumRoad drum({.diameter = 2.5, .surface = kRollingSpeed});
  EXPECT_LT(deviation(plain(), drum, {.camber = 0.02, .surface = kRollingSpeed}, 20, 5e-4),
            kTolerance);
}

TEST(MotionSlopes, OfMaxwellAndFrictionElements) {
  EXPECT_LT(deviation(remembering(), road::PlaneRoad(), {.slip = -0.01, .camber = 0.03}, 30, 5e-4),
            kTolerance);
}

TEST(MotionSlopes, OfBentSections) {
  const auto cleat = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  const SlippingWheel tilted{.slip = -0.02, .camber = 0.03};
  EXPECT_LT(deviation(bent(remembering()), cleat, tilted, 27, 5e-4), kTolerance);
  EXPECT_LT(deviation(bent(plain()), road::PlaneRoad(), tilted, 10, 5e-4), kTolerance);
}

// One of the damping times is that of rubber, the other is longer than any rubber's.
TEST(MotionSlopes, OfADampedBelt) {
  const auto cleat = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  const SlippingWheel tilted{.slip = -0.02, .camber = 0.03, .steer = 0.02, .yaw_rate = 2.0};
  for (const double time : {1e-4, 2e-3}) {
    RingParameters ring = plain();
    ring.belt.damping_time = time;
    ring.belt.extension_damping_time = 0.01 * time;
    for (const int steps : {22, 27, 33})
      EXPECT_LT(deviation(ring, cleat, tilted, steps, 2e-4), kTolerance) << steps << ", " << time;
    EXPECT_LT(deviation(bent(ring), cleat, tilted, 27, 9e-4, 3e-4), kTolerance) << time;
  }
}

// A thin tread is compressed by half of its height on the flat road, and by more on the cleat.
TEST(MotionSlopes, OfATreadThatBottomsOut) {
  const auto cleat = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  const SlippingWheel tilted{.slip = -0.02, .camber = 0.03, .steer = 0.02};
  RingParameters ring = plain();
  ring.tread.height = 0.006;
  ring.tread.bottoming = 0.35;
  EXPECT_LT(deviation(ring, road::PlaneRoad(), tilted, 30, 5e-4), kTolerance);
  for (const int steps : {22, 27, 33})
    EXPECT_LT(deviation(ring, cleat, tilted, steps, 2e-4), kTolerance) << steps;
  EXPECT_LT(deviation(bent(ring), cleat, tilted, 27, 2e-4), kTolerance);
}

TEST(MotionSlopes, OfCoupledPliesAndACone) {
  const auto cleat = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  RingParameters ring = plain();
  ring.belt.bending_in_plane = 10.0;
  ring.belt.bending_twist = 15.0;
  ring.belt.conicity = 0.01;
  for (const double time : {0.0, 2e-4}) {
    ring.belt.damping_time = time;
    EXPECT_LT(deviation(ring, cleat, {.slip = -0.02, .camber = 0.03, .steer = 0.02}, 27, 2e-4),
              kTolerance)
        << time;
  }
}

// The motions at the ends of the parts depend on the motion at the end of the step, and each part
// on the state after the part before.
TEST(MotionSlopes, OfAStepDividedInParts) {
  const auto cleat = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  const SlippingWheel tilted{.slip = -0.02, .camber = 0.03, .steer = 0.02, .yaw_rate = 2.0};
  EXPECT_LT(deviation(plain(), road::PlaneRoad(), tilted, 30, 9e-4, 3e-4), kTolerance);
  EXPECT_LT(deviation(remembering(), cleat, tilted, 27, 9e-4, 3e-4), kTolerance);
  EXPECT_LT(deviation(bent(remembering()), cleat, tilted, 27, 9e-4, 3e-4), kTolerance);
}

// A step for which Newton's method does not converge is halved.
TEST(MotionSlopes, OfAStepThatIsHalved) {
  const auto cleat = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  const SlippingWheel tilted{.slip = -0.02, .camber = 0.03, .steer = 0.02, .yaw_rate = 2.0};
  RingTire tire(plain());
  const auto at = [&](double time) { return tilted.at(tire.free_radius(), time); };
  ASSERT_TRUE(tire.settle(at(0.0), cleat, 0.0));
  for (int i = 1; i <= 27; ++i) ASSERT_TRUE(tire.advance(at(i * 4e-4), cleat, i * 4e-4, 4e-4));
  const double step = 1.6e-3, time = 27 * 4e-4 + step;
  RingSettings settings = kUntilRounding;
  settings.most_iterations = 8;
  RingTire tight(plain(), settings);
  ASSERT_TRUE(tight.trial(tire.state(), at(time), cleat, time, step));
  EXPECT_GT(tight.counts().steps, 2);
  EXPECT_LT(slopes_off_differences(plain(), settings, tire.state(), at(time), cleat, time, step),
            kTolerance);
}

// Forces and state of a trial must be identical to the last bit with and without derivatives.
TEST(MotionSlopes, LeaveTheTrialAsItIs) {
  const auto cleat = road::cleat_road(0.1, 0.015, 0.03, 0.005, 0.4);
  RingTire tire(remembering());
  const SlippingWheel rolling{.slip = -0.02};
  ASSERT_TRUE(tire.settle(rolling.at(tire.free_radius(), 0.0), cleat, 0.0));
  RingState state = tire.state();
  for (int i = 1; i <= 10; ++i) {
    const WheelMotion motion = rolling.at(tire.free_radius(), i * 5e-4);
    const auto with = tire.trial(state, motion, cleat, i * 5e-4, 5e-4, true);
    ASSERT_TRUE(with);
    EXPECT_TRUE(tire.state() == with->state);
    const auto without = tire.trial(state, motion, cleat, i * 5e-4, 5e-4);
    ASSERT_TRUE(without);
    EXPECT_EQ(with->hub.force, without->hub.force);
    EXPECT_EQ(with->hub.moment, without->hub.moment);
    EXPECT_TRUE(with->state == without->state);
    EXPECT_TRUE(with->slopes);
    EXPECT_FALSE(without->slopes);
    state = with->state;
  }
}

}  // namespace
}  // namespace latsch::ring_tire
