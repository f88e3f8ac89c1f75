// SPDX-License-Identifier: Apache-2.0
// Direct solution of sparse symmetric positive definite equations: A = L L' by fronts.
//
// Use:
//   Factorization factor(pattern);             // ordering and symbolic work, once per mesh
//   if (factor.factorize(A).definite()) ...    // numbers only; ends at the first negative pivot
//   factor.solve(x);                           // x <- A^-1 x, one or many right-hand sides
//
// A front is a dense matrix of successive columns of L that share their rows (elimination.h); it
// passes an update of its later rows to its parent. Nearly all the work is products of dense
// matrices by BLAS [Duff & Reid, The multifrontal solution of indefinite sparse symmetric linear
// equations, ACM Trans. Math. Softw. 9 (1983)]. The same BLAS kernels give the same bits.
//
// A factorization may be kept while the matrix changes: as a preconditioner it loses quality
// slowly. Single precision suffices for that use. It halves the memory, and the time of a solution
// is mainly memory traffic. Accuracy then comes from the iteration around it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "numerics/sparse/symmetric_matrix.h"
#include "numerics/sparse/symmetric_pattern.h"

namespace latsch::numerics {

struct Elimination;  // elimination.h

/// Outcome of a factorization. Only a definite matrix has a factor to solve with.
struct FactorStatus {
  enum class Outcome {
    definite,
    /// A pivot is zero or negative: the matrix is indefinite or, to rounding, singular.
    not_positive,
    failed,  // the matrix contains values that are not numbers
  };
  Outcome outcome = Outcome::failed;
  std::string reason;  // reason of a failure; empty if definite

  bool definite() const { return outcome == Outcome::definite; }
};

enum class Precision {
  full,  // double
  /// The factor is in single precision, right-hand sides and solutions are in double: for a
  /// preconditioner. `definite` refers to the matrix rounded to single precision.
  single,
  /// The factor is in single precision, and solutions are refined to double by products with the
  /// matrix itself, so that matrix and pattern must stay unchanged. If the matrix rounded to single
  /// precision is not definite, a factor in double precision is used.
  refined,
};

class Factorization {
 public:
  /// Does the symbolic work. The pattern need not outlive the factorization.
  explicit Factorization(const SymmetricPattern& pattern, Precision precision = Precision::full);
  /// Reuses the order of elimination of another factorization on this pattern, whose computation is
  /// most of the symbolic work.
  Factorization(const SymmetricPattern& pattern,
                Precision precision,
                const std::shared_ptr<const Elimination>& elimination);
  ~Factorization();
  Factorization(Factorization&&) noexcept;
  Factorization& operator=(Factorization&&) noexcept;

  FactorStatus factorize(const SymmetricMatrix& A);
  /// Frees the factor's memory until the next factorization.
  void release();

  /// Computes x <- A^-1 x in place.
  void solve(Eigen::Ref<Eigen::VectorXd> x) const;
  /// Solves for every column of X in place; many columns together cost less than one by one. With
  /// Precision::refined, iterates until the residual of each column, relative to its right-hand
  /// side, is below `enough` or at the level of rounding errors.
  void solve_columns(Eigen::Ref<Eigen::MatrixXd> X, double enough = 0.0) const;

  /// Works as solve_columns() in the precision of the factor, without refinement: for use as a
  /// preconditioner.
  void solve_roughly(Eigen::Ref<Eigen::MatrixXd> X) const;

  // If the order has an interface of m unknowns (Elimination::interface), A = [A_ii A_ic; A_ci
  // A_cc] may be factorized without it:
  //   S = A_cc - A_ci A_ii^-1 A_ic
  // is the stiffness of the interface with all others eliminated. A x = b is solved by reduce(b), S
  // x_c = b_c with the reduced b_c, and expand(x). Any matrix on the interface can be added to S.

  /// Factorizes A_ii. The status is `definite` if A_ii is positive definite.
  FactorStatus condense(const SymmetricMatrix& A);
  /// Returns S [m x m] in the order of the interface's block rows.
  Eigen::MatrixXd condensed() const;
  /// Computes b <- (L_ii^-1 b_i, b_c - A_ci A_ii^-1 b_i).
  void reduce(Eigen::Ref<Eigen::VectorXd> b) const;
  /// Computes x <- (L_ii^-T (x_i - L_ci' x_c), x_c).
  void expand(Eigen::Ref<Eigen::VectorXd> x) const;

  const std::shared_ptr<const Elimination>& elimination() const;

  struct Impl;  // multifrontal.h

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::numerics
