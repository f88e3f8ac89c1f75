// SPDX-License-Identifier: Apache-2.0
// Direct solution of sparse symmetric positive definite equations: A = L L' by fronts.
//
//   Factorization factor(pattern);             // ordering and symbolic work, once a mesh
//   if (factor.factorize(A).definite()) ...    // numbers only; ends at the first negative pivot
//   factor.solve(x);                           // x <- A^-1 x, one or many right-hand sides
//
// A front gathers successive columns of L that share their rows (elimination.h), is dense, and
// leaves an update of its later rows to its parent; nearly all the work is products of dense
// matrices by BLAS [Duff & Reid, The multifrontal solution of indefinite sparse symmetric linear
// equations, ACM Trans. Math. Softw. 9 (1983)]. The same bits on the same BLAS kernels.
//
// A factorization may be kept while the matrix moves on: as a preconditioner it goes stale slowly.
// For that use single precision does: half the memory, and a solution costs memory traffic above
// all. Accuracy then comes from the iteration around it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "numerics/sparse/symmetric_matrix.h"
#include "numerics/sparse/symmetric_pattern.h"

namespace latsch::numerics {

struct Elimination;  // elimination.h

/// What the numbers of the matrix allowed. Only of a definite one there is a factor to solve with.
struct FactorStatus {
  enum class Outcome {
    definite,
    not_positive,  // a pivot is zero or negative: the matrix is indefinite or, to rounding,
                   // singular
    failed,        // values that are not numbers
  };
  Outcome outcome = Outcome::failed;
  std::string reason;  // where not definite

  bool definite() const { return outcome == Outcome::definite; }
};

enum class Precision {
  full,    // double
  single,  // float inside, double outside: a preconditioner; definite is what the rounded matrix is
  refined,  // single, and solutions are refined to double with the matrix itself, which has to stay
            // as it is, and the pattern with it. Where the rounded matrix is not definite, full
};

class Factorization {
 public:
  /// Symbolic work. The pattern need not outlive the factorization.
  explicit Factorization(const SymmetricPattern& pattern, Precision precision = Precision::full);
  /// The same with the order of elimination of another factorization on this pattern: most of the
  /// symbolic work is in it.
  Factorization(const SymmetricPattern& pattern,
                Precision precision,
                std::shared_ptr<const Elimination> elimination);
  ~Factorization();
  Factorization(Factorization&&) noexcept;
  Factorization& operator=(Factorization&&) noexcept;

  FactorStatus factorize(const SymmetricMatrix& A);
  /// Gives the factor's memory back, until the next one.
  void release();

  /// x <- A^-1 x, in place.
  void solve(Eigen::Ref<Eigen::VectorXd> x) const;
  /// Every column of X, in place; many columns together are cheaper than one by one. Refined ones
  /// until what is left is `enough` of the right-hand side, or rounding.
  void solve_columns(Eigen::Ref<Eigen::MatrixXd> X, double enough = 0.0) const;

  /// The same as solve_columns(), as the factor in its own precision has it: a preconditioner.
  void solve_roughly(Eigen::Ref<Eigen::MatrixXd> X) const;

  // With an interface of m unknowns (Elimination::interface), A = [A_ii A_ic; A_ci A_cc] may be
  // factorized but for it:
  //   S = A_cc - A_ci A_ii^-1 A_ic
  // is what the interface feels of the rest, and solving A x = b is reduce(b), S x_c = b_c of what
  // came out, expand(x). Other matrices on the interface can be added to S at will.

  /// Definite: A_ii is.
  FactorStatus condense(const SymmetricMatrix& A);
  /// S [m x m], in the order of the interface's block rows.
  Eigen::MatrixXd condensed() const;
  /// b <- (L_ii^-1 b_i, b_c - A_ci A_ii^-1 b_i)
  void reduce(Eigen::Ref<Eigen::VectorXd> b) const;
  /// x <- (L_ii^-T (x_i - L_ci' x_c), x_c)
  void expand(Eigen::Ref<Eigen::VectorXd> x) const;

  const std::shared_ptr<const Elimination>& elimination() const;

  struct Impl;  // multifrontal.h

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::numerics
