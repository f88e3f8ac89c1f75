// SPDX-License-Identifier: Apache-2.0
// The part of the unit cube that fulfills the linear constraints of a design space: a polytope.
//
//   E u = f,   A u <= b      rows of length 1, so that b - A u are distances
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
  /// Uses the given constraints in the cube of the space.
  FeasibleRegion(const DesignSpace& space, const std::vector<LinearConstraint>& constraints);

  /// True without linear constraints: there are only bounds.
  bool is_cube() const { return is_cube_; }
  const Eigen::MatrixXd& E() const { return E_; }
  const Eigen::VectorXd& f() const { return f_; }
  const Eigen::MatrixXd& A() const { return A_; }
  const Eigen::VectorXd& b() const { return b_; }

  /// The largest distance by which u lies outside a row; 0 inside.
  double violation(const Eigen::VectorXd& u) const;
  /// True up to rounding.
  bool contains(const Eigen::VectorXd& u) const;

  /// Outward normals of the inequalities nearer to u than `distance`, as columns.
  Eigen::MatrixXd normals_within(const Eigen::VectorXd& u, double distance) const;

  /// Returns the last point of the region on the line from x, which is inside, to u. In the cube u
  /// is moved onto the bounds instead, variable by variable.
  Eigen::VectorXd cut_off(const Eigen::VectorXd& x, const Eigen::VectorXd& u) const;

  /// Returns u, which is inside, moved onto all constraints that are nearer than `distance`.
  /// Returns u itself in the cube and if these constraints have no point in common.
  Eigen::VectorXd snapped(const Eigen::VectorXd& u, double distance) const;

  /// Returns the point of the region nearest to u.
  Eigen::VectorXd nearest(const Eigen::VectorXd& u) const;

  /// Names the constraints and bounds that leave no point; empty if there is one.
  std::string contradiction() const;

 private:
  bool is_cube_;
  Eigen::MatrixXd E_, A_;
  Eigen::VectorXd f_, b_;
  std::vector<std::string> names_;  // names of the rows of E, then of A
};

}  // namespace latsch
