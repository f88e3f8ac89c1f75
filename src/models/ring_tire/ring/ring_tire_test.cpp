// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/ring_tire.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "numerics/kernels/kernel_set.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

WheelMotion standing(double height) {
  WheelMotion motion;
  motion.center = {0.0, 0.0, height};
  return motion;
}

struct Resultant {
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
};

/// Returns the resultant force and moment of the road about the wheel center.
Resultant of_road(const RingTire& tire, const Vector3d& center) {
  Resultant sum;
  for (const BlockContact& block : tire.contacts()) {
    sum.force += block.force;
    sum.moment += (block.unloaded - center).cross(block.force) + block.moment;
  }
  return sum;
}

WheelMotion rolling(double height, double speed, double effective_radius) {
  WheelMotion motion = standing(height);
  motion.velocity.x() = speed;
  motion.spin_rate = speed / effective_radius;
  return motion;
}

WheelMotion later(WheelMotion motion, double h) {
  motion.center += h * motion.velocity;
  motion.spin += h * motion.spin_rate;
  return motion;
}

HubForces roll(RingTire& tire, WheelMotion& motion, const road::Road& road, int steps, double h) {
  HubForces forces;
  for (int i = 1; i <= steps; ++i) {
    motion = later(motion, h);
    const auto hub = tire.advance(motion, road, i * h, h);
    EXPECT_TRUE(hub) << hub.failure().reason;
    if (!hub) break;
    forces = *hub;
  }
  return forces;
}

// The forces on the hub must equal those of the road by Newton's third law, with camber as well.
TEST(RingTire, StandsOnItsPatchInBalance) {
  RingTire tire(passenger_ring());
  const road::PlaneRoad road;
  for (double camber : {0.0, 0.05}) {
    WheelMotion motion = standing(tire.free_radius() - 0.020);
    motion.carrier = Eigen::AngleAxisd(camber, Vector3d::UnitX()).toRotationMatrix();
    const auto hub = tire.settle(motion, road, 0.0);
    ASSERT_TRUE(hub) << hub.failure().reason;
    const Resultant ground = of_road(tire, motion.center);
    EXPECT_GT(ground.force.z(), 3000.0);
    EXPECT_LT((motion.carrier * hub->force - ground.force).norm(), 5e-4 * ground.force.z());
    EXPECT_LT((motion.carrier * hub->moment - ground.moment).norm(), 5e-4);  // N m
  }
}

// In steady rolling, momentum and angular momentum are constant, so the forces on hub and road are
// in balance. The torque at the hub is the longitudinal force times the loaded radius, plus rolling
// resistance.
TEST(RingTire, RollsInBalance) {
  RingTire tire(passenger_ring());
  const road::PlaneRoad road;
  WheelMotion motion = rolling(tire.free_radius() - 0.020, 60.0 / 3.6, 0.309);
  ASSERT_TRUE(tire.settle(motion, road, 0.0));
  roll(tire, motion, road, 400, 5e-4);
  Resultant hub, ground;
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    const HubForces now = roll(tire, motion, road, 1, 5e-4);
    const Resultant of = of_road(tire, motion.center);
    hub.force += now.force / kSteps;
    hub.moment += now.moment / kSteps;
    ground.force += of.force / kSteps;
    ground.moment += of.moment / kSteps;
  }
  EXPECT_LT((hub.force - ground.force).norm(), 2e-3 * hub.force.z());
  EXPECT_NEAR(hub.moment.y(), ground.moment.y(), 2.0);
}

/// Returns the hub forces while the tire rolls over a cleat in steps of h (s).
std::vector<Vector3d> over_a_cleat(double tolerance, double h) {
  const road::ProfileRoad road = road::cleat_road(0.3, 0.015, 0.03, 0.005);
  RingTire tire(passenger_ring(), {.tolerance = tolerance});
  WheelMotion motion = rolling(tire.free_radius() - 0.020, 40.0 / 3.6, 0.309);
  EXPECT_TRUE(tire.settle(motion, road, 0.0));
  std::vector<Vector3d> forces;
  for (int i = 0; i < std::lround(0.05 / h); ++i)
    forces.push_back(roll(tire, motion, road, 1, h).force);
  return forces;
}

