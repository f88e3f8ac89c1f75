// SPDX-License-Identifier: Apache-2.0
// The belt's curve is a closed uniform cubic B-spline. Node k is a control point, knot k is at the
// angle φ_k of the rim, and segment k runs between knots k and k + 1. At knot k, with s from 0 to 1
// in a segment,
//   P = (x_(k-1) + 4 x_k + x_(k+1))/6,  P' = (x_(k+1) - x_(k-1))/2
// and in the middle of segment k
//   X' = (5 (x_(k+1) - x_k) + x_(k+2) - x_(k-1))/8                                           (26)
// Torsion is interpolated with the same weights. The curve is C², so a motion through the tread
// does not show where the knots are; with chords, or curves with a continuous slope only, the road
// excites the tire at every segment. A rigid motion of the nodes is a rigid motion of the curve.
//
// Mass and sidewall are at the knots. With P = B x and B symmetric, forces f on the knots act as B
// f on the nodes, and a stiffness k at the knots is B' k B on the nodes.
#pragma once

#include <array>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"

namespace latsch::ring_tire {

/// Returns B x; also B' f.
NodeValues at_knots(const NodeValues& x);

/// Adds B' k B of one knot to K.
void add_at_knot(const Eigen::Matrix4d& k, int knot, CyclicBand& K);

/// Returns the radius of nodes on a circle over the radius of the knots: 1/B of one wave around the
/// ring.
double node_radius_over_knot_radius(int nodes);

/// Weights of the nodes k-1 .. k+2 at s of segment k, and their derivatives by s.
struct CurveWeights {
  std::array<double, 4> place, slope;
};
CurveWeights curve_weights(double s);

}  // namespace latsch::ring_tire
