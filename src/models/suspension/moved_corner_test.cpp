// SPDX-License-Identifier: Apache-2.0
// Tests the compliance of a corner in another position of its wheel.
#include "models/suspension/moved_corner.h"

#include <gtest/gtest.h>

#include "models/multibody/equilibrium.h"
#include "models/suspension/axle_compliance.h"
#include "models/suspension/corner_testing.h"

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;
using D = DoubleWishbone;

/// Returns a corner with these bushings on the hardpoints of corner_testing.h.
SuspensionCorner corner_on(const DoubleWishbone& statics) {
  SuspensionCorner corner;
  const auto& p = statics.points;
  corner.geometry.linkage.links = {{{"upper front", p[D::kUcaFront], p[D::kUbj]},
                                    {"upper rear", p[D::kUcaRear], p[D::kUbj]},
                                    {"lower front", p[D::kLcaFront], p[D::kLbj]},
                                    {"lower rear", p[D::kLcaRear], p[D::kLbj]},
                                    {"track-rod", p[D::kTrackrodInner], p[D::kTrackrodOuter]}}};
  corner.geometry.linkage.wheel = {.side = statics.side,
                                   .center = statics.wheel_center,
                                   .radius = statics.wheel_center.z() - statics.contact.z()};
  corner.geometry.spring = {.on = SpringDrive::On::upper_wishbone,
                            .outer = p[D::kPushrodOuter],
                            .inner = p[D::kPushrodInner],
                            .hinge_front = p[D::kUcaFront],
                            .hinge_rear = p[D::kUcaRear],
                            .ball = p[D::kUbj],
                            .rocker = std::nullopt,
                            .blade = std::nullopt};
  corner.geometry.kingpin = CornerGeometry::Kingpin{p[D::kLbj], p[D::kUbj]};
  corner.statics = statics;
  corner.compliant = compliant_corner(statics);
  return corner;
}

/// Returns the compliance of a corner without loads at its wheel center.
Matrix6d compliance_at_center(const CompliantCorner& corner) {
  const multibody::Mechanism mechanism(corner.bodies, corner.joints);
  multibody::Equilibrium statics(mechanism);
  EXPECT_TRUE(statics.linearize(mechanism.at_rest(), {}).ok());
  return statics.compliance(corner.upright, corner.upright, Vector3d::Zero());
}

/// Returns the compliance of a wheel whose center is held at its height: the part that does not
/// depend on the spring.
Matrix6d held(const Matrix6d& C) {
  constexpr int kZ = 2;
  return C - C.col(kZ) * C.row(kZ) / C(kZ, kZ);
}

/// Bushings that differ in their axes, so that a turned one shows.
DoubleWishbone uneven_corner() {
  DoubleWishbone corner = race_corner();
  corner.bushings.fill({Vector3d(3e7, 1e7, 2e7), Vector3d::Constant(0.05)});
  return corner;
}

TEST(MovedCorner, AtRestIsTheCornerItself) {
  const SuspensionCorner corner = corner_on(uneven_corner());
  const auto moved = moved_corner(corner, 0.0, 0.0);
  ASSERT_TRUE(moved);
  for (std::size_t i = 0; i < moved->joints.size(); ++i) {
    EXPECT_LT((moved->joints[i].point - corner.compliant->joints[i].point).norm(), 1e-12);
    EXPECT_LT((moved->joints[i].axes - corner.compliant->joints[i].axes).norm(), 1e-12);
  }
  const Matrix6d C = compliance_at_center(*corner.compliant);
  EXPECT_LT((compliance_at_center(*moved) - C).norm(), 1e-9 * C.norm());
}