// Steps end with a correction after which forces are not computed again, and short steps begin with
// an earlier tangent. Neither may change the result by more than the tolerance of the residual at a
// node.
TEST(RingTire, LeavesNoMoreThanItsTolerance) {
  constexpr double kTolerance = 0.1;  // N
  for (double h : {5e-4, 1e-4}) {
    const auto loose = over_a_cleat(kTolerance, h), tight = over_a_cleat(1e-6, h);
    double most = 0.0;
    for (std::size_t i = 0; i < loose.size(); ++i)
      most = std::max(most, (loose[i] - tight[i]).norm());
    EXPECT_LT(most, kTolerance) << h;
    EXPECT_GT(most, 0.0);
  }
}

// An earlier tangent is tried if this saves work, that is, in steps in which the wheel rotates
// little.
TEST(RingTire, HoldsItsTangentInShortSteps) {
  for (const auto& [h, most] : {std::pair{5e-4, 1.2}, {5e-5, 0.3}}) {
    RingTire tire(passenger_ring());
    const road::PlaneRoad road;
    WheelMotion motion = rolling(tire.free_radius() - 0.020, 40.0 / 3.6, 0.309);
    ASSERT_TRUE(tire.settle(motion, road, 0.0));
    const RingCounts before = tire.counts();
    roll(tire, motion, road, 200, h);
    const auto made = static_cast<double>(tire.counts().factorizations - before.factorizations);
    EXPECT_LT(made, most * static_cast<double>(tire.counts().steps - before.steps)) << h;
  }
}

// The ring is the same after a rotation by one node, so its forces must be equal.
TEST(RingTire, IsTheSameTurnedByANode) {
  const road::ProfileRoad road = road::cleat_road(0.1, 0.015, 0.03, 0.005);
  const RingParameters ring = passenger_ring();
  HubForces forces[2];
  for (int i : {0, 1}) {
    RingTire tire(ring);
    WheelMotion motion = rolling(tire.free_radius() - 0.015, 10.0, 0.31);
    motion.spin = 2.0 * std::numbers::pi / ring.nodes * i;
    ASSERT_TRUE(tire.settle(motion, road, 0.0));
    forces[i] = roll(tire, motion, road, 40, 5e-4);
  }
  EXPECT_LT((forces[0].force - forces[1].force).norm(), 1e-4 * forces[0].force.norm());
  EXPECT_LT((forces[0].moment - forces[1].moment).norm(), 1e-4 * forces[0].force.norm());
}

/// Energy that the tire has converted to heat so far, J: the work of the rim on the tire by the
/// trapezoidal rule, minus the increase of the tire's energy. The road stands still and does no
/// work.
class Heat {
 public:
  Heat(const RingTire& tire, const WheelMotion& motion, const HubForces& hub)
      : stored_(tire.energy()), power_(power(motion, hub)) {}

  void step(const RingTire& tire, const WheelMotion& motion, const HubForces& hub, double h) {
    const double now = power(motion, hub);
    work_ += 0.5 * h * (power_ + now);
    power_ = now;
    heat_ = work_ - (tire.energy() - stored_);
  }
  double value() const { return heat_; }
  double work() const { return work_; }

 private:
  static double power(const WheelMotion& motion, const HubForces& hub) {
    const Vector3d force = motion.carrier * hub.force, moment = motion.carrier * hub.moment;
    const Vector3d turning = motion.angular_velocity + motion.spin_rate * motion.carrier.col(1);
    return -force.dot(motion.velocity) - moment.dot(turning);
  }

  double stored_, power_, work_ = 0.0, heat_ = 0.0;
};

// The rim of a standing tire is moved sideways and forward and then held. Belt and tread vibrate on
// the ground. They must lose energy to dampers and friction, and never gain any.
TEST(RingTire, OnTheGroundItRingsAndLosesEnergy) {
  RingTire tire(passenger_ring(), {.tolerance = 1e-6});
  const road::PlaneRoad road;
  WheelMotion motion = standing(tire.free_radius() - 0.025);
  ASSERT_TRUE(tire.settle(motion, road, 0.0));
  constexpr double h = 2.5e-4;
  motion.center += Vector3d(0.004, 0.006, 0.004);
  ASSERT_TRUE(tire.advance(motion, road, h, h));
  const double first = tire.energy();
  double last = first;
  EXPECT_FALSE(tire.contacts().empty());
  for (int i = 2; i < 400; ++i) {
    ASSERT_TRUE(tire.advance(motion, road, i * h, h));
    EXPECT_LE(tire.energy(), last + 1e-6) << i;
    last = tire.energy();
  }
  EXPECT_LT(last, first - 1.0);
}

