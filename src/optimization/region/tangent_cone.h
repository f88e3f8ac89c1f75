// SPDX-License-Identifier: Apache-2.0
// Generators of a tangent cone, the set of directions d that do not violate any constraint,
//
//   T = { d : V'd <= 0, E'd = 0 } = { lines * any numbers + rays * numbers >= 0 }
//
// The columns of V are outward normals of inequalities, those of E normals of equations. `lines` is
// an orthonormal basis of the directions parallel to all of them. If the normals are linearly
// independent, the rays are the columns of -V (V'V)^-1 [Lewis, Shepherd, Torczon, SIAM J. Sci.
// Comput. 29 (2007) 2507]. If more planes meet in a corner than there are dimensions, the rays are
// enumerated by the double-description method [Motzkin et al. 1953; Fukuda & Prodon 1996], one
// plane after the other.
//
// Limit: corners with up to about twenty variables. A corner can have exponentially many rays.
// Beyond 2,000 rays the remaining planes are ignored, and rays may then violate them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

struct ConeGenerators {
  Eigen::MatrixXd lines;              // orthonormal columns
  std::vector<Eigen::VectorXd> rays;  // unit vectors
};

ConeGenerators tangent_cone(const Eigen::MatrixXd& V, const Eigen::MatrixXd& E);

}  // namespace latsch
