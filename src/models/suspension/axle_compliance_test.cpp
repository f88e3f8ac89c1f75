// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/axle_compliance.h"

#include <gtest/gtest.h>

#include "models/multibody/equilibrium.h"
#include "models/suspension/corner_testing.h"

namespace latsch::suspension {
namespace {

Matrix6d compliance_of(const DoubleWishbone& corner) {
  const multibody::Mechanism mechanism(corner.bodies(), corner.joints());
  multibody::Equilibrium statics(mechanism);
  EXPECT_TRUE(statics.linearize(mechanism.at_rest(), {}).ok());
  const Eigen::Vector3d arm = corner.contact - corner.wheel_center;
  return travel_at(arm,
                   statics.compliance(DoubleWishbone::kUpright, DoubleWishbone::kUpright, arm));
}

DoubleWishbone right_corner() {
  DoubleWishbone corner = race_corner();
  for (Eigen::Vector3d& point : corner.points) point.y() = -point.y();
  corner.wheel_center.y() = -corner.wheel_center.y();
  corner.contact.y() = -corner.contact.y();
  corner.side = Side::right;
  return corner;
}

TEST(AxleCompliance, OfTheOtherWheelIsThatOfItsOwnStatics) {
  const Matrix6d left = compliance_of(race_corner()), right = compliance_of(right_corner());
  EXPECT_LT((mirrored_compliance(left) - right).norm(), 1e-10 * right.norm());
  const Matrix12d axle = uncoupled_axle(left);
  EXPECT_LT((axle.bottomRightCorner<6, 6>() - right).norm(), 1e-10 * right.norm());
  EXPECT_EQ((axle.topRightCorner<6, 6>().norm()), 0.0);
  // The compliance matrix of an elastic axle is symmetric.
  EXPECT_LT((axle - axle.transpose()).norm(), 1e-9 * axle.norm());
}

// The compliances must equal finite differences of the static equilibrium under small loads, with
// camber and toe from the wheel's spin axis.
TEST(AxleCompliance, ClassicalFormulasAreSlopesOfTheStatics) {
  const DoubleWishbone corner = race_corner();
  const multibody::Mechanism mechanism(corner.bodies(), corner.joints());
  multibody::Equilibrium statics(mechanism, {.force = 1e-8});
  const auto moved = [&](const Eigen::Vector3d& force, const Eigen::Vector3d& moment) {
    const multibody::Load on{DoubleWishbone::kUpright, corner.contact, force, moment};
    const auto poses = statics.solve({&on, 1});
    EXPECT_TRUE(poses) << poses.failure().reason;
    return wheel_position(corner.wheel(), (*poses)[DoubleWishbone::kUpright]);
  };
  const auto slope = [&](const Eigen::Vector3d& force, const Eigen::Vector3d& moment, auto value) {
    return (value(moved(force, moment)) - value(moved(-force, -moment))) / 2.0;
  };
  const auto toe = [](const WheelPosition& at) { return at.toe; };
  const auto camber = [](const WheelPosition& at) { return at.camber; };
  const auto z = [](const WheelPosition& at) { return at.contact.z(); };
  using Eigen::Vector3d;
  const Vector3d none = Vector3d::Zero(), y = Vector3d::UnitY(), up = Vector3d::UnitZ();
  const Matrix12d axle = uncoupled_axle(compliance_of(corner));
  for (const Phase phase : {Phase::in, Phase::out}) {
    const ClassicalCompliances found = classical_compliances(axle, phase);
    const auto near = [](double value, double expected) {
      EXPECT_NEAR(value / expected, 1.0, 1e-5);
    };
    near(found.lateral_force_toe, slope(y, none, toe));
    near(found.lateral_force_camber, slope(y, none, camber));
    near(found.longitudinal_force_toe, slope(Vector3d::UnitX(), none, toe));
    near(found.aligning_torque_toe, slope(none, up, toe));
    near(found.aligning_torque_camber, slope(none, up, camber));
    near(found.vertical, slope(up, none, z));
  }
}

// An anti-roll bar resists loads of opposite sign only. Half of the resulting change of compliance
// is between the two wheels.
TEST(AxleCompliance, LoadsInAndOutOfPhaseDifferByWhatCouplesTheWheels) {
  Matrix12d axle = uncoupled_axle(compliance_of(race_corner()));
  const double own = axle(2, 2), shared = 0.25 * own;
  axle(2, 8) = axle(8, 2) = shared;
  EXPECT_DOUBLE_EQ(classical_compliances(axle, Phase::in).vertical, own + shared);
  EXPECT_DOUBLE_EQ(classical_compliances(axle, Phase::out).vertical, own - shared);
}

}  // namespace
}  // namespace latsch::suspension
