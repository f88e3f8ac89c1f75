// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/orthogonal_factors.h"

#include <Eigen/QR>

namespace latsch::numerics {

HouseholderQr::HouseholderQr(const Eigen::MatrixXd& A) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  reflections_ = qr.matrixQR();
  coefficients_ = qr.hCoeffs();
}

Eigen::MatrixXd HouseholderQr::Q() const {
  return Eigen::householderSequence(reflections_, coefficients_);
}

Eigen::MatrixXd HouseholderQr::R() const {
  return reflections_.topRows(reflections_.cols()).triangularView<Eigen::Upper>();
}

Eigen::VectorXd HouseholderQr::times_Q(const Eigen::VectorXd& b) const {
  return Eigen::householderSequence(reflections_, coefficients_) * b;
}

Eigen::VectorXd HouseholderQr::times_Q_transposed(const Eigen::VectorXd& b) const {
  return Eigen::householderSequence(reflections_, coefficients_).transpose() * b;
}

Eigen::VectorXd HouseholderQr::solve_R(const Eigen::VectorXd& b) const {
  const Eigen::Index n = reflections_.cols();
  return reflections_.topRows(n).triangularView<Eigen::Upper>().solve(b.head(n));
}

PivotedQr pivoted_qr(const Eigen::MatrixXd& A, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  qr.setThreshold(threshold);
  const auto& order = qr.colsPermutation().indices();
  return {qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), A.rows()),
          {order.begin(), order.end()},
          static_cast<int>(qr.rank())};
}

Eigen::MatrixXd range_basis(const Eigen::MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  return qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), qr.rank());
}

Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.colPivHouseholderQr().solve(b);
}

Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

Eigen::MatrixXd shortest_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.completeOrthogonalDecomposition().solve(B);
}

}  // namespace latsch::numerics
