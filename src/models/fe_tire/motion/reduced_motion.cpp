// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/reduced_motion.h"

#include <Eigen/LU>
#include <complex>

namespace latsch::fe_tire {

using Complex = std::complex<double>;

Eigen::MatrixXcd ReducedMotion::stiffness(double omega) const {
  const Complex s(0.0, omega);
  Eigen::MatrixXcd Z = K.cast<Complex>();
  for (const RelaxingStiffness& part : parts) {
    Complex share = 0.0;
    for (const PronyTerm& term : part.terms)
      share += term.beta * s * term.tau / (1.0 + s * term.tau);
    Z += share * part.K;
  }
  Z *= 1.0 + s * rayleigh.b;
  Z.diagonal().array() += s * rayleigh.a + s * s;
  return Z;
}

Eigen::MatrixXcd ReducedMotion::motions(double omega, const Eigen::MatrixXcd& loads) const {
  return stiffness(omega).partialPivLu().solve(loads);
}

}  // namespace latsch::fe_tire