TEST(MovedCorner, KeepsTheLengthsOfItsLinks) {
  const DoubleWishbone statics = uneven_corner();
  const auto moved = moved_corner(corner_on(statics), 0.04, 0.01);
  ASSERT_TRUE(moved);
  const auto length_kept = [&](D::Joint a, D::Joint b) {
    return (moved->joints[b].point - moved->joints[a].point).norm() -
           (statics.points[b] - statics.points[a]).norm();
  };
  EXPECT_NEAR(length_kept(D::kUcaFront, D::kUbj), 0.0, 1e-9);
  EXPECT_NEAR(length_kept(D::kUcaRear, D::kUbj), 0.0, 1e-9);
  EXPECT_NEAR(length_kept(D::kLcaRear, D::kLbj), 0.0, 1e-9);
  EXPECT_NEAR(length_kept(D::kUbj, D::kLbj), 0.0, 1e-9);
  EXPECT_NEAR(length_kept(D::kTrackrodInner, D::kTrackrodOuter), 0.0, 1e-9);
  EXPECT_NEAR(length_kept(D::kUcaFront, D::kPushrodOuter), 0.0, 1e-9);
  EXPECT_NEAR(moved->wheel_center.z() - statics.wheel_center.z(), 0.04, 1e-9);
  const Vector3d shift = moved->joints[D::kTrackrodInner].point - statics.points[D::kTrackrodInner];
  EXPECT_LT((shift - 0.01 * Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_EQ(moved->joints[D::kUcaFront].point, statics.points[D::kUcaFront]);
}

// The statics of the whole mechanism bring the wheel to the same position against a push-rod that
// is so soft that its force, some 10 N, hardly strains the other bushings: 1e-6 m of 0.2 m. The
// tangent there, with the wheel's height held, is that of the moved corner.
TEST(MovedCorner, HasTheTangentOfTheStaticsInItsPosition) {
  constexpr double kSoft = 400.0, kTravel = 0.03;  // N/m, m
  DoubleWishbone statics = uneven_corner();
  statics.bushings[D::kPushrodInner] =
      statics.bushings[D::kPushrodOuter] = {Vector3d::Constant(kSoft), Vector3d::Constant(1e-3)};
  const SuspensionCorner corner = corner_on(statics);
  const multibody::Mechanism mechanism(corner.compliant->bodies, corner.compliant->joints);
  multibody::Equilibrium equilibrium(mechanism, {.force = 1e-9});
  multibody::Load up{D::kUpright, statics.wheel_center};
  multibody::Poses poses = mechanism.at_rest();
  const auto travel = [&] { return poses[D::kUpright].place.z() - statics.wheel_center.z(); };
  // The force that gives the travel, by the secant of two steps.
  double force = 0.0;
  for (int step = 0; step < 60 && std::abs(travel() - kTravel) > 1e-9; ++step) {
    const double way = std::min(kTravel - travel(), 0.002);
    ASSERT_TRUE(equilibrium.linearize(poses, {&up, 1}).ok());
    force += way / equilibrium.compliance(D::kUpright, D::kUpright, Vector3d::Zero())(2, 2);
    up.force.z() = force;
    auto found = equilibrium.solve({&up, 1}, &poses);
    ASSERT_TRUE(found) << found.failure().reason;
    poses = std::move(*found);
  }
  ASSERT_NEAR(travel(), kTravel, 1e-7);
  ASSERT_LT(std::abs(force), 30.0);
  ASSERT_TRUE(equilibrium.linearize(poses, {&up, 1}).ok());
  const Matrix6d expected =
      held(equilibrium.compliance(D::kUpright, D::kUpright, Vector3d::Zero()));
  const auto moved = moved_corner(corner, travel(), 0.0);
  ASSERT_TRUE(moved);
  const Matrix6d found = held(compliance_at_center(*moved));
  // Displacements in m, rotations over a length of 0.3 m, so that all entries compare.
  Vector6d scale;
  scale << 1.0, 1.0, 1.0, 0.3, 0.3, 0.3;
  const auto scaled = [&](const Matrix6d& C) -> Matrix6d {
    return scale.asDiagonal() * C * scale.asDiagonal();
  };
  EXPECT_LT(scaled(found - expected).norm(), 1e-3 * scaled(expected).norm());
  // The position matters: at rest the compliance is another one.
  const Matrix6d at_rest = held(compliance_at_center(*corner.compliant));
  EXPECT_GT(scaled(at_rest - expected).norm(), 1e-2 * scaled(expected).norm());
}

TEST(MovedCorner, NamesTheLinkThatEndsTheMotion) {
  const auto moved = moved_corner(corner_on(race_corner()), 0.5, 0.0);
  EXPECT_FALSE(moved);
}

}  // namespace
}  // namespace latsch::suspension
