// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/strut.h"

namespace latsch::multibody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

LineGeometry line_geometry(
    const Pose& a, const Pose& b, const Vector3d& in_a, const Vector3d& in_b, double weight) {
  LineGeometry line;
  line.arm_a = a.turn * in_a;
  line.arm_b = b.turn * in_b;
  const Vector3d between = b.place + line.arm_b - a.place - line.arm_a;
  line.length = between.norm();
  line.n = between / line.length;
  line.weight = weight;
  return line;
}

Vector6d LineGeometry::by_a() const {
  Vector6d by;
  by << -weight * n, -weight * arm_a.cross(n);
  return by;
}

Vector6d LineGeometry::by_b() const {
  Vector6d by;
  by << weight * n, weight * arm_b.cross(n);
  return by;
}

double LineGeometry::centripetal(const Vector6d& rate_a, const Vector6d& rate_b) const {
  const Vector3d wa = rate_a.tail<3>(), wb = rate_b.tail<3>();
  const Vector3d va = wa.cross(arm_a), vb = wb.cross(arm_b);
  const Vector3d relative = rate_b.head<3>() + vb - rate_a.head<3>() - va;
  const double across = relative.squaredNorm() - std::pow(n.dot(relative), 2);
  return weight * (across / length + n.dot(wb.cross(vb) - wa.cross(va)));
}

LineGeometry::Turning LineGeometry::turning() const {
  const Matrix3d P = weight / length * (Matrix3d::Identity() - n * n.transpose());
  const Matrix3d rho = cross(arm_b), sigma = cross(arm_a), m = weight * cross(n);
  const Matrix3d P_rho = P * rho, P_sigma = P * sigma;
  Turning by;
  by.bb << P, -P_rho, rho * P, m * rho - rho * P_rho;
  by.ba << -P, P_sigma, -(rho * P), rho * P_sigma;
  by.aa << P, -P_sigma, sigma * P, -(m * sigma) - sigma * P_sigma;
  by.ab << -P, P_rho, -(sigma * P), sigma * P_rho;
  return by;
}

}  // namespace latsch::multibody
