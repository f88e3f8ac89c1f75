// SPDX-License-Identifier: Apache-2.0
// Directions along which functions are differenced at a point without leaving a region. They are
// unit columns, as many independent ones as the region has dimensions at the point.
//
// A coordinate axis is used if a step along it stays inside, toward the side with more room. If
// equations or corners leave no room along an axis, generators of the tangent cone (tangent_cone.h)
// are used.
#pragma once

#include "optimization/problem/feasible_region.h"

namespace latsch {

Eigen::MatrixXd difference_directions(const FeasibleRegion& region,
                                      const Eigen::VectorXd& u,
                                      double step);

}  // namespace latsch
