// SPDX-License-Identifier: Apache-2.0
// The multifrontal factor in one precision, and the interface through which Factorization uses a
// factor.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "numerics/sparse/elimination.h"
#include "numerics/sparse/factorization.h"

namespace latsch::numerics {

struct Factorization::Impl {
  bool ready = false;
  virtual ~Impl() = default;
  virtual FactorStatus factorize(const SymmetricMatrix& A, bool but_interface) = 0;
  /// Solves for every column of X in place. `enough` is the relative residual to reach, if
  /// solutions are refined.
  virtual void solve(Eigen::Ref<Eigen::MatrixXd> X, double enough) = 0;
  virtual Eigen::MatrixXd condensed() const = 0;
  virtual void reduce(Eigen::Ref<Eigen::VectorXd> x) = 0;
  virtual void expand(Eigen::Ref<Eigen::VectorXd> x) = 0;
  virtual void solve_roughly(Eigen::Ref<Eigen::MatrixXd> X) { solve(X, 0.0); }
  virtual void release() = 0;
  std::shared_ptr<const Elimination> elimination;
};

/// Creates a factorization in the precision Real, float or double.
template <class Real>
std::unique_ptr<Factorization::Impl> multifrontal(const SymmetricPattern& pattern,
                                                  const std::shared_ptr<const Elimination>& order);

}  // namespace latsch::numerics
