// SPDX-License-Identifier: Apache-2.0
// Response of a tire whose rim is a rigid body, from that of the tire on a rim that is held.
//
// A held rim that is moved by q_w takes the tire's forces F_h = H_ww q_w + H_wj of the other
// inputs. A rim with the mass m on springs k, on which a force F acts, moves by
//   (k - omega^2 m - H_ww) q_w = H_wj + F                                                     (Z.4)
// and every output follows by what the moved rim adds to it.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/motion/rim_motion.h"

namespace latsch::fe_tire {

/// Returns the response [outputs x inputs] with a rim that moves. `held`: TireResponse::at() at the
/// angular frequency `omega`, rad/s, whose last six ports are the wheel's motions along and about
/// x, y, z, upright. With the moving rim these ports are driven by a force or moment on the rim, N
/// or N m, and observed by the rim's motion, m or rad.
Eigen::MatrixXcd on_moving_rim(const Eigen::MatrixXcd& held, const Rim& rim, double omega);

}  // namespace latsch::fe_tire
