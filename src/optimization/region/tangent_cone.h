// SPDX-License-Identifier: Apache-2.0
// Generators of a tangent cone: the directions d that lead into constraints nowhere,
//
//   T = { d : V'd <= 0, E'd = 0 } = { lines * any numbers + rays * numbers >= 0 }
//
// where the columns of V are normals of inequalities that point outward, those of E of equations.
// `lines` is an orthonormal basis of the directions along all of them. Where the normals are
// linearly independent the rays are the columns of -V (V'V)^-1 [Lewis, Shepherd, Torczon, SIAM J.
// Sci. Comput. 29 (2007) 2507]; where more planes meet in a corner than its dimension
// needs, they are enumerated by the double-description method [Motzkin et al. 1953; Fukuda &
// Prodon 1996], one plane after the other.
//
// Limit: corners of up to some twenty variables. A corner can have exponentially many rays; beyond
// 2,000 the planes left are not taken in, and rays may then lead into them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

struct ConeGenerators {
  Eigen::MatrixXd lines;              // orthonormal columns
  std::vector<Eigen::VectorXd> rays;  // of length 1
};

ConeGenerators tangent_cone(const Eigen::MatrixXd& V, const Eigen::MatrixXd& E);

}  // namespace latsch
