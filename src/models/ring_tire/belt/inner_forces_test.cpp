// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/inner_forces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/description/ring_parameters_testing.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

/// A sidewall with all its elements, on a wheel that leans and is displaced from its belt. The
/// wheel does not spin, because the rotation of dampers with the wheel is left out.
class RimRowsOfForces : public testing::Test {
 protected:
  RimRowsOfForces() : forces_(parameters()), g_(kNodes), q_(4, kNodes), v_(4, kNodes) {
    WheelMotion motion;
    motion.center = {0.1, -0.2, 0.3};
    motion.carrier =
        (Eigen::AngleAxisd(0.3, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.1, Vector3d::UnitX()))
            .toRotationMatrix();
    motion.velocity = {5.0, 0.2, -0.1};
    motion.spin = 1.2;
    rim_ = RimFrame::of(motion);
    const NodeAngles angles(kNodes);
    const double R = parameters().belt.radius * node_radius_over_knot_radius(kNodes);
    for (int k = 0; k < kNodes; ++k) {
      const double phi = 2.0 * std::numbers::pi * k / kNodes;
      const Vector3d x =
          (R - 0.01 * std::cos(phi) + 0.004 * std::sin(2.0 * phi)) * angles.radial(rim_, k) +
          0.006 * std::sin(phi) * angles.tangential(rim_, k) + 0.005 * std::cos(2.0 * phi) * rim_.a;
      q_.col(k) << rim_.center + x, 0.02 * std::sin(phi);
      v_.col(k) << rim_.velocity_at(rim_.center + x) + 0.3 * std::cos(phi) * rim_.X, 0.1;
    }
    (void)forces_.find_stiffness(q_, rim_, kRule, kScale);
  }

  static RingParameters parameters() {
    RingParameters ring = passenger_ring();
    ring.nodes = kNodes;
    for (SidewallElement* of :
         {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral})
      of->dynamic_stiffening = 0.2;
    ring.sidewall.progressivity = 1.2;
    ring.sidewall.torsion_by_lateral = 3.0;
    return ring;
  }

  /// Returns forces on the nodes displaced by `by` along a field, with the corresponding
  /// velocities.
  NodeValues forces_at(const NodeValues& field, double by) {
    NodeValues force(4, kNodes);
    forces_.find_force(q_ + by * field, v_ + by * kRule.velocity * field, rim_, kRule, force);
    return force;
  }

  /// Compares the row with differences of a function `of` of positions and forces.
  template <class Of>
  void expect_slopes(const Of& of) {
    constexpr double kBy = 1e-6;
    double largest = 0.0, most = 0.0;
    for (int k = 0; k < kNodes; k += 3) {
      for (int i = 0; i < 4; ++i) {
        NodeValues field = NodeValues::Zero(4, kNodes);
        Vector3d along = Vector3d::Zero();
        if (i < 3) along = i == 0 ? rim_.X : i == 1 ? rim_.a : rim_.Z;
        field.col(k) << along, i == 3 ? 1.0 : 0.0;
        const double slope = (of(q_ + kBy * field, forces_at(field, kBy)) -
                              of(q_ - kBy * field, forces_at(field, -kBy))) /
                             (2.0 * kBy);
        largest = std::max(largest, std::abs(slope));
        most = std::max(most, std::abs(slope - g_.row(i)[k]));
      }
    }
    EXPECT_LT(most, 2e-5 * largest);
    EXPECT_GT(largest, 100.0);
  }

  static constexpr int kNodes = 24;
  static constexpr double kScale = 0.9;
  static constexpr StepRule kRule = {.step = 1e-3, .velocity = 2e3, .acceleration = 4e6};
  InnerForces forces_;
  RimFrame rim_;
  RimRows g_;
  NodeValues q_, v_;
};

// The belt is part of the forces but not of the row.
TEST_F(RimRowsOfForces, AreTheSlopesOfTheMomentAboutTheAxis) {
  (void)forces_at(NodeValues::Zero(4, kNodes), 0.0);
  (void)forces_.find_stiffness(q_, rim_, kRule, kScale);
  forces_.find_turned_rim(kScale, g_);
  expect_slopes([&](const NodeValues& q, const NodeValues& force) {
    double moment = 0.0;
    for (int k = 0; k < kNodes; ++k)
      moment -= rim_.a.dot((q.col(k).head<3>() - rim_.center).cross(force.col(k).head<3>()));
    return moment;
  });
}

TEST_F(RimRowsOfForces, AreTheSlopesOfTheForceUpward) {
  (void)forces_at(NodeValues::Zero(4, kNodes), 0.0);
  (void)forces_.find_stiffness(q_, rim_, kRule, kScale);
  forces_.find_moved_rim(rim_.axes().transpose() * Vector3d::UnitZ(), kScale, g_);
  expect_slopes([&](const NodeValues&, const NodeValues& force) { return -force.row(2).sum(); });
}

}  // namespace
}  // namespace latsch::ring_tire