// A tire that rolls with side slip and is braked produces heat at all times. In steady rolling,
// when its energy is constant, the heat equals the work of the rim.
TEST(RingTire, RollingItTurnsWorkIntoHeat) {
  RingTire tire(passenger_ring(), {.tolerance = 1e-4});
  const road::PlaneRoad road;
  constexpr double h = 5e-4, kSpeed = 10.0;
  WheelMotion motion = rolling(tire.free_radius() - 0.02, kSpeed, 0.33);
  motion.velocity.y() = 0.6;
  const auto hub = tire.settle(motion, road, 0.0);
  ASSERT_TRUE(hub);
  roll(tire, motion, road, 400, h);
  Heat heat(tire, motion, *tire.advance(motion = later(motion, h), road, 401 * h, h));
  constexpr int kSteps = 200;
  double last = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    motion = later(motion, h);
    const auto now = tire.advance(motion, road, (401 + i) * h, h);
    ASSERT_TRUE(now);
    heat.step(tire, motion, *now, h);
    if (i % 20 != 0) continue;
    EXPECT_GT(heat.value(), last + 1.0) << i;
    last = heat.value();
  }
  EXPECT_GT(heat.work(), 100.0);
  EXPECT_NEAR(heat.value(), heat.work(), 0.02 * heat.work());
}

/// Returns the forces on a hub that moves up and down while the wheel rolls, every 2 ms.
std::vector<Vector3d> rolling_and_heaving(int parts) {
  constexpr double kEvery = 2e-3, kSpeed = 10.0, omega = 2.0 * std::numbers::pi * 25.0;
  constexpr int kRecords = 30;
  RingTire tire(passenger_ring(), {.tolerance = 1e-5});
  const road::PlaneRoad road;
  const double h = kEvery / parts, height = tire.free_radius() - 0.015;
  WheelMotion motion = rolling(height, kSpeed, tire.free_radius() - 0.006);
  EXPECT_TRUE(tire.settle(motion, road, 0.0));
  std::vector<Vector3d> forces;
  for (int i = 1; i <= kRecords * parts; ++i) {
    const double t = i * h;
    motion = later(motion, h);
    motion.center.z() = height - 0.0025 * (1.0 - std::cos(omega * t));
    motion.velocity.z() = -0.0025 * omega * std::sin(omega * t);
    const auto hub = tire.advance(motion, road, t, h);
    EXPECT_TRUE(hub) << hub.failure().reason;
    if (!hub) break;
    if (i % parts == 0) forces.push_back(hub->force);
  }
  return forces;
}

// While the tire rolls, blocks come and go within a step: two halvings reduce the change of Fz
// about sixteenfold at order 2 and fourfold at order 1. The rest of the error of Fx, from tips that
// slide and leave, is of an order between 1 and 2. Tips that were put down with the velocity at the
// end of the step had changed Fx by 6.4 N at the first halving.
TEST(RingTire, IsOfOrderTwoInRolling) {
  std::vector<std::vector<Vector3d>> runs;
  for (const int parts : {2, 4, 8, 16}) runs.push_back(rolling_and_heaving(parts));
  const auto change = [&](std::size_t from, int axis) {
    double sum = 0.0;
    for (std::size_t i = 0; i < runs[from].size(); ++i)
      sum += std::pow(runs[from + 1][i][axis] - runs[from][i][axis], 2);
    return std::sqrt(sum / static_cast<double>(runs[from].size()));
  };
  EXPECT_GT(change(0, 2), 7.0 * change(2, 2));
  EXPECT_GT(change(0, 0), 5.0 * change(2, 0));
  EXPECT_LT(change(0, 0), 5.0);
}

// In the air the hub carries the weight of the belt; on the road, the road does.
TEST(RingTire, TheHubCarriesTheBeltsWeight) {
  RingParameters ring = passenger_ring();
  ring.belt.gravity = 9.81;
  RingTire tire(ring);
  WheelMotion motion;
  motion.center.z() = 1.0;
  const auto in_the_air = tire.settle(motion, road::PlaneRoad(), 0.0);
  ASSERT_TRUE(in_the_air);
  EXPECT_LT((in_the_air->force - Vector3d(0.0, 0.0, -ring.belt.mass * 9.81)).norm(), 0.01);
  EXPECT_LT(in_the_air->moment.norm(), 0.01);
  motion.center.z() = tire.free_radius() - 0.02;
  const auto standing = tire.settle(motion, road::PlaneRoad(), 0.0);
  ASSERT_TRUE(standing);
  double of_road = 0.0;
  for (const BlockContact& block : tire.contacts()) of_road += block.force.z();
  EXPECT_NEAR(standing->force.z(), of_road - ring.belt.mass * 9.81, 0.01);
}

