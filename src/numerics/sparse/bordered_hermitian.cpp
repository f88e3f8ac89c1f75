// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/bordered_hermitian.h"

#include <utility>

#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::numerics {

void BorderedHermitian::add(double factor, const BorderedHermitian& other) {
  banded.lower() += factor * other.banded.lower();
  border += factor * other.border;
  corner += factor * other.corner;
}

void BorderedHermitian::multiply(const Eigen::Ref<const Eigen::MatrixXcd>& X,
                                 Eigen::Ref<Eigen::MatrixXcd> Y) const {
  const Eigen::Index m = banded.size(), b = corner.rows();
  banded.multiply(X.topRows(m), Y.topRows(m));
  if (b == 0) return;
  Y.topRows(m).noalias() += border * X.bottomRows(b);
  Y.bottomRows(b).noalias() = border.adjoint() * X.topRows(m);
  Y.bottomRows(b).noalias() += corner * X.bottomRows(b);
}

bool BorderedCholesky::factorize(const BorderedHermitian& A) {
  if (!banded_.factorize(A.banded)) return false;
  border_ = A.border;
  solved_ = A.border;
  if (A.corner.rows() == 0) return true;
  banded_.solve(solved_);
  const auto schur = self_adjoint_eigen(Eigen::MatrixXcd(A.corner - border_.adjoint() * solved_));
  if (!(schur.values.minCoeff() > 0.0)) return false;
  inverse_ = schur.vectors * schur.values.cwiseInverse().cast<std::complex<double>>().asDiagonal() *
             schur.vectors.adjoint();
  return true;
}

void BorderedCholesky::solve(Eigen::Ref<Eigen::MatrixXcd> X) const {
  const Eigen::Index m = border_.rows(), b = border_.cols();
  banded_.solve(X.topRows(m));
  if (b == 0) return;
  X.bottomRows(b) = (inverse_ * (X.bottomRows(b) - border_.adjoint() * X.topRows(m))).eval();
  X.topRows(m).noalias() -= solved_ * X.bottomRows(b);
}

}  // namespace latsch::numerics
