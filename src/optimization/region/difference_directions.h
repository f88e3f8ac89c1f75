// SPDX-License-Identifier: Apache-2.0
// Directions in which functions of a point are differenced without leaving a region: as many
// independent ones as the region has dimensions there, of length 1, as columns.
//
// The axes, each toward the side on which there is more room, wherever a step fits; where equations
// or corners leave no room along an axis, generators of the tangent cone (tangent_cone.h).
#pragma once

#include "optimization/problem/feasible_region.h"

namespace latsch {

Eigen::MatrixXd difference_directions(const FeasibleRegion& region,
                                      const Eigen::VectorXd& u,
                                      double step);

}  // namespace latsch
