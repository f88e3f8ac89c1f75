// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/axle_compliance.h"

namespace latsch::suspension {

Matrix6d travel_at(const Eigen::Vector3d& arm, const Matrix6d& of_origin) {
  Matrix6d at_point = of_origin;
  at_point.topRows<3>() -= cross(arm) * of_origin.bottomRows<3>();  // d + θ × arm
  return at_point;
}

Matrix6d mirrored_compliance(const Matrix6d& corner) {
  // The mirror image of a compliance matrix has reversed signs for components along y, about x and
  // about z.
  Vector6d signs;
  signs << 1.0, -1.0, 1.0, -1.0, 1.0, -1.0;
  return signs.asDiagonal() * corner * signs.asDiagonal();
}

Matrix12d uncoupled_axle(const Matrix6d& left) {
  Matrix12d axle = Matrix12d::Zero();
  axle.topLeftCorner<6, 6>() = left;
  axle.bottomRightCorner<6, 6>() = mirrored_compliance(left);
  return axle;
}

ClassicalCompliances classical_compliances(const Matrix12d& axle, Phase phase) {
  const double sign = phase == Phase::in ? 1.0 : -1.0;
  const auto by = [&](int response, int load) {
    return axle(response, load) + sign * axle(response, load + 6);
  };
  enum { kX, kY, kZ, kAboutX, kAboutY, kAboutZ };
  // Toe-in of a left wheel is a rotation to the right about z, its camber a rotation of the top to
  // the left about x.
  return {.lateral_force_toe = -by(kAboutZ, kY),
          .lateral_force_camber = -by(kAboutX, kY),
          .longitudinal_force_toe = -by(kAboutZ, kX),
          .aligning_torque_toe = -by(kAboutZ, kAboutZ),
          .aligning_torque_camber = -by(kAboutX, kAboutZ),
          .longitudinal = by(kX, kX),
          .lateral = by(kY, kY),
          .vertical = by(kZ, kZ)};
}

}  // namespace latsch::suspension
