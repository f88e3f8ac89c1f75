// SPDX-License-Identifier: Apache-2.0
// The tire as its tread's nodes feel it, S dense, on ground that acts on few of them.
//
// The ground's tangent C has rows and columns for what it touches alone, and P picks them. So
//   (S + P C P')^-1 = F - F P C (1 + P' F P C)^-1 P' F,    F = S^-1                           (D.1)
// takes a small matrix, once S is factorized: it serves all iterations of Newton's method, in which
// points come down, stick and slide, and columns of F are kept. Where S is not positive definite
// but for the ground, S + P C P' is factorized as it is.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

namespace latsch::fe_tire {

/// Tangent of the ground's forces, [m x m]: of `rows`, ascending, of what the tire keeps.
struct GroundTangent {
  std::vector<int> rows;
  Eigen::MatrixXd stiffness;  // its symmetric part
  Eigen::MatrixXd coupling;   // the rest; empty where nothing slides
};

class CondensedTire {
 public:
  /// [n x n], symmetric.
  void set(Eigen::MatrixXd S);

  Eigen::VectorXd multiply(const Eigen::VectorXd& w) const { return S_ * w; }
  /// (S + dc/dw)^-1 r, with all of the tangent.
  Eigen::VectorXd newton_step(const GroundTangent& tangent, const Eigen::VectorXd& r);
  /// Takes the symmetric part C of the tangent. False where S + P C P' is not positive definite.
  bool take(const GroundTangent& tangent);
  /// v <- (S + P C P')^-1 v
  void solve(Eigen::VectorXd& v) const;
  /// P C P' v
  Eigen::VectorXd multiply_ground(const Eigen::VectorXd& v) const;

 private:
  Eigen::MatrixXd whole(const GroundTangent& tangent) const;
  Eigen::MatrixXd columns(const std::vector<int>& rows);

  Eigen::MatrixXd S_, L_;             // and its factor, or that of S + P C P'
  bool is_positive_ = false;          // S
  std::map<int, Eigen::VectorXd> F_;  // columns of S^-1 that were asked for
  // Of (D.1) with the tangent that was taken: 1 + P' F P C = 1 + R R' C.
  std::vector<int> rows_;
  Eigen::MatrixXd C_, FP_, R_, M_;  // M_: factor of 1 + R' C R
};

}  // namespace latsch::fe_tire
