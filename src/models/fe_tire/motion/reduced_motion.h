// SPDX-License-Identifier: Apache-2.0
// Harmonic motions of a body in the coordinates q of shapes that are orthogonal and of unit mass:
//   [(1 + i omega b) (K + sum_r K_r sum_i beta_ri i omega tau_ri/(1 + i omega tau_ri))
//    + i omega a - omega^2] q = p                                                             (Z.1)
// K is the relaxed stiffness and K_r the part of it to which the Prony terms r belong
// (free_vibrations.h). a and b are Rayleigh's damping, which only serves for comparison with
// programs that know no relaxing rubber. The equation is exact for motions that the shapes span.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/history/free_vibrations.h"

namespace latsch::fe_tire {

/// Damping by a M + b K.
struct Rayleigh {
  double a = 0.0;  // 1/s
  double b = 0.0;  // s
};

struct ReducedMotion {
  Eigen::MatrixXd K;                          // [shapes x shapes], symmetric, 1/s^2
  std::vector<RelaxingStiffness> parts = {};  // parts of it that relax
  Rayleigh rayleigh = {};

  /// Returns the dynamic stiffness, the bracket of (Z.1), at `omega`, rad/s.
  Eigen::MatrixXcd stiffness(double omega) const;
  /// Returns the motions q [shapes x loads] under loads p exp(i omega t), N/sqrt(kg). A stiffness
  /// without damping is singular at its natural frequencies.
  Eigen::MatrixXcd motions(double omega, const Eigen::MatrixXcd& loads) const;
};

}  // namespace latsch::fe_tire
