// SPDX-License-Identifier: Apache-2.0
// Davidson's method: improves approximate eigenpairs of K x = lambda M x, with K^-1 as
// preconditioner of residuals.
//
// The correction d = K^-1 (K x - lambda M x) of an approximate pair (lambda, x) is the change by
// one step of inverse iteration; |d| in the norm of M is the residual of the inverted problem, as
// in LanczosSettings::tolerance. Corrections of all pairs with larger errors extend the space in
// which the Rayleigh-Ritz procedure finds the pairs again, with K and M themselves. So corrections
// need not be exact: solutions by a factor in single precision suffice. The start may come from
// Lanczos' method with the same factor, which finds eigenpairs of a slightly different K.
//   [Davidson 1975, J. Comput. Phys. 17, 87-94; Knyazev 2001, SIAM J. Sci. Comput. 23, 517-541]
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "numerics/sparse/lanczos.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::numerics {

class Davidson {
 public:
  /// Computes X <- K^-1 X, exactly or nearly.
  using Solve = std::function<void(Eigen::Ref<Eigen::MatrixXd> X)>;

  /// `vectors`: independent columns near the lowest eigenvectors. K and M must outlive this object.
  Davidson(const SymmetricMatrix& K,
           const SymmetricMatrix& M,
           Solve solve,
           const Eigen::MatrixXd& vectors);

  /// Finds the lowest `wanted` pairs, at most as many as there are vectors. The result is converged
  /// if every |d| is below the tolerance. A few more vectors than wanted pairs make the method
  /// fast.
  EigenPairs<double> find(Eigen::Index wanted, double tolerance);
  /// Call after find(): improves the lowest `wanted` of the found pairs to a finer tolerance, in
  /// the search space that find() left. Each step corrects as many pairs as one solution with
  /// several right-hand sides can hold. The last correction of a pair is not checked by another
  /// one: its remaining error is estimated from the reduction by the correction before.
  EigenPairs<double> sharpen(Eigen::Index wanted, double tolerance);

  Eigen::Index count() const { return count_; }

 private:
  /// Returns K^-1 of the residuals of these pairs, given by lambda and S in the space.
  Eigen::MatrixXd corrections(const std::vector<Eigen::Index>& pairs,
                              const Eigen::VectorXd& lambda,
                              const Eigen::MatrixXd& S) const;
  auto V() const { return V_.leftCols(size_); }
  auto KV() const { return KV_.leftCols(size_); }
  auto MV() const { return MV_.leftCols(size_); }
  void extend(Eigen::MatrixXd D);
  void extend(Eigen::MatrixXd D, Eigen::MatrixXd MD);
  void append(const Eigen::MatrixXd& D, const Eigen::MatrixXd& MD);
  Eigen::VectorXd compress();

  const SymmetricMatrix &K_, &M_;
  Solve solve_;
  Eigen::Index count_;
  // Basis of the search space, orthonormal in M: the first size_ columns.
  Eigen::MatrixXd V_, KV_, MV_;
  Eigen::Index size_ = 0;
};

}  // namespace latsch::numerics
