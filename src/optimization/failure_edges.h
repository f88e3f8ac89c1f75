// SPDX-License-Identifier: Apache-2.0
// Where failures end, as far as single points tell: planes between points that failed and points
// that succeeded, midway between the two,
//
//   least |a|^2   with   a'x_s - b <= -1  for successes,   a'x_f - b >= 1  for failures:
//
// the plane of the widest gap [Cortes, Vapnik, Machine Learning 20 (1995) 273]. A step that keeps
// on this side of it goes on along the edge of a failed region; whether it succeeds or fails halves
// the gap, and turns the plane.
//
// Two failures or more that a plane parts from all successes around make an edge; a single one says
// nothing about a region (residual_memory.h has a ball for it), and failures here and there among
// successes have no plane.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

/// a'x <= b on this side; a of length 1.
struct Edge {
  Eigen::VectorXd a;
  double b;
};

/// Points relative to a success, 0, in units that mean the same along all axes, failures nearest
/// first.
std::vector<Edge> failure_edges(const std::vector<Eigen::VectorXd>& failures,
                                const std::vector<Eigen::VectorXd>& successes);

}  // namespace latsch
