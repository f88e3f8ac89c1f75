// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/rod_masses.h"

namespace latsch::multibody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Returns the inertia tensor of a point mass about a point; `from` is the vector between both.
Matrix3d of_point_mass(double mass, const Vector3d& from) {
  return mass * (from.squaredNorm() * Matrix3d::Identity() - from * from.transpose());
}

}  // namespace

BodyMass together(const BodyMass& a, const BodyMass& b) {
  BodyMass both;
  both.mass = a.mass + b.mass;
  if (both.mass == 0.0) return a;
  both.center = (a.mass * a.center + b.mass * b.center) / both.mass;
  both.inertia = a.inertia + b.inertia + of_point_mass(a.mass, a.center - both.center) +
                 of_point_mass(b.mass, b.center - both.center);
  return both;
}

BodyMass mass_of_rods(const std::vector<std::pair<Vector3d, Vector3d>>& rods,
                      double mass,
                      double radius) {
  double length = 0.0;
  for (const auto& [from, to] : rods) length += (to - from).norm();
  BodyMass all;
  for (const auto& [from, to] : rods) {
    const double L = (to - from).norm(), m = mass * L / length, r2 = radius * radius;
    const Vector3d n = (to - from) / L;
    const double along = 0.5 * m * r2, across = m * (L * L / 12.0 + 0.25 * r2);
    all = together(all,
                   {m,
                    0.5 * (from + to),
                    across * Matrix3d::Identity() + (along - across) * n * n.transpose()});
  }
  return all;
}

}  // namespace latsch::multibody
