// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/equal_plane.h"

#include "numerics/dense/orthogonal_factors.h"

namespace latsch {
namespace {

constexpr double kDependent = 1e-12;  // share of a normal beyond others below which it adds nothing

}  // namespace

EqualPlane EqualPlane::of(const std::vector<int>& variables) const {
  return is_whole() ? EqualPlane() : EqualPlane(E_(Eigen::all, variables));
}

Eigen::MatrixXd EqualPlane::motions() const {
  const Eigen::Index n = E_.cols();
  if (is_whole() || E_.norm() == 0.0) return Eigen::MatrixXd::Identity(n, n);
  const numerics::PivotedQr factors = numerics::pivoted_qr(E_.transpose(), kDependent);
  return factors.Q.rightCols(n - factors.rank);
}

Eigen::MatrixXd EqualPlane::within(const Eigen::MatrixXd& J) const {
  return is_whole() ? J : Eigen::MatrixXd(J * motions());
}

Eigen::MatrixXd EqualPlane::of_variables(const Eigen::MatrixXd& X) const {
  return is_whole() ? X : Eigen::MatrixXd(motions() * X);
}

Eigen::MatrixXd EqualPlane::projected(const Eigen::MatrixXd& J) const {
  if (is_whole()) return J;
  const Eigen::MatrixXd N = motions();
  return J * N * N.transpose();
}

Eigen::VectorXd EqualPlane::kept_by(const std::vector<int>& variables, int moved) const {
  const auto count = std::ssize(variables);
  if (is_whole() || count == 0) return Eigen::VectorXd::Zero(count);
  const Eigen::MatrixXd own = E_(Eigen::all, variables);
  return -numerics::shortest_solution(own, Eigen::VectorXd(E_.col(moved)));
}

Eigen::VectorXd EqualPlane::reduced(const Eigen::VectorXd& gradient,
                                    const std::vector<int>& variables) const {
  if (is_whole() || variables.empty()) return gradient;
  const Eigen::MatrixXd own = E_(Eigen::all, variables).transpose();
  const Eigen::VectorXd rates =
      numerics::shortest_solution(own, Eigen::VectorXd(gradient(variables)));
  return gradient - E_.transpose() * rates;
}

}  // namespace latsch
