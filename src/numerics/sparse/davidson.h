// SPDX-License-Identifier: Apache-2.0
// Eigenpairs of K x = lambda M x, near ones brought nearer: Davidson's method with K^-1 before
// residuals.
//
// Of an approximate pair (lambda, x) the correction d = K^-1 (K x - lambda M x) is what one step of
// inverse iteration would change; |d| in the norm of M is the residual of the inverted problem, as
// LanczosSettings::tolerance. Corrections of all pairs that err more extend the space in which
// Rayleigh and Ritz find the pairs again, with K and M themselves. So corrections need not be
// exact: solutions by a factor in single precision do, and Lanczos' method with those, which finds
// eigenpairs of another K, is enough to begin with.
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
  /// X <- K^-1 X or nearly so.
  using Solve = std::function<void(Eigen::Ref<Eigen::MatrixXd> X)>;

  /// `vectors`: independent columns near the lowest eigenvectors. K and M must outlive the search.
  Davidson(const SymmetricMatrix& K,
           const SymmetricMatrix& M,
           Solve solve,
           const Eigen::MatrixXd& vectors);

  /// The lowest `wanted` pairs, at most as many as vectors; converged where every |d| is below the
  /// tolerance. Some more vectors than pairs are wanted make it fast.
  EigenPairs<double> find(Eigen::Index wanted, double tolerance);
  /// After find(), in the space that left: the lowest `wanted` of these pairs to a finer tolerance.
  /// As many are corrected a step as are solved at the price of one, and the last correction of a
  /// pair is not measured by another one: how its errors fell tells what it leaves.
  EigenPairs<double> sharpen(Eigen::Index wanted, double tolerance);

  Eigen::Index count() const { return count_; }

 private:
  /// K^-1 of residuals of these pairs, once they are found in the space.
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
  // The space that pairs are sought in, orthonormal in M: the first size_ columns.
  Eigen::MatrixXd V_, KV_, MV_;
  Eigen::Index size_ = 0;
};

}  // namespace latsch::numerics
