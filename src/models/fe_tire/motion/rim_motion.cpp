// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/rim_motion.h"

#include <numbers>

namespace latsch::fe_tire {

Eigen::Matrix<std::complex<double>, 3, 2> rim_displacements(int n, const Eigen::Vector3d& X) {
  using Complex = std::complex<double>;
  Eigen::Matrix<Complex, 3, 2> T;
  if (n == 0) {
    T.col(0) << 0.0, 1.0, 0.0;
    T.col(1) << X.z(), 0.0, -X.x();
    return T;
  }
  const Complex i(0.0, 1.0);
  T.col(0) << 1.0, 0.0, i;
  T.col(1) << -i * X.y(), i * X.x() - X.z(), X.y();
  return T / std::numbers::sqrt2;
}

RimMatrices rim_matrices(int n, const Rim& rim) {
  const RimBody& body = rim.body;
  RimMatrices matrices;
  if (n == 0) {
    matrices.M << body.mass, body.spin_inertia;
    matrices.G.setZero();
    matrices.springs << body.lateral_spring, body.spin_spring;
  } else {
    matrices.M << body.mass, body.diametral_inertia;
    matrices.G << 0.0, body.spin_inertia;
    matrices.springs << body.radial_spring, body.tilt_spring;
  }
  if (rim.motion == RimMotion::free) matrices.springs.setZero();
  return matrices;
}

}  // namespace latsch::fe_tire
