// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/response_rim.h"

#include <Eigen/LU>

namespace latsch::fe_tire {

Eigen::MatrixXcd on_moving_rim(const Eigen::MatrixXcd& held, const Rim& rim, double omega) {
  constexpr int kMotions = 6;
  const RimBody& body = rim.body;
  Eigen::Vector<double, kMotions> mass, spring;
  mass << Eigen::Vector3d::Constant(body.mass), body.diametral_inertia, body.spin_inertia,
      body.diametral_inertia;
  spring << body.radial_spring, body.lateral_spring, body.radial_spring, body.tilt_spring,
      body.spin_spring, body.tilt_spring;
  if (rim.motion == RimMotion::free) spring.setZero();
  const Eigen::Index others = held.rows() - kMotions;
  Eigen::MatrixXcd stiffness = -held.bottomRightCorner(kMotions, kMotions);
  stiffness.diagonal() += spring - omega * omega * mass;
  Eigen::MatrixXcd H = held;
  // The rim's motion by every input: the tire's force on a held rim, and unit forces.
  H.bottomLeftCorner(kMotions, others) = held.bottomLeftCorner(kMotions, others);
  H.bottomRightCorner(kMotions, kMotions).setIdentity();
  H.bottomRows(kMotions) = stiffness.partialPivLu().solve(H.bottomRows(kMotions)).eval();
  H.topRightCorner(others, kMotions).setZero();
  H.topRows(others) += held.topRightCorner(others, kMotions) * H.bottomRows(kMotions);
  return H;
}

}  // namespace latsch::fe_tire
