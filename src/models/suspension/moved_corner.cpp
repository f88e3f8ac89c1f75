// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/moved_corner.h"

#include <cassert>
#include <vector>

#include "models/suspension/linkage.h"
#include "models/suspension/spring_drive.h"

namespace latsch::suspension {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Motion of a rigid part: the point p at rest is now at to + turn (p - from).
struct PartMotion {
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
  Matrix3d turn = Matrix3d::Identity();

  Vector3d at(const Vector3d& point) const { return to + turn * (point - from); }
};

/// Returns the motion of a rod with these ends at rest and now, which does not spin about itself.
PartMotion rod_motion(const Vector3d& inner,
                      const Vector3d& outer,
                      const Vector3d& inner_now,
                      const Vector3d& outer_now) {
  return {
      inner,
      inner_now,
      Eigen::Quaterniond::FromTwoVectors(outer - inner, outer_now - inner_now).toRotationMatrix()};
}

/// Returns the motion of a wishbone on its hinge whose ball joint has moved.
PartMotion wishbone_motion(const Vector3d& front,
                           const Vector3d& rear,
                           const Vector3d& ball,
                           const Vector3d& ball_now) {
  const Vector3d axis = (rear - front).normalized();
  const auto arm = [&](const Vector3d& point) -> Vector3d {
    const Vector3d d = point - front;
    return d - d.dot(axis) * axis;
  };
  const Vector3d was = arm(ball), is = arm(ball_now);
  const double angle = std::atan2(axis.dot(was.cross(is)), was.dot(is));
  return {front, front, Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
}

std::vector<PartMotion> motions_of_double_wishbone(const DoubleWishbone& corner,
                                                   const PartMotion& upright,
                                                   const RodEnds& pushrod,
                                                   double rack) {
  using D = DoubleWishbone;
  const auto& p = corner.points;
  std::vector<PartMotion> motions(D::kBodies);
  motions[D::kUpper] =
      wishbone_motion(p[D::kUcaFront], p[D::kUcaRear], p[D::kUbj], upright.at(p[D::kUbj]));
  motions[D::kLower] =
      wishbone_motion(p[D::kLcaFront], p[D::kLcaRear], p[D::kLbj], upright.at(p[D::kLbj]));
  motions[D::kUpright] = upright;
  motions[D::kPushrod] =
      rod_motion(p[D::kPushrodInner], p[D::kPushrodOuter], pushrod.inner, pushrod.outer);
  motions[D::kTrackrod] = rod_motion(p[D::kTrackrodInner],
                                     p[D::kTrackrodOuter],
                                     p[D::kTrackrodInner] + rack * Vector3d::UnitY(),
                                     upright.at(p[D::kTrackrodOuter]));
  return motions;
}

/// Bodies in the order of compliant_five_links(): the upright, the links, the push-rod.
std::vector<PartMotion> motions_of_five_links(const CornerGeometry& geometry,
                                              const MovingLinkage& moving,
                                              const PartMotion& upright,
                                              const RodEnds& pushrod) {
  std::vector<PartMotion> motions = {upright};
  for (int i = 0; i < Linkage::kLinks; ++i) {
    const Link& link = geometry.linkage.links[static_cast<std::size_t>(i)];
    motions.push_back(rod_motion(link.inner, link.outer, moving.inner(i), moving.outer(i)));
  }
  motions.push_back(
      rod_motion(geometry.spring.inner, geometry.spring.outer, pushrod.inner, pushrod.outer));
  return motions;
}

/// Moves a joint with its second body, which is never the chassis. The axes of a joint whose spin
/// is held (multibody/rod_spin.h) follow its rod.
void move_joint(const std::vector<PartMotion>& motions, multibody::Joint& joint) {
  const PartMotion& of_b = motions[static_cast<std::size_t>(joint.b)];
  joint.point = of_b.at(joint.point);
  if (joint.a != multibody::kGround) {
    joint.axes = motions[static_cast<std::size_t>(joint.a)].turn * joint.axes;
  } else if (!joint.axes.isIdentity(0.0)) {
    joint.axes = of_b.turn * joint.axes;
  }
}

}  // namespace

Result<CompliantCorner> moved_corner(const SuspensionCorner& corner, double travel, double rack) {
  assert(corner.compliant);
  const CornerGeometry& geometry = corner.geometry;
  MovingLinkage moving(geometry.linkage, TravelOf::wheel_center);
  const auto pose = moving.move_to(travel, rack);
  if (!pose) return pose.failure();
  const Vector3d center = geometry.linkage.wheel.center;
  const auto pushrod = rod_ends(geometry.spring, center, *pose);
  if (!pushrod) return pushrod.failure();
  const PartMotion upright = {center, pose->place, pose->turn};
  const std::vector<PartMotion> motions =
      corner.statics ? motions_of_double_wishbone(*corner.statics, upright, *pushrod, rack)
                     : motions_of_five_links(geometry, moving, upright, *pushrod);
  CompliantCorner moved = *corner.compliant;
  assert(motions.size() == moved.bodies.size());
  for (std::size_t i = 0; i < motions.size(); ++i)
    moved.bodies[i].origin = motions[i].at(moved.bodies[i].origin);
  for (multibody::Joint& joint : moved.joints) move_joint(motions, joint);
  moved.wheel_center = pose->place;
  moved.contact = pose->place + moving.to_contact();
  moved.wheel.contact = moving.to_contact();
  moved.wheel.lower_ball_joint = pose->turn * moved.wheel.lower_ball_joint;
  moved.wheel.upper_ball_joint = pose->turn * moved.wheel.upper_ball_joint;
  return moved;
}

}  // namespace latsch::suspension
