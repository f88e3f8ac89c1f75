// SPDX-License-Identifier: Apache-2.0
// The tire's stiffness condensed to the nodes of its tread, for ground that acts on few of these
// nodes.
//
// The condensed stiffness S of all nodes that may touch the ground is a dense matrix. The ground
// currently reaches only some of these nodes (block 2). The others (block 1) are eliminated once
// per factorization,
//   S = [ L 0 ] [ L' B' ]          T = S_22 - B B'                                            (D.1)
//       [ B I ] [ 0  T  ]
// and Newton's method for the contact, in which points touch, stick and slide, works with T. The
// sum of T and the ground's tangent C is factorized again if iterations with the old factorization
// converge slowly: by Cholesky's method if C is symmetric, as L U if points slide. Only T, with
// which the error of a solution is computed, has double precision; all other matrices, and the
// factorization from which S is computed, have single precision.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::fe_tire {

/// Derivative of the ground's forces with respect to displacements, [m x m], for the rows `rows`
/// (ascending) among those that the ground may reach.
struct GroundTangent {
  std::vector<int> rows;
  Eigen::MatrixXd stiffness;  // its symmetric part
  Eigen::MatrixXd coupling;  // the remaining part, which is not symmetric; empty if no point slides
  bool is_symmetric() const { return coupling.size() == 0; }
};

class CondensedTire {
 public:
  /// Sets the condensed stiffness S [n x n], symmetric, and the ascending rows that the ground may
  /// reach. Returns false if the block of the other rows is not positive definite.
  bool set(const Eigen::MatrixXd& S, const std::vector<int>& reached);
  const std::vector<int>& reached() const { return reached_; }

  /// Forward elimination of the rows beyond the ground's reach for a right-hand side v [n]. Returns
  /// what remains for the rows within reach.
  Eigen::VectorXd reduce(Eigen::VectorXd& v) const;
  /// Back substitution: completes a reduced vector `v` from its solution `within` the ground's
  /// reach.
  void expand(const Eigen::VectorXd& within, Eigen::VectorXd& v) const;

  const Eigen::MatrixXd& stiffness() const { return T_; }  // T
  /// Returns T w.
  Eigen::VectorXd multiply(const Eigen::VectorXd& w) const { return T_ * w; }
  /// Factorizes T + C.
  void factorize(const GroundTangent& tangent);
  bool has_factor() const { return factor_ != Factor::none; }
  /// Returns false if C was symmetric and T + C was not positive definite.
  bool is_positive() const { return is_positive_; }
  /// Computes v <- (T + C)^-1 v with the last factorization.
  void solve(Eigen::VectorXd& v) const;

 private:
  enum class Factor { none, cholesky, lu };

  std::vector<int> reached_, beyond_;
  Eigen::MatrixXf A_;  // factor L, with B below it; the rows beyond the ground's reach come first
  Eigen::MatrixXd T_;
  Factor factor_ = Factor::none;
  bool is_positive_ = true;
  Eigen::MatrixXf L_;      // factor of T + C
  std::vector<int> rows_;  // row permutation of the factorization L U
};

/// Returns the product C v for the rows within the ground's reach.
Eigen::VectorXd product(const GroundTangent& tangent, const Eigen::VectorXd& v);

}  // namespace latsch::fe_tire