/// A road that gives no information about rectangles, only about single points.
class SilentRoad final : public road::Road {
 public:
  explicit SilentRoad(const road::Road& road) : road_(road) {}
  road::GroundPoint at(double x, double y, double time) const override {
    return road_.at(x, y, time);
  }

 private:
  const road::Road& road_;
};

// On level ground the same forces are computed by a shorter method.
TEST(RingTire, RollsOnLevelGroundAsOnAnyGround) {
  const road::PlaneRoad plane;
  const SilentRoad silent(plane);
  HubForces forces[2];
  for (int i : {0, 1}) {
    const road::Road& road = i == 0 ? static_cast<const road::Road&>(silent) : plane;
    RingTire tire(passenger_ring());
    WheelMotion motion = rolling(tire.free_radius() - 0.015, 10.0, 0.32);  // braking
    motion.velocity.y() = 0.5;  // the wheel also slides sideways
    ASSERT_TRUE(tire.settle(motion, road, 0.0));
    forces[i] = roll(tire, motion, road, 40, 5e-4);
  }
  EXPECT_LT((forces[0].force - forces[1].force).norm(), 1e-9 * forces[0].force.norm());
  EXPECT_LT((forces[0].moment - forces[1].moment).norm(), 1e-9 * forces[0].force.norm());
}

