// SPDX-License-Identifier: Apache-2.0
// Poll directions at a point of a polytope. Steps of length epsilon along the core directions stay
// inside the polytope, and one of them points downhill unless the point is stationary.
//
//   core        generators of the tangent cone of the constraints within the distance epsilon: its
//               rays, and a simplex in the space along all of these constraints, rotated as in
//               generating_set.h. A step of epsilon along any of them stays inside.
//   normals     outward normals of these constraints, projected on the equations. They lead onto
//               the constraints. [Kolda, Lewis, Torczon, SIAM J. Optim. 17 (2006) 943; "projected
//               normals" of HOPSPACK, Plantenga, SAND2009-6265]
//
// If bounds are the only constraints, the set is generating_set() of the bounds that the point lies
// on: a step that crosses a bound is then cut off in this variable alone, so that the bounds nearby
// need not be considered.
#pragma once

#include <vector>

#include "optimization/problem/feasible_region.h"

namespace latsch {

/// Returns the poll directions at x as unit vectors.
std::vector<Eigen::VectorXd> conforming_set(const FeasibleRegion& region,
                                            const Eigen::VectorXd& x,
                                            double epsilon,
                                            int turn);

}  // namespace latsch
