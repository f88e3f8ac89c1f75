// SPDX-License-Identifier: Apache-2.0
// Free vibrations of a body parts of whose stiffness relax, in the coordinates q of shapes phi_j
// that are orthogonal and of unit mass:
//   x = sum_j phi_j Re(q_j exp(s t)),
//   [s^2 + K + sum_r K_r sum_i beta_ri s tau_ri/(1 + s tau_ri)] q = 0                        (H.4)
// K is the relaxed stiffness, and K_r the part of it to which the Prony terms r belong. The
// equation is exact for motions that the shapes span. A vibration is found by fixed points on s and
// Rayleigh quotients from one of the shapes.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/history/prony.h"

namespace latsch::fe_tire {

/// A relaxing part K_r of the stiffness [shapes x shapes], symmetric, 1/s^2, and its terms.
struct RelaxingStiffness {
  Eigen::MatrixXd K;
  PronyTerms terms;
};

/// One free vibration: decay rate and angular frequency s = -delta + i omega, rad/s, and
/// coordinates q with q^T q = 1.
struct FreeVibration {
  std::complex<double> s;
  Eigen::VectorXcd q;

  double frequency() const;  // Hz, |s|/(2 pi)
  double damping() const;    // share of critical damping, -Re s/|s|
};

/// Returns the vibration that grows out of shape `start`. `K`: relaxed stiffness [shapes x shapes],
/// symmetric, 1/s^2. A Failure says that the motion is overdamped or that the iteration does not
/// settle.
Result<FreeVibration> free_vibration(const Eigen::MatrixXd& K,
                                     const std::vector<RelaxingStiffness>& parts,
                                     int start);

}  // namespace latsch::fe_tire