/// Returns Fx and Fz while the tire rolls over a cleat, with all effects that have a vectorized
/// kernel: damping with memory, friction, progressive springs, camber. The ring has 80 nodes, or
/// 83, which is no multiple of eight.
std::vector<double> over_a_cleat(KernelSet set,
                                 int nodes,
                                 double belt_damping_time,
                                 double bottoming) {
  const WithKernelSet with(set);
  RingParameters ring = passenger_ring();
  ring.nodes = nodes;
  ring.sidewall.progressivity = 0.5;
  ring.belt.damping_time = belt_damping_time;
  ring.belt.extension_damping_time = 0.01 * belt_damping_time;
  for (SidewallElement* e : {&ring.sidewall.radial, &ring.sidewall.tangential}) {
    e->dynamic_stiffening = 0.2;
    e->friction_stiffening = 0.1;
    e->friction_force = 300.0;
  }
  ring.tread.damping_time = 1e-4;
  ring.tread.bottoming = bottoming;
  RingTire tire(ring);
  const road::ProfileRoad road = road::cleat_road(0.12, 0.01, 0.03, 0.005);
  WheelMotion motion = rolling(tire.free_radius() - 0.02, 12.0, 0.3085);
  motion.carrier = Eigen::AngleAxisd(0.03, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_TRUE(tire.settle(motion, road, 0.0));
  std::vector<double> forces;
  for (int i = 1; i <= 40; ++i) {
    motion = later(motion, 5e-4);
    const auto hub = tire.advance(motion, road, i * 5e-4, 5e-4);
    EXPECT_TRUE(hub);
    if (!hub) break;
    forces.insert(forces.end(), {hub->force.x(), hub->force.z(), hub->moment.y()});
  }
  return forces;
}

// Results must be identical to the bit if both kernel sets have a fused multiply-add. The baseline
// set has none, so its results may differ within the tolerance of Newton's method, 0.1 N at a node.
TEST(RingTire, EveryKernelSetRollsTheSame) {
  for (const auto& [nodes, damping_time, bottoming] : {std::tuple{80, 0.0, 0.0},
                                                       std::tuple{83, 0.0, 0.0},
                                                       std::tuple{83, 2e-4, 0.0},
                                                       std::tuple{83, 0.0, 0.35}}) {
    const std::vector<double> best =
        over_a_cleat(kernel_sets().back(), nodes, damping_time, bottoming);
    ASSERT_EQ(best.size(), 120u);
    for (const KernelSet set : kernel_sets()) {
      const std::vector<double> forces = over_a_cleat(set, nodes, damping_time, bottoming);
      ASSERT_EQ(forces.size(), best.size());
      for (std::size_t i = 0; i < best.size(); ++i) {
        if (set == KernelSet::baseline)
          EXPECT_NEAR(forces[i], best[i], 1e-2) << i;
        else
          EXPECT_EQ(forces[i], best[i]) << name(set) << " " << i;
      }
    }
  }
}

// Regression test: forces computed by this program in November 2026, for an oblique cleat with side
// slip, N and N m.
TEST(RingTire, RegressionOverAnObliqueCleat) {
  RingParameters ring = passenger_ring();
  ring.sidewall.radial.dynamic_stiffening = 0.2;
  ring.sidewall.tangential.dynamic_stiffening = 0.05;
  ring.tread.damping_time = 1e-4;
  const road::ProfileRoad road = road::cleat_road(2.0, 0.015, 0.03, 0.005, 0.4);
  RingTire tire(ring);
  WheelMotion motion = rolling(tire.free_radius() - 0.022, 60.0 / 3.6, 0.3085);
  motion.velocity.y() = 0.05 * motion.velocity.x();
  ASSERT_TRUE(tire.settle(motion, road, 0.0));
  const struct {
    int steps;
    Vector3d force, moment;
  } expected[] = {
      {232, {-444.24, -1556.23, 5900.56}, {-449.46, -102.54, 51.41}},
      {13, {-1037.84, -1437.55, 5229.02}, {-534.86, 414.72, 62.90}},
      {15, {102.26, -1615.68, 3419.02}, {-469.49, 42.77, 141.93}},
      {40, {-890.82, -1659.53, 4473.31}, {-490.65, -17.91, 89.93}},
  };
  for (const auto& at : expected) {
    const HubForces hub = roll(tire, motion, road, at.steps, 5e-4);
    EXPECT_LT((hub.force - at.force).norm(), 1e-3 * at.force.norm())
        << at.steps << ": " << hub.force.transpose();
    EXPECT_LT((hub.moment - at.moment).norm(), 1e-4 * at.force.norm())
        << at.steps << ": " << hub.moment.transpose();
  }
}

// The information that a road gives about rectangles saves time but must not change forces. The
// test compares drum, plane and kerb with and without it, including groups of blocks that do not
// fill their lanes.
TEST(RingTire, WhatARoadSaysOfRectanglesChangesNoForce) {
  const road::DrumRoad outside({.diameter = 2.5, .surface = 12.0}),
      inside({.diameter = 3.0, .inner = true, .surface = 12.0});
  const road::PlaneRoad slope({.grade = 0.05, .bank = -0.03});
  const road::ProfileRoad kerb = road::kerb_road(
      {.shape = road::Kerb::Shape::triangle, .pitch = 0.4, .height = -0.01, .start = {0.05, -0.4}});
  for (const int blocks : {8, 10})
    for (const road::Road* road :
         std::initializer_list<const road::Road*>{&outside, &inside, &slope, &kerb}) {
      const bool drum = road == &outside || road == &inside;
      const SilentRoad silent(*road);
      RingParameters ring = passenger_ring();
      ring.tread.blocks = blocks;
      RingTire known(ring, {.tolerance = 1e-6}), asked(ring, {.tolerance = 1e-6});
      WheelMotion motion;
      motion.carrier = Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitX()).toRotationMatrix();
      motion.center.z() = known.free_radius() - 0.02;
      motion.spin_rate = 12.0 / 0.308;
      if (!drum) motion.velocity.x() = 12.0;
      ASSERT_TRUE(known.settle(motion, *road, 0.0));
      ASSERT_TRUE(asked.settle(motion, silent, 0.0));
      const double h = 5e-4;
      for (int i = 1; i <= 40; ++i) {
        motion.center += h * motion.velocity;
        motion.spin += h * motion.spin_rate;
        const auto by_bounds = known.advance(motion, *road, i * h, h);
        const auto by_points = asked.advance(motion, silent, i * h, h);
        ASSERT_TRUE(by_bounds && by_points);
        // With this information the mean height over a cell is exact; without it, a sum.
        EXPECT_LT((by_bounds->force - by_points->force).norm(), 1e-3 * by_points->force.norm())
            << "step " << i;
      }
    }
}

}  // namespace
}  // namespace latsch::ring_tire
