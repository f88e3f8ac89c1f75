// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/belt.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/random.h"
#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/belt/belt_testing.h"
#include "models/ring_tire/description/ring_parameters_testing.h"

namespace latsch::ring_tire {
namespace {

constexpr int kBeltNodes = 16;

RimFrame some_rim() {
  WheelMotion motion;
  motion.center = {0.3, -0.1, 0.4};
  motion.carrier = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  motion.spin = 0.7;
  return RimFrame::of(motion);
}

/// Returns nodes whose curve has its knots at `radius`.
NodeValues nodes_at_rest(const RimFrame& rim, double radius) {
  const NodeAngles angles(kBeltNodes);
  NodeValues q(4, kBeltNodes);
  const double outside = radius * node_radius_over_knot_radius(kBeltNodes);
  for (int k = 0; k < kBeltNodes; ++k)
    q.col(k) << rim.center + outside * angles.radial(rim, k), 0.0;
  return q;
}

/// Returns nodes displaced by centimeters and tenths of a radian.
NodeValues deformed(const RimFrame& rim, double radius) {
  NodeValues q = nodes_at_rest(rim, radius);
  RandomStream random(11, 1);
  for (int k = 0; k < kBeltNodes; ++k) {
    for (int i = 0; i < 3; ++i) q(i, k) += 0.02 * (random.uniform() - 0.5);
    q(3, k) += 0.1 * (random.uniform() - 0.5);
  }
  return q;
}

TEST(BeltForces, AreTheGradientOfTheEnergyAndTheStiffnessItsHessian) {
  const RingParameters ring = passenger_ring();
  const BeltForces belt(ring.belt, kBeltNodes);
  const RimFrame rim = some_rim();
  const NodeValues q = deformed(rim, ring.belt.radius);
  const NodeValues force = force_of(belt, q, rim);
  const CyclicBand K = stiffness_of(belt, q, rim);
  const double h = 1e-6;
  for (int k : {0, 5, kBeltNodes - 1})
    for (int i = 0; i < 4; ++i) {
      NodeValues plus = q, minus = q, direction = NodeValues::Zero(4, kBeltNodes);
      plus(i, k) += h;
      minus(i, k) -= h;
      direction(i, k) = 1.0;
      const double slope = (belt.energy(plus, rim) - belt.energy(minus, rim)) / (2.0 * h);
      // The tolerance is the rounding of an energy of some kJ over 2h.
      EXPECT_NEAR(force(i, k), -slope, 1e-9 * force.norm() + 1e-5);
      const NodeValues f1 = force_of(belt, plus, rim), f0 = force_of(belt, minus, rim);
      const NodeValues column = K.multiply(direction);
      EXPECT_LT((column + (f1 - f0) / (2.0 * h)).norm(), 1e-7 * column.norm() + 1e-3);
    }
}

TEST(BeltForces, OfCoupledPliesAndOfAConeAreTheGradientAndItsSlopeTheHessian) {
  RingParameters ring = passenger_ring();
  ring.belt.extension = 2e4;  // reduces the rounding error of the differences
  ring.belt.bending_in_plane = 10.0;
  ring.belt.bending_twist = 20.0;
  ring.belt.conicity = 0.05;
  const BeltForces belt(ring.belt, kBeltNodes);
  RingParameters without = ring;
  without.belt.bending_twist = without.belt.conicity = 0.0;
  const RimFrame rim = some_rim();
  const NodeValues q = deformed(rim, ring.belt.radius);
  const NodeValues force = force_of(belt, q, rim);
  EXPECT_GT((force - force_of(BeltForces(without.belt, kBeltNodes), q, rim)).norm(),
            1e-2 * force.norm());
  const CyclicBand K = stiffness_of(belt, q, rim);
  const double h = 1e-6;
  for (int j = 0; j < 4 * kBeltNodes; ++j) {
    NodeValues plus = q, minus = q, direction = NodeValues::Zero(4, kBeltNodes);
    plus.data()[j] += h;
    minus.data()[j] -= h;
    direction.data()[j] = 1.0;
    const double slope = (belt.energy(plus, rim) - belt.energy(minus, rim)) / (2.0 * h);
    EXPECT_NEAR(force.data()[j], -slope, 1e-8 * force.norm());
    const NodeValues f1 = force_of(belt, plus, rim), f0 = force_of(belt, minus, rim);
    const NodeValues column = K.multiply(direction);
    EXPECT_LT((column + (f1 - f0) / (2.0 * h)).norm(), 1e-7 * column.norm());
  }
}

// A cone has no stress if its sections are rotated by ψ_0, neither in the belt nor in the sidewall.
// Its belt, and one of coupled plies, tilt freely.
TEST(BeltForces, OfAConeVanishAtItsRest) {
  RingParameters ring = passenger_ring();
  ring.belt.bending_in_plane = 10.0;
  ring.belt.bending_twist = 20.0;
  ring.belt.conicity = 0.02;
  const RimFrame rim = some_rim();
  NodeValues q = nodes_at_rest(rim, ring.belt.radius);
  const BeltForces belt(ring.belt, kBeltNodes);
  const SidewallForces wall(ring.sidewall, ring.belt.radius, kBeltNodes, ring.belt.conicity);
  EXPECT_GT(force_of(belt, q, rim).norm(), 1.0);
  q.row(3).array() += ring.belt.conicity;
  EXPECT_LT(force_of(belt, q, rim).norm(), 1e-11 * ring.belt.extension);
  EXPECT_LT(force_of(wall, at_knots(q), rim).norm(), 1e-8);
  RingParameters slack = ring;
  slack.belt.pressure = 0.0;
  const double tilt = 1e-6;
  for (int k = 0; k < kBeltNodes; ++k) {
    const double c =
        node_radius_over_knot_radius(kBeltNodes) * std::cos(2.0 * M_PI * k / kBeltNodes);
    q.col(k).head<3>() += tilt * ring.belt.radius * c * rim.a;
    q(3, k) += tilt * c;
  }
  EXPECT_LT(force_of(BeltForces(slack.belt, kBeltNodes), q, rim).norm(),
            5.0 * slack.belt.extension * tilt * tilt + 1e-11 * ring.belt.extension);
}

TEST(BeltForces, VanishAtRestAndUnderARigidTilt) {
  const RingParameters ring = passenger_ring();
  RingParameters slack = ring;
  slack.belt.pressure = 0.0;
  const RimFrame rim = some_rim();
  NodeValues force =
      force_of(BeltForces(ring.belt, kBeltNodes), nodes_at_rest(rim, ring.belt.radius), rim);
  EXPECT_LT(force.norm(), 1e-11 * ring.belt.extension);  // rounding of the springs

  NodeValues q = nodes_at_rest(rim, ring.belt.radius);
  const double tilt = 1e-3;
  for (int k = 0; k < kBeltNodes; ++k) {
    const double c =
        node_radius_over_knot_radius(kBeltNodes) * std::cos(2.0 * M_PI * k / kBeltNodes);
    q.col(k).head<3>() += tilt * ring.belt.radius * c * rim.a;
    q(3, k) = tilt * c;
  }
  force = force_of(BeltForces(slack.belt, kBeltNodes), q, rim);
  // The rest is of second order in the tilt: the extension of the belt, EA tilt²/2.
  EXPECT_LT(force.row(3).norm(), 1e-9);
  EXPECT_LT(force.norm(), 3.0 * slack.belt.extension * tilt * tilt);
}

TEST(SidewallForces, AreTheGradientOfTheEnergyAndTheStiffnessItsHessian) {
  RingParameters ring = passenger_ring();
  ring.sidewall.progressivity = 1.2;
  ring.sidewall.torsion_by_lateral = 2.0;
  ring.sidewall.rim_travel = 0.001;
  ring.sidewall.rim_stiffness = 4e6;
  const SidewallForces wall(ring.sidewall, ring.belt.radius, kBeltNodes);
  const RimFrame rim = some_rim();
  const NodeValues q = deformed(rim, ring.belt.radius);
  const NodeValues force = at_knots(force_of(wall, at_knots(q), rim));
  const CyclicBand K = stiffness_of(wall, at_knots(q), rim);
  int on_rim = 0;
  for (int k = 0; k < kBeltNodes; ++k)
    on_rim += (at_knots(q).col(k).head<3>() - rim.center).norm() < ring.belt.radius - 0.001;
  EXPECT_GT(on_rim, 2);
  EXPECT_LT(on_rim, kBeltNodes - 2);
  const double h = 1e-6;
  for (int j = 0; j < 4 * kBeltNodes; ++j) {
    const int i = j % 4, k = j / 4;
    NodeValues plus = q, minus = q, direction = NodeValues::Zero(4, kBeltNodes);
    plus(i, k) += h;
    minus(i, k) -= h;
    direction(i, k) = 1.0;
    const double slope =
        (wall.energy(at_knots(plus), rim) - wall.energy(at_knots(minus), rim)) / (2.0 * h);
    EXPECT_NEAR(force(i, k), -slope, 1e-8 * force.norm() + 1e-5);
    const NodeValues f1 = force_of(wall, at_knots(plus), rim),
                     f0 = force_of(wall, at_knots(minus), rim);
    const NodeValues column = K.multiply(direction);
    EXPECT_LT((column + at_knots(f1 - f0) / (2.0 * h)).norm(), 1e-7 * column.norm());
  }
}

// Five elements in parallel slip one after the other at 1/15, 2/15 ... of the whole force. The loop
// of a large travel has a width of twice that force.
TEST(SidewallForces, FrictionElementsMakeALoopOfTheirForce) {
  RingParameters ring = passenger_ring();
  ring.sidewall.radial.friction_stiffening = 0.5;
  ring.sidewall.radial.friction_force = 1000.0;
  SidewallForces wall(ring.sidewall, ring.belt.radius, kBeltNodes);
  const RimFrame rim = some_rim();
  const auto force_at = [&](double radius) {
    const NodeValues q = at_knots(nodes_at_rest(rim, radius));
    const NodeValues force = force_of(wall, q, rim);
    RimRows at(kBeltNodes);
    at.place(q, rim);
    wall.commit(at, {});
    double sum = 0.0;
    const NodeAngles angles(kBeltNodes);
    for (int k = 0; k < kBeltNodes; ++k) sum += angles.radial(rim, k).dot(force.col(k).head<3>());
    return sum;
  };
  force_at(ring.belt.radius - 0.02);
  const double inward = force_at(ring.belt.radius);
  force_at(ring.belt.radius + 0.02);
  const double outward = force_at(ring.belt.radius);
  const double circumference = 2.0 * M_PI * ring.belt.radius;
  EXPECT_NEAR(std::abs(inward - outward), 2.0 * 1000.0 * circumference, 1e-6);
}

}  // namespace
}  // namespace latsch::ring_tire
