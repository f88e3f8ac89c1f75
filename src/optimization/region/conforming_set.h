// SPDX-License-Identifier: Apache-2.0
// Poll directions at a point of a polytope. Steps of length epsilon along the core directions stay
// inside the polytope, and one of them points downhill unless the point is stationary.
//
//   core        generators of the tangent cone of the constraints within epsilon: its rays, and a
//               simplex in the space along all of these constraints, turned as in generating_set.h.
//               A step of epsilon along any of them stays inside.
//   normals     outward normals of these constraints, projected on the equations. They lead onto
//               the constraints. [Kolda, Lewis, Torczon, SIAM J. Optim. 17 (2006) 943; "projected
//               normals" of HOPSPACK, Plantenga, SAND2009-6265]
//
// In a cube, where bounds are the only constraints, the set is generating_set() of the bounds the
// point lies on: steps are bent along bounds there and need no epsilon.
#pragma once

#include <vector>

#include "optimization/problem/feasible_region.h"

namespace latsch {

/// Unit vectors.
std::vector<Eigen::VectorXd> conforming_set(const FeasibleRegion& region,
                                            const Eigen::VectorXd& x,
                                            double epsilon,
                                            int turn);

}  // namespace latsch
