// SPDX-License-Identifier: Apache-2.0
// Tests a five-link corner on bushings: with stiff bushings it moves like the rigid linkage, a
// right corner is the mirror image of a left one, and its caster is that of the kingpin in the
// rigid kinematics.
#include "models/suspension/compliant_corner.h"

#include <gtest/gtest.h>

#include "models/multibody/equilibrium.h"
#include "models/suspension/geometry_testing.h"

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;
using namespace multibody;

const Vector3d kContact(0.0, 0.78, 0.0);

CornerGeometry five_links() {
  CornerGeometry corner;
  corner.linkage.links = {{{"upper_front", {0.06, 0.42, 0.48}, {0.02, 0.69, 0.50}},
                           {"upper_rear", {-0.11, 0.40, 0.47}, {-0.04, 0.69, 0.49}},
                           {"lower_front", {0.33, 0.47, 0.26}, {0.06, 0.70, 0.21}},
                           {"lower_rear", {-0.06, 0.20, 0.22}, {-0.03, 0.72, 0.19}},
                           {"toe_link", {-0.20, 0.30, 0.255}, {-0.15, 0.715, 0.235}}}};
  corner.linkage.wheel = {.side = Side::left, .center = {0.0, 0.78, 0.32}, .radius = 0.32};
  corner.spring.inner = {-0.03, 0.56, 0.62};
  corner.spring.outer = {-0.01, 0.66, 0.26};
  return corner;
}

/// Returns the bushings of the links with stiffness k, and those of the push-rod.
std::vector<BushingParameters> stiff(double k) {
  std::vector<BushingParameters> all(12, {Vector3d::Constant(k), Vector3d::Constant(1.0)});
  all[10].stiffness = all[11].stiffness = Vector3d::Constant(4e4);
  return all;
}

struct Stands {
  Pose upright;
  WheelPosition wheel, rest;
};
Stands stands(const CompliantCorner& corner, const Vector3d& force, const Vector3d& moment) {
  const Mechanism mechanism(corner.bodies, corner.joints);
  Equilibrium statics(mechanism);
  const Load load{corner.upright, corner.contact, force, moment};
  const auto poses = statics.solve({&load, 1});
  EXPECT_TRUE(poses) << poses.failure().reason;
  const auto upright = static_cast<std::size_t>(corner.upright);
  return {(*poses)[upright],
          wheel_position(corner.wheel, (*poses)[upright]),
          wheel_position(corner.wheel, mechanism.at_rest()[upright])};
}

/// Returns the difference (m and rad) between the position of a wheel whose links have bushings of
/// stiffness k and that of a wheel on rigid links.
double from_rigid(double k, double Fz) {
  const CornerGeometry geometry = five_links();
  const auto corner = compliant_five_links(geometry, kContact, stiff(k));
  EXPECT_TRUE(corner);
  const Stands found = stands(*corner, {0.0, 0.0, Fz}, Vector3d::Zero());
  MovingLinkage linkage(geometry.linkage, TravelOf::wheel_center);
  const double travel = found.upright.place.z() - geometry.linkage.wheel.center.z();
  EXPECT_GT(std::abs(travel), 0.015);
  const auto rigid = linkage.move_to(travel, 0.0);
  EXPECT_TRUE(rigid);
  return (found.upright.place - rigid->place).norm() +
         (found.upright.turn - rigid->turn).norm() / std::sqrt(2.0);
}

TEST(FiveLinks, StiffOnesMoveAsTheRigidLinkageByTheInverseOfTheirStiffness) {
  for (const double Fz : {500.0, -500.0}) {
    const double at_8 = from_rigid(1e8, Fz), at_9 = from_rigid(1e9, Fz);
    EXPECT_LT(at_9, 2e-5);
    EXPECT_NEAR(at_8 / at_9, 10.0, 0.2);
  }
}

TEST(FiveLinks, OfTheRightSideAreTheMirrorImage) {
  std::vector<BushingParameters> bushings(12, {{3e6, 8e6, 5e6}, {20.0, 30.0, 50.0}});
  const auto left = compliant_five_links(five_links(), kContact, bushings),
             right = compliant_five_links(
                 right_of(five_links()), {kContact.x(), -kContact.y(), kContact.z()}, bushings);
  ASSERT_TRUE(left && right);
  const Stands of_left = stands(*left, {-2e3, 1.5e3, 4e3}, {20.0, -30.0, 80.0}),
               of_right = stands(*right, {-2e3, -1.5e3, 4e3}, {-20.0, -30.0, -80.0});
  const Vector3d mirror(1.0, -1.0, 1.0);
  EXPECT_LT((of_right.wheel.contact - mirror.cwiseProduct(of_left.wheel.contact)).norm(), 1e-11);
  EXPECT_NEAR(of_right.wheel.camber, of_left.wheel.camber, 1e-11);
  EXPECT_NEAR(of_right.wheel.toe, of_left.wheel.toe, 1e-11);
  EXPECT_NEAR(of_right.wheel.caster, of_left.wheel.caster, 1e-11);
  EXPECT_GT(std::abs(of_left.wheel.caster - of_left.rest.caster), 1e-5);
}

// If the rack turns the upright about the kingpin of the rigid kinematics, its caster does not
// change.
TEST(FiveLinks, CasterIsThatOfTheKingpinAtRest) {
  const CornerGeometry geometry = five_links();
  const auto corner = compliant_five_links(geometry, kContact, stiff(1e9));
  ASSERT_TRUE(corner);
  MovingLinkage linkage(geometry.linkage, TravelOf::wheel_center);
  const auto spring = spring_state(
      geometry.spring, geometry.linkage.wheel.center, linkage.upright(), linkage.twists());
  ASSERT_TRUE(spring);
  const Vector6d turn = linkage.twists().by_rack - spring->length_slopes[1] /
                                                       spring->length_slopes[0] *
                                                       linkage.twists().by_travel;
  const Vector3d axis = turn.tail<3>().normalized(),
                 kingpin = corner->wheel.upper_ball_joint - corner->wheel.lower_ball_joint;
  EXPECT_LT(axis.cross(kingpin.normalized()).norm(), 1e-12);
}

}  // namespace
}  // namespace latsch::suspension
