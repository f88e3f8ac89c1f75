// SPDX-License-Identifier: Apache-2.0
// Tests the balance of the whole tire: the hub receives the forces and moments of the road minus
// the rate of change of the belt's momentum. Tests moments about all axes, and the energy.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/motion_slopes_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/ring_tire/step/newmark.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

constexpr double kCleatSpeed = 15.0;

struct Wrench {
  // Force; moment about the wheel center.
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
};

/// Returns force and moment of the road on the tire, as the sum over all blocks.
Wrench road_wrench(const RingTire& tire, const Vector3d& center) {
  Wrench sum;
  for (const BlockContact& block : tire.contacts()) {
    sum.force += block.force;
    sum.moment += (block.unloaded - center).cross(block.force) + block.moment;
  }
  return sum;
}

/// Returns the rates of change of momentum and angular momentum, computed from the accelerations,
/// minus the belt's weight.
Wrench inertia_wrench(const RingParameters& ring, const RingState& state) {
  NodeValues M_a;
  at_knots_and_back(Eigen::Vector4d::Ones(), state.acceleration, M_a);
  M_a *= ring.belt.mass / ring.nodes;
  Wrench sum;
  for (Eigen::Index k = 0; k < M_a.cols(); ++k) {
    const Vector3d f =
        M_a.col(k).head<3>() + Vector3d(0.0, 0.0, ring.belt.mass / ring.nodes * ring.belt.gravity);
    sum.force += f;
    sum.moment += (state.place.col(k).head<3>() - state.motion.center).cross(f);
  }
  return sum;
}

/// Returns force and moment of the imbalance at node `at`: its part of the nodes' inertia forces M
/// a and of their weight, as a sum over the nodes.
Wrench of_imbalance(const RingParameters& ring, const RingState& state) {
  const auto N = static_cast<Eigen::Index>(ring.nodes);
  const auto at_knot = [N](const NodeValues& x) -> Vector3d {
    return (x.col(N - 1) + 4.0 * x.col(0) + x.col(1)).head<3>() / 6.0;
  };
  Wrench sum;
  sum.force = ring.uniformity.imbalance *
              (at_knot(state.acceleration) + Vector3d(0.0, 0.0, ring.belt.gravity));
  sum.moment = (at_knot(state.place) - state.motion.center).cross(sum.force);
  return sum;
}

struct Case {
  std::string name;
  double camber, steer, slip;
  double bending_across = 0.0;
  bool uneven = false;  // true: conical belt with coupled plies, damping, imbalance and run-out
  double bottoming = 0.0;
};

