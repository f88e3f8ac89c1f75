// SPDX-License-Identifier: Apache-2.0
// A mechanism about a place where it rests, for small motion x, six of each body (travel and
// rotation), with inputs u and outputs y:
//   M x'' + C x' + K x = P u + Q u'                                                            (1)
//   y = A x + B x' + D x''                                                                     (2)
//   K = -∂f/∂x,  C = -∂f/∂v,  M: masses, inertias, inerters        f: assembly.h, exact
//   (λ² M + λ C + K) φ = 0,  f = |λ|/2π,  ζ = -Re λ/|λ|                                        (3)
//   y/u = (A + iω B - ω² D) (K + iω C - ω² M)⁻¹ (P + iω Q)                                     (4)
// (4) is solved as a real system of twice the size. Preloads, loads and weight are in K: also where
// it is not symmetric, as rotations about the ground's axes are no coordinates of a potential.
//
// Laws with a kink (damper maps, play) have the slopes that they have where they rest. Dry friction
// sticks; Maxwell parts are relaxed, so what they add between their own frequency and above is left
// out. What acts from outside is what its wrenches' slopes say, with `share` 0 and 1.
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
  Eigen::MatrixXd P, Q;  // rows as of K, a column an input
};

struct LinearOutputs {
  Eigen::MatrixXd A, B, D;  // a row an output
};

/// Of the mechanism at this rest, under what keeps it there.
LinearModel linear_model(const Mechanism& mechanism, const Rest& rest, const Standing& standing);

/// A row of A and one of B: the force in a joint along a line that is fixed in one of its bodies.
/// Positive: it pushes the joint's second body along `direction` (of unit length, in the ground's
/// axes where it rests).
struct JointRow {
  Eigen::RowVectorXd by_x, by_v;
};
JointRow joint_force_row(const Mechanism& mechanism,
                         const Rest& rest,
                         const Standing& standing,
                         int joint,
                         const Eigen::Vector3d& direction,
                         int direction_body);

struct LinearMode {
  double frequency;        // f, Hz
  double damping;          // ζ, 0 .. 1
  Eigen::VectorXcd shape;  // φ, of length 1
};

/// What vibrates, ascending: of each pair one. Motion that creeps back (ζ >= 1) is left out.
std::vector<LinearMode> natural_modes(const LinearModel& model);

/// (4): outputs by inputs, at ω in rad/s.
Eigen::MatrixXcd frequency_response(const LinearModel& model,
                                    const LinearInputs& inputs,
                                    const LinearOutputs& outputs,
                                    double omega);

}  // namespace latsch::multibody
