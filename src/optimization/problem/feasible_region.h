// SPDX-License-Identifier: Apache-2.0
// The part of the unit cube that fulfills the linear constraints of a design space, which is a
// polytope:
//
//   E u = f,   A u <= b      with rows of length 1, so that b - A u are distances
//
// A has the rows of the constraints first, then the faces of the cube,  u_i <= 1  and  -u_i <= 0.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"

namespace latsch {

class FeasibleRegion {
 public:
  explicit FeasibleRegion(const DesignSpace& space) : FeasibleRegion(space, space.constraints()) {}
  /// Creates the region of the cube of `space` that fulfills the given constraints.
  FeasibleRegion(const DesignSpace& space, const std::vector<LinearConstraint>& constraints);

  /// True if there are no linear constraints, so that the region is the cube.
  bool is_cube() const { return is_cube_; }
  const Eigen::MatrixXd& E() const { return E_; }
  const Eigen::VectorXd& f() const { return f_; }
  const Eigen::MatrixXd& A() const { return A_; }
  const Eigen::VectorXd& b() const { return b_; }

  /// The largest distance by which u violates a constraint; 0 inside the region.
  double violation(const Eigen::VectorXd& u) const;
  /// True if u fulfills all constraints up to rounding.
  bool contains(const Eigen::VectorXd& u) const;

  /// Returns, as columns, the outward normals of the inequalities that are nearer to u than
  /// `distance`.
  Eigen::MatrixXd normals_within(const Eigen::VectorXd& u, double distance) const;

  /// Returns the last point inside the region on the line from x, which is inside, to u. If the
  /// region is the cube, each variable of u is instead moved onto its bound.
  Eigen::VectorXd cut_off(const Eigen::VectorXd& x, const Eigen::VectorXd& u) const;

  /// Returns u, which is inside, moved onto all constraints that are nearer than `distance`.
  /// Returns u unchanged if the region is the cube, or if these constraints have no point in
  /// common.
  Eigen::VectorXd snapped(const Eigen::VectorXd& u, double distance) const;

  /// Returns the point of the region nearest to u.
  Eigen::VectorXd nearest(const Eigen::VectorXd& u) const;

  /// Returns the names of constraints and bounds that contradict each other, so that the region is
  /// empty; an empty text if the region contains a point.
  std::string contradiction() const;

 private:
  bool is_cube_;
  Eigen::MatrixXd E_, A_;
  Eigen::VectorXd f_, b_;
  std::vector<std::string> names_;  // names of the rows of E, followed by those of the rows of A
};

}  // namespace latsch
