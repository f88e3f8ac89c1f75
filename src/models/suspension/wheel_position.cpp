// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/wheel_position.h"

#include <cmath>

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;

double outboard(Side side) { return side == Side::left ? 1.0 : -1.0; }

}  // namespace

WheelPosition wheel_position(const WheelPoints& points, const Pose& upright) {
  const double sign = outboard(points.side);
  const Vector3d a = upright.turn.col(1);
  const Vector3d k = upright.turn * (points.upper_ball_joint - points.lower_ball_joint);
  return {.contact = upright.at(points.contact),
          .center = upright.at(points.center),
          .camber = -sign * std::asin(a.z()),
          .toe = -sign * std::atan2(-a.x(), a.y()),
          .caster = std::atan2(-k.x(), k.z())};
}

Matrix6d wheel_slopes(const WheelPoints& points, const Pose& upright) {
  const double sign = outboard(points.side);
  const Vector3d a = upright.turn.col(1);
  const Vector3d k = upright.turn * (points.upper_ball_joint - points.lower_ball_joint);
  Matrix6d slopes = Matrix6d::Zero();
  slopes.topLeftCorner<3, 3>().setIdentity();
  slopes.topRightCorner<3, 3>() = -cross(upright.turn * points.contact);
  // A small rotation δθ changes the spin axis by da = δθ × a, so the derivatives are the rows of
  // -cross(a).
  const Eigen::Matrix3d da = -cross(a), dk = -cross(k);
  slopes.block<1, 3>(3, 3) = -sign * da.row(2) / std::sqrt(1.0 - a.z() * a.z());
  slopes.block<1, 3>(4, 3) =
      -sign * (a.x() * da.row(1) - a.y() * da.row(0)) / (a.x() * a.x() + a.y() * a.y());
  slopes.block<1, 3>(5, 3) =
      (k.x() * dk.row(2) - k.z() * dk.row(0)) / (k.x() * k.x() + k.z() * k.z());
  return slopes;
}

}  // namespace latsch::suspension
