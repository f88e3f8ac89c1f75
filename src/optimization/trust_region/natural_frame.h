// SPDX-License-Identifier: Apache-2.0
// Lengths at which fresh slopes are worth taking: coordinates y around a point c,
//
//   u = c + T y,      T = W V diag(l),   l_k = |r| / s_k,      J W = U diag(s) V'
//
// W the widths of the variables. Along every axis the residuals change by as much as they are:
// at y_k = 1 the sum of squares has doubled, as far as the Jacobian J is right. Where r is noise,
// |r| = sigma sqrt(m), that is sqrt(m) standard deviations of the estimate: noise and ripple, which
// are part of r, allow no shorter ones, and directions hardly felt get long ones. Where r is small
// because the model fits, they are short, and slopes are sharp. Lengths end at `longest` of a range
// and at `shortest` of a width.
//
// Variables at a bound have an axis of their own: a direction that mixes them could lead nowhere.
#pragma once

#include <Eigen/Core>

namespace latsch {

struct NaturalFrame {
  Eigen::MatrixXd T;        // n x axes
  Eigen::MatrixXd inverse;  // axes x n: y of a move along the equations

  int axes() const { return static_cast<int>(T.cols()); }
};

struct FrameLengths {
  double shortest;  // of a width
  double longest;   // of a range, in every variable
};

/// `J`: dr/du at u; where it is not finite as if nothing were felt; `r`: norm of the residuals, or
/// how much they are to change; `along`: orthonormal columns, directions along the equations in
/// widths.
NaturalFrame natural_frame(const Eigen::MatrixXd& J,
                           double r,
                           const Eigen::VectorXd& u,
                           const Eigen::VectorXd& widths,
                           const Eigen::MatrixXd& along,
                           const FrameLengths& lengths);

}  // namespace latsch
