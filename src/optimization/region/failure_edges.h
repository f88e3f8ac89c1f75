// SPDX-License-Identifier: Apache-2.0
// Estimates the edges of failed regions from single points: planes midway between points that
// failed and points that succeeded,
//
//   minimize |a|^2   with   a'x_s - b <= -1  for successes,   a'x_f - b >= 1  for failures.
//
// This is the plane of the widest gap [Cortes, Vapnik, Machine Learning 20 (1995) 273]. A step that
// stays on the successful side of the plane follows the edge of a failed region. Its outcome,
// success or failure, halves the gap and turns the plane.
//
// The existence of a plane proves little: among few points in many variables there nearly always is
// one [Cover, IEEE Trans. Electron. Comput. EC-14 (1965) 326]. So an edge needs at least three
// failures and a cross-check: each failure in turn is left out, and the plane of the others must
// predict most of them, so that the failure lies farther out than all successes. One or two
// failures do not show a region (residual_memory.h has a ball for each), and sporadic failures
// among successes, of a node of a cluster or of a license, make no edge.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

/// Points on this side fulfill a'x <= b; a has length 1.
struct Edge {
  Eigen::VectorXd a;
  double b;
};

/// Returns the edges. Points are relative to a success, which is at 0, in units that are equivalent
/// along all axes. Failures are ordered nearest first.
std::vector<Edge> failure_edges(const std::vector<Eigen::VectorXd>& failures,
                                const std::vector<Eigen::VectorXd>& successes);

}  // namespace latsch
