// SPDX-License-Identifier: Apache-2.0
// Axes and lengths of the moves over which slopes are recomputed: coordinates y around a point c,
//
//   u = c + T y,      T = W V diag(l),   l_k = |r| / s_k,      J W = U diag(s) V'
//
// W holds the widths of the variables. Along every axis the residuals change by their own size: at
// y_k = 1 the sum of squares has doubled, as far as the Jacobian J is right. If r is noise, |r| =
// sigma sqrt(m), and a length is sqrt(m) standard deviations of the estimate: noise and ripple,
// which are part of r, allow no shorter ones, and directions with little effect get long ones. If r
// is small because the model fits, lengths are short and slopes are precise. A length is at most
// `longest` of a range and at least `shortest` of a width.
//
// Variables at a bound have a separate axis, because a direction that mixes them with others could
// leave the region.
#pragma once

#include <Eigen/Core>

namespace latsch {

struct NaturalFrame {
  Eigen::MatrixXd T;        // n x axes
  Eigen::MatrixXd inverse;  // axes x n matrix that gives y for a move along the equations

  int axes() const { return static_cast<int>(T.cols()); }
};

struct FrameLengths {
  double shortest;  // shortest length of an axis, as a share of a width
  double longest;   // longest length of an axis, as a share of the range of every variable
};

/// Returns the frame at u. `J` is dr/du; if it is not finite, no direction counts as having an
/// effect. `r` is the norm of the residuals, or the intended size of their change. `along` has
/// orthonormal columns: the directions along the equations, in units of the widths.
NaturalFrame natural_frame(const Eigen::MatrixXd& J,
                           double r,
                           const Eigen::VectorXd& u,
                           const Eigen::VectorXd& widths,
                           const Eigen::MatrixXd& along,
                           const FrameLengths& lengths);

}  // namespace latsch