class RingMomentum : public testing::TestWithParam<Case> {
 protected:
  RingParameters ring() const {
    RingParameters ring = passenger_ring();
    ring.nodes = 60;
    ring.tread.blocks = 8;
    ring.tread.crown_radius = 0.7;
    ring.tread.damping_time = 1e-4;
    ring.tread.bottoming = GetParam().bottoming;
    ring.belt.gravity = 9.81;
    ring.belt.bending_across = GetParam().bending_across;
    ring.sidewall.torsion_by_lateral = 3.0;
    ring.sidewall.radial.dynamic_stiffening = 0.2;
    ring.sidewall.lateral.friction_stiffening = 0.1;
    ring.sidewall.lateral.friction_force = 200.0;
    if (!GetParam().uneven) return ring;
    ring.belt.bending_in_plane = 10.0;
    ring.belt.bending_twist = 15.0;
    ring.belt.conicity = 0.01;
    ring.belt.damping_time = 2e-4;
    ring.belt.extension_damping_time = 1e-6;
    ring.uniformity = {.imbalance = 0.1,
                       .imbalance_angle = 0.0,
                       .radial_runout = {{5e-4, 0.1}},
                       .lateral_runout = {{1e-3, 0.2}}};
    return ring;
  }
  WheelMotion at(double time) const {
    WheelMotion motion;
    motion.center = {kCleatSpeed * time, 0.0, 0.294};
    motion.velocity.x() = kCleatSpeed;
    motion.carrier = (Eigen::AngleAxisd(GetParam().steer, Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(GetParam().camber, Vector3d::UnitX()))
                         .toRotationMatrix();
    motion.spin_rate = (1.0 + GetParam().slip) * kCleatSpeed / 0.306;
    motion.spin = motion.spin_rate * time;
    return motion;
  }
};

TEST_P(RingMomentum, StandingHubAndRoadAgreeAboutAllAxes) {
  const RingParameters numbers = ring();
  RingTire tire(numbers, {.static_tolerance = 1e-6});
  const road::ProfileRoad road = road::cleat_road(0.05, 0.015, 0.03, 0.005);
  const WheelMotion motion = at(0.0);
  const auto hub = tire.settle(motion, road, 0.0);
  ASSERT_TRUE(hub) << hub.failure().reason;
  Wrench ground = road_wrench(tire, motion.center), weight;
  for (int k = 0; k < numbers.nodes; ++k) {
    const Vector3d f(0.0, 0.0, -numbers.belt.mass / numbers.nodes * numbers.belt.gravity);
    weight.force += f;
    weight.moment += (tire.positions().col(k).head<3>() - motion.center).cross(f);
  }
  const Vector3d on_belt(0.0, 0.0, -numbers.uniformity.imbalance * numbers.belt.gravity);
  const Vector3d arm = (tire.positions().col(numbers.nodes - 1) + 4.0 * tire.positions().col(0) +
                        tire.positions().col(1))
                               .head<3>() /
                           6.0 -
                       motion.center;
  weight.force += on_belt;
  weight.moment += arm.cross(on_belt);
  ASSERT_GT(ground.force.z(), 2000.0);
  EXPECT_LT((motion.carrier * hub->force - ground.force - weight.force).norm(), 1e-5);
  EXPECT_LT((motion.carrier * hub->moment - ground.moment - weight.moment).norm(), 1e-5);
}

TEST_P(RingMomentum, RollingHubAndRoadAgreeAboutAllAxes) {
  const RingParameters numbers = ring();
  RingSettings exact = kUntilRounding;
  exact.dissipation = 0.0;
  RingTire tire(numbers, exact);
  const road::ProfileRoad road = road::cleat_road(0.25, 0.015, 0.03, 0.005);
  ASSERT_TRUE(tire.settle(at(0.0), road, 0.0));
  constexpr double kStep = 5e-4;
  double most = 0.0;
  for (int i = 1; i <= 50; ++i) {
    const WheelMotion motion = at(i * kStep);
    const auto hub = tire.advance(motion, road, i * kStep, kStep);
    ASSERT_TRUE(hub) << hub.failure().reason;
    const Wrench ground = road_wrench(tire, motion.center),
                 mass = of_imbalance(numbers, tire.state());
    Wrench belt = inertia_wrench(numbers, tire.state());
    belt.force += mass.force;
    belt.moment += mass.moment;
    ASSERT_GT(ground.force.z(), 1000.0);
    EXPECT_LT((motion.carrier * hub->force + belt.force - ground.force).norm(),
              1e-9 * ground.force.norm())
        << i;
    EXPECT_LT((motion.carrier * hub->moment + belt.moment - ground.moment).norm(),
              1e-9 * ground.force.norm())
        << i;  // tolerance for arms of about a meter
    most = std::max(most, hub->moment.norm());
  }
  EXPECT_GT(most, 10.0);
}

INSTANTIATE_TEST_SUITE_P(Wheels,
                         RingMomentum,
                         testing::Values(Case{"upright", 0.0, 0.0, 0.0},
                                         Case{"cambered", 0.08, 0.0, 0.0},
                                         Case{"cornering", -0.05, 0.06, 0.02},
                                         Case{"braked", 0.03, -0.02, -0.1},
                                         Case{"bent", 0.05, 0.04, 0.02, 8.0},
                                         Case{"bottoming", 0.05, 0.04, 0.02, 8.0, false, 0.35},
                                         Case{"uneven", 0.05, 0.04, 0.02, 0.0, true},
                                         Case{"uneven_bent", -0.02, 0.04, 0.0, 8.0, true}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace latsch::ring_tire
