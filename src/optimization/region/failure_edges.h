// SPDX-License-Identifier: Apache-2.0
// Estimates the edges of failed regions from single points: planes midway between points that
// failed and points that succeeded,
//
//   minimize |a|^2   with   a'x_s - b <= -1  for successes,   a'x_f - b >= 1  for failures.
//
// This is the plane of the widest gap [Cortes, Vapnik, Machine Learning 20 (1995) 273]. A step that
// stays on the successful side of the plane follows the edge of a failed region. Its outcome,
// success or failure, halves the gap and rotates the plane.
//
// The existence of a plane proves little: among few points in many variables there nearly always is
// one [Cover, IEEE Trans. Electron. Comput. EC-14 (1965) 326]. So an edge needs at least three
// failures and a cross-check: each failure in turn is left out, and a plane fitted to the other
// points must predict it, in that it lies farther out than all successes. Most failures must pass
// this check. One or two failures do not prove a region (residual_memory.h surrounds each by a
// ball), and sporadic failures among successes, such as those of a cluster's node or of a license,
// form no edge.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

/// The half space a'x <= b on the successful side of an edge; a has length 1.
struct Edge {
  Eigen::VectorXd a;
  double b;
};

/// Returns the edges of failed regions. Points are given relative to a success at the origin, in
/// units that make all axes comparable. Failures are ordered nearest first.
std::vector<Edge> failure_edges(const std::vector<Eigen::VectorXd>& failures,
                                const std::vector<Eigen::VectorXd>& successes);

}  // namespace latsch
