// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/d_optimality.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numerics/dense/cholesky.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch {
namespace {

constexpr double kBoundsInformation = 12.0;  // 1 / variance of a uniform number between 0 and 1

Eigen::MatrixXd information(const Eigen::MatrixXd& J) {
  return J.transpose() * J + kBoundsInformation * Eigen::MatrixXd::Identity(J.cols(), J.cols());
}

double widest(const Eigen::MatrixXd& M) {
  return 1.0 / std::sqrt(numerics::self_adjoint_eigenvalues(M)[0]);
}

Eigen::VectorXd deviations(const Eigen::MatrixXd& M) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(M.rows(), M.cols());
  return numerics::PivotedCholesky(M).solve(one).diagonal().cwiseSqrt();
}

}  // namespace

std::vector<DOptimality> d_optimality(const Eigen::MatrixXd& J,
                                      const std::vector<Candidate>& candidates) {
  const Eigen::MatrixXd M = information(J);
  const double log_determinant = numerics::Cholesky(M).log_determinant();
  std::vector<DOptimality> gains;
  for (size_t c = 0; c < candidates.size(); ++c) {
    assert(candidates[c].J.cols() == J.cols());
    const Eigen::MatrixXd with = M + candidates[c].J.transpose() * candidates[c].J;
    const double log_determinant_with = numerics::Cholesky(with).log_determinant();
    gains.push_back({.candidate = static_cast<int>(c),
                     .shrinkage = std::exp(0.5 * (log_determinant_with - log_determinant)),
                     .widest_before = widest(M),
                     .widest_after = widest(with),
                     .deviations = deviations(with)});
  }
  std::stable_sort(gains.begin(), gains.end(), [](const auto& a, const auto& b) {
    return a.shrinkage > b.shrinkage;
  });
  return gains;
}

Eigen::VectorXd deviations_with_bounds(const Eigen::MatrixXd& J) {
  return deviations(information(J));
}

}  // namespace latsch
