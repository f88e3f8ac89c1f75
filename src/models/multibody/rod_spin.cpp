// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/rod_spin.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace latsch::multibody {

using Eigen::Vector3d;

namespace {

constexpr double kSpin = 1.0;  // N m/rad
// N m s/rad: a tenth of the critical damping of a rod of about 0.4 kg
constexpr double kSpinDamping = 2e-3;

bool resists(const Joint& joint, const Vector3d& line) {
  return joint.bushing.rotational.dot((joint.axes.transpose() * line).cwiseAbs2()) > 0.0 ||
         std::any_of(joint.bushing.parts.begin(), joint.bushing.parts.end(), [&](const auto& part) {
           return part.axis >= 3 && joint.axes.col(part.axis - 3).dot(line) != 0.0;
         });
}

/// Returns true if the joint's stiffness and damping are the same along all axes, so that its axes
/// can be turned without an effect.
bool is_alike_in_all_axes(const Joint& joint) {
  const auto even = [](const Vector3d& v) { return v == Vector3d::Constant(v.x()); };
  const BushingParameters& bushing = joint.bushing;
  return bushing.rigid && bushing.parts.empty() && even(bushing.stiffness) &&
         even(bushing.damping) && bushing.rotational.isZero(0.0) &&
         even(bushing.rotational_damping);
}

}  // namespace

void hold_spin(Joint& inner, Joint& outer) {
  const Vector3d way = outer.point - inner.point;
  if (!(way.norm() > 0.0)) return;
  const Vector3d line = way.normalized();
  Joint& joint = is_alike_in_all_axes(inner) ? inner : outer;
  if (!is_alike_in_all_axes(joint) || resists(inner, line) || resists(outer, line)) return;
  joint.axes = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), line).toRotationMatrix();
  joint.bushing.rotational.z() = kSpin;
  joint.bushing.rotational_damping.z() += kSpinDamping;
}

}  // namespace latsch::multibody
