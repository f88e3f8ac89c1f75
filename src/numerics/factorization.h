// SPDX-License-Identifier: Apache-2.0
// Direct solution of sparse symmetric equations: A = L D L' by MUMPS (sequential) on a METIS
// ordering.
//
//   Factorization factor(pattern);             // ordering and symbolic work, once a mesh
//   if (factor.factorize(A).definite()) ...    // numbers only
//   factor.solve(x);                           // x <- A^-1 x, one or many right-hand sides
//
// A factorization may be kept while the matrix moves on: as a preconditioner it goes stale slowly.
// For that use single precision does: half the memory, and a solution costs memory traffic above
// all (tire B, one right-hand side: 1.9 ms against 4.6 ms; factorization 54 ms against 96 ms).
// Accuracy then comes from the iteration around it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "numerics/symmetric_matrix.h"
#include "numerics/symmetric_pattern.h"

namespace latsch::numerics {

/// What the numbers of the matrix allowed. After a singular or failed outcome there is no factor to
/// solve with.
struct FactorStatus {
  enum class Outcome { definite, indefinite, singular, failed };
  Outcome outcome = Outcome::failed;
  int negative_pivots = 0;  // number of negative eigenvalues of the matrix (Sylvester)
  std::string reason;       // for singular and failed

  bool definite() const { return outcome == Outcome::definite; }
  /// True where solve() may be called.
  bool usable() const { return outcome == Outcome::definite || outcome == Outcome::indefinite; }
};

enum class Precision {
  full,    // double
  single,  // float inside, double outside: a preconditioner; its inertia is that of the rounded
           // matrix
};

class Factorization {
 public:
  /// Symbolic work. The pattern need not outlive the factorization.
  explicit Factorization(const SymmetricPattern& pattern, Precision precision = Precision::full);
  ~Factorization();
  Factorization(Factorization&&) noexcept;
  Factorization& operator=(Factorization&&) noexcept;

  FactorStatus factorize(const SymmetricMatrix& A);
  /// Whether the last factorize() left a factor.
  bool ready() const;

  /// x <- A^-1 x, in place.
  void solve(Eigen::Ref<Eigen::VectorXd> x) const;
  /// Every column of X, in place; many columns together are cheaper than one by one.
  void solve_columns(Eigen::Ref<Eigen::MatrixXd> X) const;

  double flops()
      const;  // floating-point operations of one factorization (estimate of the analysis)
  long long entries() const;  // numbers in L (estimate of the analysis)

  struct Impl;  // factorization.cpp

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::numerics
