// SPDX-License-Identifier: Apache-2.0
// The plane of the unit cube to which linear equations E u = f between variables confine a fit, and
// the motions that stay in it.
//
// With N, orthonormal columns that span the null space of E, every point of the plane is u + N w.
// Residuals depend on w by J N, so that the covariance of the variables is
//   C = s^2 N (N'J'J N)^-1 N'
// which has the rank n - q for q independent equations, and the residuals have m - n + q degrees of
// freedom [Searle, Linear Models, 1971, 3.6]. J N needs only J P, P = N N', which differences
// within the plane give.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

class EqualPlane {
 public:
  EqualPlane() = default;
  /// Takes the normals of the equations as rows, q x n. A matrix without rows stands for the whole
  /// cube.
  explicit EqualPlane(Eigen::MatrixXd normals) : E_(std::move(normals)) {}

  /// True if there is no equation.
  bool is_whole() const { return E_.rows() == 0; }
  /// Returns the plane of some variables, if all others stay where they are.
  EqualPlane of(const std::vector<int>& variables) const;

  /// Returns N, n x (n - q).
  Eigen::MatrixXd motions() const;
  /// Returns J N; J itself if there is no equation.
  Eigen::MatrixXd within(const Eigen::MatrixXd& J) const;
  /// Returns N X; X itself if there is no equation.
  Eigen::MatrixXd of_variables(const Eigen::MatrixXd& X) const;
  /// Returns J P; J itself if there is no equation.
  Eigen::MatrixXd projected(const Eigen::MatrixXd& J) const;
  /// Returns the shortest motion of the variables that `variables` names which keeps the equations
  /// if variable `moved` moves by 1.
  Eigen::VectorXd kept_by(const std::vector<int>& variables, int moved) const;
  /// Returns the gradient less the combination of normals that leaves the least of it in the
  /// variables that `variables` names.
  Eigen::VectorXd reduced(const Eigen::VectorXd& gradient, const std::vector<int>& variables) const;

 private:
  Eigen::MatrixXd E_;
};

}  // namespace latsch
