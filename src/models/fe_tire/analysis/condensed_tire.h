// SPDX-License-Identifier: Apache-2.0
// The tire as its tread's nodes feel it, on ground that acts on few of them.
//
// S of all nodes that may ever touch is dense. Of these the ground reaches some: what it cannot
// reach is eliminated too, once a factor,
//   S = [ L 0 ] [ L' B' ]          T = S_22 - B B'                                            (D.1)
//       [ B I ] [ 0  T  ]
// and T is what iterations of Newton's method on the ground work with, in which points come down,
// stick and slide. Its sum with the ground's tangent C is factorized anew where an old factor of it
// has become slow: by Cholesky's method where C is symmetric, where something slides as L U. All
// but T, which tells how good a solution is, is in single precision, as what S comes from.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::fe_tire {

/// Tangent of the ground's forces, [m x m]: of `rows`, ascending, of what is within reach.
struct GroundTangent {
  std::vector<int> rows;
  Eigen::MatrixXd stiffness;  // its symmetric part
  Eigen::MatrixXd coupling;   // the rest; empty where nothing slides
  bool is_symmetric() const { return coupling.size() == 0; }
};

class CondensedTire {
 public:
  /// S [n x n], symmetric, and which of its rows are within reach, ascending. False where S of the
  /// others is not positive definite.
  bool set(const Eigen::MatrixXd& S, const std::vector<int>& reached);
  const std::vector<int>& reached() const { return reached_; }

  /// Forward elimination of a right-hand side [n]: what is left of it within reach.
  Eigen::VectorXd reduce(Eigen::VectorXd& v) const;
  /// Back substitution: from what is within reach to all, of a `v` that was reduced.
  void expand(const Eigen::VectorXd& within, Eigen::VectorXd& v) const;

  /// T w
  Eigen::VectorXd multiply(const Eigen::VectorXd& w) const { return T_ * w; }
  /// Takes T + C.
  void factorize(const GroundTangent& tangent);
  bool has_factor() const { return factor_ != Factor::none; }
  /// False where C was symmetric, its sum with T not positive definite.
  bool is_positive() const { return is_positive_; }
  /// v <- (T + C)^-1 v of the factor.
  void solve(Eigen::VectorXd& v) const;

 private:
  enum class Factor { none, cholesky, lu };

  std::vector<int> reached_, beyond_;
  Eigen::MatrixXf A_;  // L, and B below it: of what is beyond reach, then what is within
  Eigen::MatrixXd T_;
  Factor factor_ = Factor::none;
  bool is_positive_ = true;
  Eigen::MatrixXf L_;      // of T + C
  std::vector<int> rows_;  // of L U
};

/// C v, of what is within reach.
Eigen::VectorXd product(const GroundTangent& tangent, const Eigen::VectorXd& v);

}  // namespace latsch::fe_tire
