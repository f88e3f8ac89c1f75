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
// That there is a plane says little: among few points in many variables there nearly always is one
// [Cover, IEEE Trans. Electron. Comput. EC-14 (1965) 326]. So three failures or more make an edge,
// and only where the plane of the others tells of most of them, each in turn: it lies farther out
// than all successes. One or two say nothing about a region (residual_memory.h has a ball for
// each), and failures here and there among successes, of a node of a cluster or of a license, make
// no edge.
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
