// SPDX-License-Identifier: Apache-2.0
// The belt's curve: a closed uniform cubic B-spline. Node k is a control point, knot k stands at
// the angle φ_k of the rim, between the knots runs segment k. At knot k, by s of one a segment,
//   P = (x_(k-1) + 4 x_k + x_(k+1))/6,  P' = (x_(k+1) - x_(k-1))/2
// and in the middle of segment k
//   X' = (5 (x_(k+1) - x_k) + x_(k+2) - x_(k-1))/8                                           (26)
// Torsion is interpolated alike. The curve bends without kinks (C²), so what runs through the tread
// does not feel where the knots are; chords, and curves of continuous slope alone, let the road
// feel every segment. A rigid motion of the nodes is one of the curve.
//
// Mass and sidewall stand at the knots: with P = B x, B symmetric, their forces f count B f on the
// nodes, and what is k_k at knot k is B' k B on the nodes.
#pragma once

#include <array>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"

namespace latsch::ring_tire {

/// B x; also B' f.
NodeValues at_knots(const NodeValues& x);

/// K += B' k B of a knot.
void add_at_knot(const Eigen::Matrix4d& k, int knot, CyclicBand& K);

/// Over the knots' radius, that of nodes on a circle; 1/B of one wave around the ring.
double node_radius_over_knot_radius(int nodes);

/// Weights of the nodes k-1 .. k+2 at s of segment k, and of their derivative by s.
struct CurveWeights {
  std::array<double, 4> place, slope;
};
CurveWeights curve_weights(double s);

}  // namespace latsch::ring_tire
