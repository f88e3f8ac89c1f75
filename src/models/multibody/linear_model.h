// SPDX-License-Identifier: Apache-2.0
// Linear model of a mechanism about an equilibrium, for small motion x, six numbers per body
// (travel and rotation), with inputs u and outputs y:
//   M x'' + C x' + K x = P u + Q u'                                                            (1)
//   y = A x + B x' + D x''                                                                     (2)
//   K = -∂f/∂x,  C = -∂f/∂v,  M: masses, inertias, inerters        f: assembly.h, exact
//   (λ² M + λ C + K) φ = 0,  f = |λ|/2π,  ζ = -Re λ/|λ|                                        (3)
//   y/u = (A + iω B - ω² D) (K + iω C - ω² M)⁻¹ (P + iω Q)                                     (4)
// (4) is solved as a real system of twice the size. K includes preloads, loads and weight. It is
// therefore not symmetric in general, because rotations about the ground's axes are not coordinates
// of a potential.
//
// Nonlinear laws (damper curves, play) enter with their derivatives at the equilibrium. Dry
// friction sticks. Maxwell elements are relaxed, so their additional stiffness near and above their
// own frequency is not included. Actions from outside enter by the slopes of their wrenches,
// evaluated with `share` 0 and 1.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "models/multibody/equilibrium.h"

namespace latsch::multibody {

struct LinearModel {
  Eigen::MatrixXd M, C, K;
};

struct LinearInputs {
  Eigen::MatrixXd P, Q;  // rows as in K, one column per input
};

struct LinearOutputs {
  Eigen::MatrixXd A, B, D;  // matrices with one row per output
};

/// Returns the linear model of the mechanism about this equilibrium, under the actions that cause
/// it.
LinearModel linear_model(const Mechanism& mechanism,
                         const Rest& rest,
                         const RestSettings& standing);

/// Rows of A and B for the output "force in a joint along a line that is fixed in one of its
/// bodies". The force is positive if it pushes the joint's second body along `direction` (unit
/// vector in the ground's axes at rest).
struct JointRow {
  Eigen::RowVectorXd by_x, by_v;
};
JointRow joint_force_row(const Mechanism& mechanism,
                         const Rest& rest,
                         const RestSettings& standing,
                         int joint,
                         const Eigen::Vector3d& direction,
                         int direction_body);

struct LinearMode {
  double frequency;        // f, Hz
  double damping;          // ζ, 0 .. 1
  Eigen::VectorXcd shape;  // mode shape φ, of length 1
};

/// Returns the natural modes in ascending order of frequency, one of each conjugate pair. Aperiodic
/// motion (ζ >= 1) is omitted.
std::vector<LinearMode> natural_modes(const LinearModel& model);

/// Returns the transfer functions of equation (4) at ω in rad/s: one row per output, one column per
/// input.
Eigen::MatrixXcd frequency_response(const LinearModel& model,
                                    const LinearInputs& inputs,
                                    const LinearOutputs& outputs,
                                    double omega);

}  // namespace latsch::multibody
