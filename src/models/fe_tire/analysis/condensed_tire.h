// SPDX-License-Identifier: Apache-2.0
// The tire condensed to the nodes of its tread, on ground that acts on few of them.
//
// The condensed stiffness S of all nodes that may ever touch is dense. The ground reaches some of
// these nodes (block 2); the others (block 1) are eliminated too, once per factorization,
//   S = [ L 0 ] [ L' B' ]          T = S_22 - B B'                                            (D.1)
//       [ B I ] [ 0  T  ]
// and Newton's iterations on the ground, in which points come down, stick and slide, work with T.
// The sum of T and the ground's tangent C is factorized anew if its old factor has become slow: by
// Cholesky's method if C is symmetric, as L U if something slides. All but T, which measures the
// error of a solution, is in single precision, as is the factor from which S comes.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::fe_tire {

/// Tangent of the ground's forces, [m x m], at the rows `rows` (ascending) among those within
/// reach.
struct GroundTangent {
  std::vector<int> rows;
  Eigen::MatrixXd stiffness;  // its symmetric part
  Eigen::MatrixXd coupling;   // its remainder; empty if nothing slides
  bool is_symmetric() const { return coupling.size() == 0; }
};

class CondensedTire {
 public:
  /// Sets S [n x n], symmetric, and the rows within reach, ascending. Returns false if the block of
  /// the other rows is not positive definite.
  bool set(const Eigen::MatrixXd& S, const std::vector<int>& reached);
  const std::vector<int>& reached() const { return reached_; }

  /// Forward elimination of a right-hand side [n]. Returns its remainder within reach.
  Eigen::VectorXd reduce(Eigen::VectorXd& v) const;
  /// Back substitution: computes all of a reduced `v` from its part within reach.
  void expand(const Eigen::VectorXd& within, Eigen::VectorXd& v) const;

  const Eigen::MatrixXd& stiffness() const { return T_; }  // T
  /// Returns T w.
  Eigen::VectorXd multiply(const Eigen::VectorXd& w) const { return T_ * w; }
  /// Factorizes T + C.
  void factorize(const GroundTangent& tangent);
  bool has_factor() const { return factor_ != Factor::none; }
  /// False if C was symmetric and T + C not positive definite.
  bool is_positive() const { return is_positive_; }
  /// Applies v <- (T + C)^-1 v with the last factor.
  void solve(Eigen::VectorXd& v) const;

 private:
  enum class Factor { none, cholesky, lu };

  std::vector<int> reached_, beyond_;
  Eigen::MatrixXf A_;  // L, and B below it: rows beyond reach, then rows within
  Eigen::MatrixXd T_;
  Factor factor_ = Factor::none;
  bool is_positive_ = true;
  Eigen::MatrixXf L_;      // factor of T + C
  std::vector<int> rows_;  // row order of L U
};

/// Returns C v of the rows within reach.
Eigen::VectorXd product(const GroundTangent& tangent, const Eigen::VectorXd& v);

}  // namespace latsch::fe_tire
